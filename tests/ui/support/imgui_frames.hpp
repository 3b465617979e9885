#pragma once

#include <functional>
#include <string>

#include <imgui.h>
#include <imgui_internal.h>

namespace saccade::test {

/// ImGui without a display: frames are laid out and drawn into draw lists that nobody shows.
class ImGuiFrames {
 public:
  explicit ImGuiFrames(float width = 340, float height = 900, float font_px = 13) {
    ImGui::SetCurrentContext(ImGui::CreateContext());
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {width, height};
    ImFontConfig font;
    font.SizePixels = font_px;
    io.Fonts->AddFontDefault(&font);
    io.Fonts->Build();
    io.Fonts->SetTexID(ImTextureID(1));
  }
  ~ImGuiFrames() { ImGui::DestroyContext(); }
  ImGuiFrames(const ImGuiFrames&) = delete;
  ImGuiFrames& operator=(const ImGuiFrames&) = delete;

  /// The drawing of one frame.
  struct Drawn {
    int vertices = 0;
    float content_width = 0, window_width = 0;  ///< of what stands in the window; of the room for it
  };

  /// A frame with one window over the whole display that `draw` fills. Layout settles in the second frame of
  /// the same content.
  Drawn frame(const std::function<void()>& draw) {
    ImGui::GetIO().DeltaTime = 1.0F / 60;
    ImGui::NewFrame();
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize(ImGui::GetIO().DisplaySize);
    ImGui::Begin("panel", nullptr, ImGuiWindowFlags_NoDecoration);
    draw();
    Drawn drawn;
    const ImGuiWindow& window = *ImGui::GetCurrentWindow();
    drawn.window_width = window.WorkRect.Max.x;
    drawn.content_width = window.DC.CursorMaxPos.x;
    ImGui::End();
    ImGui::Render();
    drawn.vertices = ImGui::GetDrawData()->TotalVtxCount;
    return drawn;
  }

  /// The box around all that was drawn in a colour in the last frame; false if nothing was.
  static bool box_of(ImU32 colour, ImVec2& low, ImVec2& high) {
    bool found = false;
    const ImDrawData& data = *ImGui::GetDrawData();
    for (int i = 0; i < data.CmdListsCount; ++i)
      for (const ImDrawVert& vertex : data.CmdLists[i]->VtxBuffer) {
        if (vertex.col != colour) continue;
        low = found ? ImVec2(std::min(low.x, vertex.pos.x), std::min(low.y, vertex.pos.y)) : vertex.pos;
        high = found ? ImVec2(std::max(high.x, vertex.pos.x), std::max(high.y, vertex.pos.y)) : vertex.pos;
        found = true;
      }
    return found;
  }

  /// Presses and releases a mouse button at a place, over three frames of `draw`.
  void click(ImVec2 at, const std::function<void()>& draw) {
    ImGuiIO& io = ImGui::GetIO();
    io.MousePos = at;
    frame(draw);
    io.MouseDown[0] = true;
    frame(draw);
    io.MouseDown[0] = false;
    frame(draw);
  }
};

}  // namespace saccade::test
