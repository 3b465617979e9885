#include "x_desktop.hpp"

#include <X11/Xlib.h>
#include <X11/Xutil.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <thread>

namespace saccade {
namespace {

constexpr long kVersion = 5;

Window find_window(Display* display, Window root, const std::string& name) {
  XClassHint hint{};
  if (XGetClassHint(display, root, &hint) != 0) {
    const bool found = name == hint.res_class || name == hint.res_name;
    XFree(hint.res_class);
    XFree(hint.res_name);
    if (found) return root;
  }
  Window parent = 0, top = 0, *children = nullptr, found = 0;
  unsigned count = 0;
  if (XQueryTree(display, root, &top, &parent, &children, &count) == 0) return 0;
  for (unsigned i = 0; i < count && found == 0; ++i) found = find_window(display, children[i], name);
  if (children != nullptr) XFree(children);
  return found;
}

}  // namespace

struct XDesktop::Client {
  Display* display;
  Window target = 0, own = 0;

  Atom atom(const char* name) const { return XInternAtom(display, name, False); }
  void send(const char* message, long word_1, long word_2, long word_3, long word_4) const;
  void give(const XSelectionRequestEvent& request, const std::string& text) const;
  bool wait_for(const char* message, const std::string& text, XClientMessageEvent& answer) const;
  bool next_event(XEvent& event) const;
  std::string copied;

  explicit Client(const std::string& name) : display(XOpenDisplay(name.c_str())) {
    if (display == nullptr) throw std::runtime_error("no display " + name);
  }
  ~Client() { XCloseDisplay(display); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;
};

XDesktop::XDesktop(const std::string& display, const std::string& window_class)
    : client_(std::make_unique<Client>(display)) {
  const Window root = DefaultRootWindow(client_->display);
  client_->target = find_window(client_->display, root, window_class);
  if (client_->target == 0) throw std::runtime_error("no window of class " + window_class);
  client_->own = XCreateSimpleWindow(client_->display, root, 0, 0, 1, 1, 0, 0, 0);
}

XDesktop::~XDesktop() = default;

void XDesktop::Client::send(const char* message, long word_1, long word_2, long word_3, long word_4) const {
  XEvent event{};
  event.xclient.type = ClientMessage;
  event.xclient.window = target;
  event.xclient.message_type = atom(message);
  event.xclient.format = 32;
  const long words[] = {static_cast<long>(own), word_1, word_2, word_3, word_4};
  std::copy(std::begin(words), std::end(words), event.xclient.data.l);
  XSendEvent(display, target, False, NoEventMask, &event);
  XFlush(display);
}

// Hands over what is dropped.
void XDesktop::Client::give(const XSelectionRequestEvent& request, const std::string& text) const {
  XChangeProperty(display, request.requestor, request.property, request.target, 8, PropModeReplace,
                  reinterpret_cast<const unsigned char*>(text.data()), static_cast<int>(text.size()));
  XEvent event{};
  event.xselection.type = SelectionNotify;
  event.xselection.requestor = request.requestor;
  event.xselection.selection = request.selection;
  event.xselection.target = request.target;
  event.xselection.property = request.property;
  event.xselection.time = request.time;
  XSendEvent(display, request.requestor, False, NoEventMask, &event);
  XFlush(display);
}

bool XDesktop::Client::wait_for(const char* message, const std::string& text,
                                XClientMessageEvent& answer) const {
  const Atom awaited = atom(message);
  for (XEvent event; next_event(event);) {
    if (event.type == SelectionRequest) give(event.xselectionrequest, text);
    if (event.type != ClientMessage || event.xclient.message_type != awaited) continue;
    answer = event.xclient;
    return true;
  }
  return false;
}

// False if none comes within a minute.
bool XDesktop::Client::next_event(XEvent& event) const {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (XPending(display) == 0) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  XNextEvent(display, &event);
  return true;
}

void XDesktop::copy(const std::string& text) {
  client_->copied = text;
  XSetSelectionOwner(client_->display, client_->atom("CLIPBOARD"), client_->own, CurrentTime);
  XSync(client_->display, False);
}

bool XDesktop::paste() {
  for (XEvent event; client_->next_event(event);) {
    if (event.type != SelectionRequest) continue;
    client_->give(event.xselectionrequest, client_->copied);
    return true;
  }
  return false;
}

bool XDesktop::drop(const std::filesystem::path& file) {
  const Client& c = *client_;
  const std::string text = "file://" + file.string() + "\r\n";
  const auto list = static_cast<long>(c.atom("text/uri-list")),
             copy = static_cast<long>(c.atom("XdndActionCopy"));
  XSetSelectionOwner(c.display, c.atom("XdndSelection"), c.own, CurrentTime);
  c.send("XdndEnter", kVersion << 24, list, 0, 0);
  c.send("XdndPosition", 0, 100 << 16 | 100, CurrentTime, copy);
  XClientMessageEvent answer{};
  if (!c.wait_for("XdndStatus", text, answer) || (answer.data.l[1] & 1) == 0) return false;
  c.send("XdndDrop", 0, CurrentTime, 0, 0);
  return c.wait_for("XdndFinished", text, answer);
}

void XDesktop::set_minimised(bool minimised) {
  const Client& c = *client_;
  const Atom state = c.atom("WM_STATE");
  const long words[] = {minimised ? IconicState : NormalState, 0};
  XChangeProperty(c.display, c.target, state, state, 32, PropModeReplace,
                  reinterpret_cast<const unsigned char*>(words), 2);
  minimised ? XUnmapWindow(c.display, c.target) : XMapWindow(c.display, c.target);
  XSync(c.display, False);
}

}  // namespace saccade
