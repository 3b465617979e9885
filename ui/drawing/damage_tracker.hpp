#pragma once

#include <span>
#include <string>
#include <vector>

#include <imgui.h>
#include <opencv2/core.hpp>

#include "ui/session/graphics.hpp"

namespace saccade {

/// Finds the parts of the window that look different from the last frame, by comparing ImGui's draw lists
/// triangle by triangle. Most frames differ in nothing, or in a slider and a number. One thread; no OpenGL.
class DamageTracker {
 public:
  /// The damage since the last call: rectangles in pixels of the framebuffer from its upper left corner,
  /// which do not overlap; none = `data` looks as before. `renewed` are the textures whose pixels have
  /// changed since. Everything is damaged at first, after reset(), and when the size or the set of ImGui
  /// windows has changed; of a draw list with a callback, everything that it can reach is.
  [[nodiscard]] std::vector<cv::Rect> damage(const ImDrawData& data, std::span<const TextureId> renewed);

  /// Forgets the last frame.
  void reset() { lists_.clear(), size_ = {}; }

 private:
  /// A triangle as it is seen.
  struct Triangle {
    ImDrawVert corners[3];
    ImVec4 clip;
    ImTextureID texture;
    bool operator==(const Triangle& other) const;
  };
  /// What one ImGui window drew.
  struct List {
    std::string owner;
    std::vector<Triangle> triangles;
    cv::Rect2f reach;  ///< of its callbacks; empty without one
  };

  static void flatten(const ImDrawList& list, List& out);
  bool same_windows(std::span<ImDrawList* const> lists) const;
  void compare(const List& before, const List& after, std::span<const TextureId> renewed);
  void add(std::span<const Triangle> triangles);
  std::vector<cv::Rect> in_pixels(const ImDrawData& data) const;

  cv::Size size_;
  std::vector<List> lists_;         // of the last frame
  List next_;                       // of the present one; kept for its memory, as is damage_
  std::vector<cv::Rect2f> damage_;  // in ImGui's units
};

}  // namespace saccade
