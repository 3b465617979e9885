#pragma once

#include <sys/types.h>
#include <systemd/sd-bus.h>

#include <atomic>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace saccade {

/// A session bus of its own with a desktop on it, whose file dialogs answer at once with what a test has
/// prepared.
class FakeDesktop {
 public:
  FakeDesktop() = default;
  ~FakeDesktop();
  FakeDesktop(const FakeDesktop&) = delete;
  FakeDesktop& operator=(const FakeDesktop&) = delete;

  /// Starts the bus, with its files in `folder`; false where dbus-daemon is missing or does not start. Once.
  bool start(const std::filesystem::path& folder);

  /// Ends the bus.
  void stop();

  /// For DBUS_SESSION_BUS_ADDRESS.
  const std::string& address() const { return address_; }

  /// How the next dialogs end.
  enum class End {
    chosen,     ///< with this URI
    cancelled,  ///< by the user
    refused,    ///< the dialog cannot be shown
    never,      ///< the dialog stays
  };
  void answer(End end, const std::string& uri = "");

  /// A dialog as it was requested.
  struct Shown {
    std::string method, parent, title, folder, name;
    bool directory = false;
  };
  [[nodiscard]] std::vector<Shown> shown() const;

 private:
  static int on_dialog(sd_bus_message* call, void* desktop, sd_bus_error* error);
  void serve(sd_bus* bus);

  pid_t daemon_ = -1;
  std::string address_;
  std::atomic<bool> stopped_ = false;
  std::thread thread_;
  mutable std::mutex mutex_;
  // Guarded by mutex_:
  End end_ = End::cancelled;
  std::string uri_;
  std::vector<Shown> shown_;
};

}  // namespace saccade
