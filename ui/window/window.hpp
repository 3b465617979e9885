#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "ui/drawing/cached_framebuffer.hpp"
#include "ui/session/shortcuts.hpp"

struct GLFWwindow;

namespace saccade {

/// A GLFW window with an OpenGL 3.3 core context that is current on the thread that made it, and Dear ImGui
/// on it. One at a time; all calls on that thread, wake() excepted.
class Window {
 public:
  /// `size`: px; empty = 1280 x 800 times `scale`, that of text and buttons (0 = the screen's own). `fit`: no
  /// larger than the screen has room for. Throws Error (failed) where there is no display or no OpenGL 3.3.
  Window(const std::string& title, cv::Size size, bool fit, double scale);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Makes wait() return. Any thread, while the window lives.
  static void wake() noexcept;

  /// Call after changes of the font atlas.
  void renew_fonts();

  /// Handles events; waits for one at most `seconds`.
  void wait(double seconds);

  void begin_frame();
  /// Draws the parts of ImGui's frame that differ from the last one; calls `before_show` before showing them.
  /// `renewed`: textures whose pixels have changed since the last frame.
  void end_frame(const cv::Scalar& background, std::span<const TextureId> renewed,
                 const std::function<void()>& before_show);

  /// The contents of the window, BGR; to be called from `before_show`.
  [[nodiscard]] cv::Mat3b picture() const;

  bool should_close() const;
  void close();
  bool hidden() const;          ///< minimised or without any size
  double screen_scale() const;  ///< 1 = usual density, 2 = twice
  cv::Size size() const;        ///< in the units of ImGui
  void set_title(const std::string& title);
  /// As the desktop's portal names windows: "x11:2a"; empty where the desktop is not X11.
  std::string portal_name() const;

  /// Files and folders dropped onto the window since the last call.
  [[nodiscard]] std::vector<std::string> take_dropped();

  struct KeyPress {
    Key key;
    bool ctrl, shift;
  };
  /// The keys pressed since the last call, with repeats: letters in upper case, other characters as typed
  /// (then without shift).
  [[nodiscard]] std::vector<KeyPress> take_keys();

  /// Whether an event came since the last call: input, a new size, a need to draw again.
  [[nodiscard]] bool take_event();

 private:
  struct Events {
    std::vector<std::string> dropped;
    std::vector<KeyPress> keys;
    bool any = true, exposed = true;
  };
  void start_imgui();

  GLFWwindow* window_ = nullptr;
  Events events_;
  std::unique_ptr<CachedFramebuffer> framebuffer_;
};

}  // namespace saccade
