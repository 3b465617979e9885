#include "ui/window/window.hpp"

#include <dlfcn.h>

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"

namespace saccade {
namespace {

std::string glfw_reason() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text != nullptr ? text : "unknown reason";
}

// Keys of letters, by the letter on the key, and keys without a character; other characters come by the
// character callback.
std::optional<Key> key_pressed(int code, int scan) {
  switch (code) {
    case GLFW_KEY_LEFT:
      return Key::left;
    case GLFW_KEY_RIGHT:
      return Key::right;
    case GLFW_KEY_UP:
      return Key::up;
    case GLFW_KEY_DOWN:
      return Key::down;
    case GLFW_KEY_HOME:
      return Key::home;
    case GLFW_KEY_END:
      return Key::end;
    case GLFW_KEY_F1:
      return Key::f1;
    case GLFW_KEY_ESCAPE:
      return Key::escape;
    case GLFW_KEY_SPACE:
      return Key::space;
    default:
      break;
  }
  const char* name = glfwGetKeyName(code, scan);
  const bool ascii = name != nullptr && name[0] > 0 && name[1] == '\0';
  const int character = ascii ? std::toupper(name[0]) : code;  // another alphabet: by the place of the key
  if (character < 'A' || character > 'Z') return std::nullopt;
  return key_of(static_cast<char>(character));
}

// What a window has where text and buttons are of this scale.
cv::Size size_at(double scale) {
  if (GLFWmonitor* monitor = scale > 0 ? nullptr : glfwGetPrimaryMonitor(); monitor != nullptr) {
    float x = 1, y = 1;
    glfwGetMonitorContentScale(monitor, &x, &y);
    scale = static_cast<double>(std::max(x, y));
  }
  scale = std::max(scale, 1.0);
  return {cvRound(1280 * scale), cvRound(800 * scale)};
}

// Without the bars of the desktop, where GLFW knows them.
cv::Size size_on_screen(cv::Size size) {
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  if (monitor == nullptr) return size;
  int x = 0, y = 0;
  cv::Size room;
  glfwGetMonitorWorkarea(monitor, &x, &y, &room.width, &room.height);
  if (room.empty()) return size;
  return {std::min(size.width, room.width), std::min(size.height, room.height)};
}

}  // namespace

Window::Window(const std::string& title, cv::Size size, bool fit, double scale) {
  if (glfwInit() != GLFW_TRUE)
    throw failed("no display", glfw_reason(),
                 "start it in a desktop session, or use saccade run, which needs no window");
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHintString(GLFW_X11_CLASS_NAME, "saccade");
  glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "saccade");  // GLFW uses both or none
  if (size.empty()) size = size_at(scale);
  if (fit) size = size_on_screen(size);
  window_ = glfwCreateWindow(size.width, size.height, title.c_str(), nullptr, nullptr);
  if (window_ == nullptr) {
    const std::string reason = glfw_reason();
    glfwTerminate();
    throw failed("no window with OpenGL 3.3", reason,
                 "is there a graphics driver? saccade run needs no window");
  }
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(1);
  glfwSetWindowSizeLimits(window_, 480, 360, GLFW_DONT_CARE, GLFW_DONT_CARE);
  start_imgui();
}

// Our callbacks come first; ImGui's backend chains to the ones that it finds.
void Window::start_imgui() {
  glfwSetWindowUserPointer(window_, &events_);
  static const auto events = [](GLFWwindow* window) -> Events& {
    return *static_cast<Events*>(glfwGetWindowUserPointer(window));
  };
  static const auto note = [](GLFWwindow* window) { events(window).any = true; };
  glfwSetKeyCallback(window_, [](GLFWwindow* w, int code, int scan, int action, int mods) {
    note(w);
    if (action == GLFW_RELEASE) return;
    if (const auto key = key_pressed(code, scan))
      events(w).keys.push_back({*key, (mods & GLFW_MOD_CONTROL) != 0, (mods & GLFW_MOD_SHIFT) != 0});
  });
  glfwSetCharCallback(window_, [](GLFWwindow* w, unsigned character) {
    note(w);
    if (character > ' ' && character < 0x7f && std::isalpha(static_cast<int>(character)) == 0)
      events(w).keys.push_back({key_of(static_cast<char>(character)), false, false});
  });
  glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int, int, int) { note(w); });
  glfwSetScrollCallback(window_, [](GLFWwindow* w, double, double) { note(w); });
  glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double, double) { note(w); });
  glfwSetWindowFocusCallback(window_, [](GLFWwindow* w, int) { note(w); });
  glfwSetCursorEnterCallback(window_, [](GLFWwindow* w, int) { note(w); });
  static const auto expose = [](GLFWwindow* window) {
    note(window);
    events(window).exposed = true;
  };
  glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* w, int, int) { expose(w); });
  glfwSetWindowRefreshCallback(window_, [](GLFWwindow* w) { expose(w); });
  glfwSetWindowIconifyCallback(window_, [](GLFWwindow* w, int) { note(w); });
  glfwSetWindowCloseCallback(window_, [](GLFWwindow* w) { note(w); });
  glfwSetDropCallback(window_, [](GLFWwindow* w, int count, const char** paths) {
    auto& dropped = events(w).dropped;
    dropped.insert(dropped.end(), paths, paths + count);
    note(w);
  });
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // ViewState persists the layout
  ImGui_ImplGlfw_InitForOpenGL(window_, true);
  ImGui_ImplOpenGL3_Init("#version 330 core");
  framebuffer_ = std::make_unique<CachedFramebuffer>();
}

Window::~Window() {
  framebuffer_.reset();
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
  glfwDestroyWindow(window_);
  glfwTerminate();
}

void Window::wake() noexcept { glfwPostEmptyEvent(); }

void Window::wait(double seconds) {
  if (seconds > 0)
    glfwWaitEventsTimeout(seconds);
  else
    glfwPollEvents();
}

void Window::renew_fonts() {
  ImGui_ImplOpenGL3_DestroyFontsTexture();  // the next frame makes it again
  framebuffer_->reset();
}

void Window::begin_frame() {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
}

void Window::end_frame(const cv::Scalar& background, std::span<const TextureId> renewed,
                       const std::function<void()>& before_show) {
  ImGui::Render();
  const bool drawn = framebuffer_->draw(*ImGui::GetDrawData(), background, renewed);
  before_show();
  if (!std::exchange(events_.exposed, false) && !drawn) return;
  framebuffer_->show();
  glfwSwapBuffers(window_);
}

cv::Mat3b Window::picture() const { return framebuffer_->read_pixels(); }

bool Window::should_close() const { return glfwWindowShouldClose(window_) == GLFW_TRUE; }
void Window::close() { glfwSetWindowShouldClose(window_, GLFW_TRUE); }

bool Window::hidden() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  return width == 0 || height == 0 || glfwGetWindowAttrib(window_, GLFW_ICONIFIED) == GLFW_TRUE;
}

double Window::screen_scale() const {
  float x = 1, y = 1;
  glfwGetWindowContentScale(window_, &x, &y);
  return static_cast<double>(std::max({x, y, 1.0F}));
}

cv::Size Window::size() const {
  cv::Size size;
  glfwGetWindowSize(window_, &size.width, &size.height);
  return size;
}

// GLFW for Wayland lacks the function, so it is not linked.
std::string Window::portal_name() const {
  const auto id = reinterpret_cast<unsigned long (*)(GLFWwindow*)>(::dlsym(RTLD_DEFAULT, "glfwGetX11Window"));
  const unsigned long window = id == nullptr ? 0 : id(window_);
  return window == 0 ? "" : fmt::format("x11:{:x}", window);
}

void Window::set_title(const std::string& title) { glfwSetWindowTitle(window_, title.c_str()); }

std::vector<std::string> Window::take_dropped() { return std::exchange(events_.dropped, {}); }

std::vector<Window::KeyPress> Window::take_keys() { return std::exchange(events_.keys, {}); }

bool Window::take_event() { return std::exchange(events_.any, false); }

}  // namespace saccade
