#pragma once

#include <span>
#include <string>
#include <vector>

#include <imgui.h>
#include <opencv2/core.hpp>

namespace saccade {

/// Remembers what ImGui drew last, so that of the next frame only what differs need be drawn: most frames
/// show what is there already, and of the others a slider has often moved and nothing else. No OpenGL; one
/// thread.
class DrawMemory {
 public:
  /// The parts of the display, in pixels of the framebuffer from its upper left corner, outside of which
  /// `data` looks as what was given last; they do not overlap. Empty: it looks the same. `renewed` are the
  /// textures whose pixels have changed since. All of the display after forget() and when its size has
  /// changed. Throws std::invalid_argument for drawings with callbacks: what they do is not known.
  std::vector<cv::Rect> changes(const ImDrawData& data, std::span<const ImTextureID> renewed);

  /// Nothing that was drawn is left.
  void forget() { lists_.clear(), size_ = {}; }

 private:
  struct List {
    std::string owner;
    std::vector<ImDrawCmd> commands;
    std::vector<ImDrawIdx> indices;
    std::vector<ImDrawVert> vertices;
  };
  /// A triangle as it is seen.
  struct Piece {
    ImDrawVert corners[3];
    ImVec4 clip;
    ImTextureID texture;
  };
  using Pieces = std::vector<Piece>;

  static bool same(const Piece& x, const Piece& y);
  static bool holds(const List& old, const ImDrawList& list);
  static void remember(const ImDrawList& list, List& out);
  static void take_apart(const ImDrawCmd* commands, std::size_t count, const ImDrawIdx* indices,
                         const ImDrawVert* vertices, Pieces& out);
  void compare(const List* old, const ImDrawList* list, std::span<const ImTextureID> renewed);
  void add(std::span<const Piece> pieces);

  cv::Size size_;
  std::vector<List> lists_;
  // Of one call, kept for their memory:
  Pieces before_, after_;
  std::vector<cv::Rect2f> changed_;
};

/// Cuts the drawing to a part of the framebuffer, of which it had been `whole`: the clip rectangles of all
/// commands, list by list.
std::vector<ImVec4> clips_of(const ImDrawData& data);
void cut(ImDrawData& data, const std::vector<ImVec4>& whole, const cv::Rect& part);

}  // namespace saccade
