#include "ui/session/file_portal.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <systemd/sd-bus.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <mutex>
#include <utility>

#include "ui/session/typed_path.hpp"

namespace saccade {
namespace {

constexpr const char* kPortal = "org.freedesktop.portal.Desktop";
constexpr const char* kPath = "/org/freedesktop/portal/desktop";
constexpr const char* kChooser = "org.freedesktop.portal.FileChooser";

struct Unref {
  void operator()(sd_bus* bus) const { sd_bus_close_unref(bus); }
  void operator()(sd_bus_message* message) const { sd_bus_message_unref(message); }
};
using BusHandle = std::unique_ptr<sd_bus, Unref>;
using Message = std::unique_ptr<sd_bus_message, Unref>;

// The entry "current_folder" of the options: a path is bytes that end with a zero, since it need not be
// UTF-8.
int append_folder(sd_bus_message* message, const std::string& folder) {
  int problem = sd_bus_message_open_container(message, 'e', "sv");
  if (problem >= 0) problem = sd_bus_message_append(message, "s", "current_folder");
  if (problem >= 0) problem = sd_bus_message_open_container(message, 'v', "ay");
  if (problem >= 0) problem = sd_bus_message_append_array(message, 'y', folder.c_str(), folder.size() + 1);
  if (problem >= 0) problem = sd_bus_message_close_container(message);
  return problem < 0 ? problem : sd_bus_message_close_container(message);
}

// Of the dialog's call; negative: an errno.
int append_arguments(sd_bus_message* message, const FileDialog& dialog) {
  int problem = sd_bus_message_append(message, "ss", dialog.parent.c_str(), dialog.title.c_str());
  if (problem >= 0) problem = sd_bus_message_open_container(message, 'a', "{sv}");
  if (problem >= 0 && dialog.kind == FileDialog::Kind::open_folder)
    problem = sd_bus_message_append(message, "{sv}", "directory", "b", 1);
  if (problem >= 0 && !dialog.name.empty())
    problem = sd_bus_message_append(message, "{sv}", "current_name", "s", dialog.name.c_str());
  if (problem >= 0 && !dialog.folder.empty()) problem = append_folder(message, dialog.folder);
  return problem < 0 ? problem : sd_bus_message_close_container(message);
}

// The first of the "uris" in the results of a dialog; empty = there is none.
std::string first_uri(sd_bus_message* message) {
  const char *key = nullptr, *uri = nullptr;
  if (sd_bus_message_enter_container(message, 'a', "{sv}") < 0) return "";
  while (sd_bus_message_enter_container(message, 'e', "sv") > 0) {
    if (sd_bus_message_read(message, "s", &key) < 0) return "";
    if (std::strcmp(key, "uris") == 0) {
      const bool found = sd_bus_message_enter_container(message, 'v', "as") > 0 &&
                         sd_bus_message_enter_container(message, 'a', "s") > 0 &&
                         sd_bus_message_read(message, "s", &uri) > 0;
      return found ? uri : "";
    }
    if (sd_bus_message_skip(message, "v") < 0 || sd_bus_message_exit_container(message) < 0) return "";
  }
  return "";
}

std::string words_of(const sd_bus_error* error, int code) {
  return error != nullptr && error->message != nullptr ? error->message : std::strerror(std::abs(code));
}

}  // namespace

// The bus, on its thread, and what both threads know.
class FilePortal::Bus {
 public:
  struct Answer {
    std::string path, error;  // both empty: the user has cancelled
  };

  explicit Bus(std::function<void()> wake) : wake_(std::move(wake)), event_(::eventfd(0, EFD_CLOEXEC)) {}
  ~Bus() { ::close(event_); }
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  bool available() const { return available_; }

  void show(const FileDialog& dialog) {
    {
      const std::lock_guard lock(mutex_);
      to_show_ = dialog;
    }
    stir();
  }

  std::optional<Answer> take_answer() {
    const std::lock_guard lock(mutex_);
    return std::exchange(answer_, std::nullopt);
  }

  // Ends a wait of the thread.
  void stir() const {
    const std::uint64_t one = 1;
    [[maybe_unused]] const ssize_t written = ::write(event_, &one, sizeof one);
  }

  // The thread.
  void work(const std::stop_token& token) {
    sd_bus* opened = nullptr;
    if (sd_bus_open_user(&opened) < 0) return;
    const BusHandle bus(opened);
    if (sd_bus_match_signal_async(bus.get(), nullptr, kPortal, nullptr, "org.freedesktop.portal.Request",
                                  "Response", on_response, nullptr, this) < 0 ||
        sd_bus_call_method_async(bus.get(), nullptr, kPortal, kPath, "org.freedesktop.DBus.Properties", "Get",
                                 on_version, this, "ss", kChooser, "version") < 0)
      return;
    while (!token.stop_requested() && process(bus.get())) wait(bus.get());
    available_ = false;
    if (!token.stop_requested()) answer({"", "the connection to the desktop's session bus is lost"});
  }

 private:
  // False if the connection is lost.
  bool process(sd_bus* bus) {
    int more = 0;
    do more = sd_bus_process(bus, nullptr);
    while (more > 0);
    std::optional<FileDialog> dialog;
    {
      const std::lock_guard lock(mutex_);
      dialog = std::exchange(to_show_, std::nullopt);
    }
    if (dialog) call(bus, *dialog);
    return more >= 0;
  }

  void wait(sd_bus* bus) const {
    std::uint64_t until_us = 0;
    sd_bus_get_timeout(bus, &until_us);
    int timeout_ms = -1;
    if (until_us != UINT64_MAX) {
      timespec now{};
      ::clock_gettime(CLOCK_MONOTONIC, &now);
      const auto now_us =
          static_cast<std::uint64_t>(now.tv_sec) * 1'000'000 + static_cast<std::uint64_t>(now.tv_nsec) / 1000;
      timeout_ms = until_us > now_us ? static_cast<int>((until_us - now_us) / 1000 + 1) : 0;
    }
    pollfd waiting[] = {{sd_bus_get_fd(bus), static_cast<short>(sd_bus_get_events(bus)), 0},
                        {event_, POLLIN, 0}};
    if (::poll(waiting, 2, timeout_ms) <= 0 || (waiting[1].revents & POLLIN) == 0) return;
    std::uint64_t count = 0;
    [[maybe_unused]] const ssize_t read = ::read(event_, &count, sizeof count);
  }

  void call(sd_bus* bus, const FileDialog& dialog) {
    const char* method = dialog.kind == FileDialog::Kind::save_file ? "SaveFile" : "OpenFile";
    sd_bus_message* made = nullptr;
    int problem = sd_bus_message_new_method_call(bus, &made, kPortal, kPath, kChooser, method);
    const Message message(made);
    if (problem >= 0) problem = append_arguments(made, dialog);
    if (problem >= 0) problem = sd_bus_call_async(bus, nullptr, made, on_shown, this, 0);
    if (problem < 0) answer({"", words_of(nullptr, problem)});
  }

  void answer(Answer answer) {
    {
      const std::lock_guard lock(mutex_);
      answer_ = std::move(answer);
    }
    wake_();
  }

  static int on_version(sd_bus_message* reply, void* bus, sd_bus_error*) {
    Bus& self = *static_cast<Bus*>(bus);
    if (sd_bus_message_is_method_error(reply, nullptr) > 0) return 0;
    self.available_ = true;
    self.wake_();
    return 0;
  }

  // The dialog has a handle, the object that will report its end.
  static int on_shown(sd_bus_message* reply, void* bus, sd_bus_error*) {
    Bus& self = *static_cast<Bus*>(bus);
    const char* handle = nullptr;
    if (const sd_bus_error* error = sd_bus_message_get_error(reply); error != nullptr)
      self.answer({"", words_of(error, EIO)});
    else if (const int problem = sd_bus_message_read(reply, "o", &handle); problem < 0)
      self.answer({"", words_of(nullptr, problem)});
    else
      self.handle_ = handle;
    return 0;
  }

  static int on_response(sd_bus_message* message, void* bus, sd_bus_error*) {
    Bus& self = *static_cast<Bus*>(bus);
    const char* path = sd_bus_message_get_path(message);
    if (path == nullptr || self.handle_ != path) return 0;  // of another request, or to another program
    self.handle_.clear();
    std::uint32_t code = 0;
    if (sd_bus_message_read(message, "u", &code) < 0 || code != 0) {
      self.answer({});
      return 0;
    }
    const std::string uri = first_uri(message);
    std::string file = uri.starts_with("file://") ? typed_path(uri) : "";
    if (file.empty())
      self.answer({"", "only files of this computer can be used: " + uri});
    else
      self.answer({std::move(file), ""});
    return 0;
  }

  const std::function<void()> wake_;
  const int event_;
  std::atomic<bool> available_ = false;
  std::string handle_;  // of the open dialog; the bus's thread only
  std::mutex mutex_;
  std::optional<FileDialog> to_show_;  // guarded by mutex_
  std::optional<Answer> answer_;       // guarded by mutex_
};

FilePortal::FilePortal(std::function<void()> wake) : bus_(std::make_unique<Bus>(std::move(wake))) {
  thread_ = std::jthread([this](const std::stop_token& token) { bus_->work(token); });
}

FilePortal::~FilePortal() {
  thread_.request_stop();
  bus_->stir();
}

bool FilePortal::available() const { return bus_->available(); }

void FilePortal::show(const FileDialog& dialog, std::function<void(const std::string&)> chosen) {
  if (busy() || !available()) return;
  chosen_ = std::move(chosen);
  bus_->show(dialog);
}

std::string FilePortal::poll() {
  const std::optional<Bus::Answer> answer = bus_->take_answer();
  if (!answer) return "";
  const auto chosen = std::exchange(chosen_, nullptr);
  if (!chosen) return "";
  if (!answer->error.empty()) return "The desktop's file dialog failed: " + answer->error;
  if (!answer->path.empty()) chosen(answer->path);
  return "";
}

}  // namespace saccade
