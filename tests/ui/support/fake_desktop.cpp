#include "fake_desktop.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <fstream>

namespace saccade {
namespace {

constexpr const char* kName = "org.freedesktop.portal.Desktop";
constexpr const char* kPath = "/org/freedesktop/portal/desktop";

int read_version(sd_bus*, const char*, const char*, const char*, sd_bus_message* reply, void*,
                 sd_bus_error*) {
  return sd_bus_message_append(reply, "u", 3);
}

FakeDesktop::Shown read_call(sd_bus_message* call) {
  FakeDesktop::Shown shown;
  const char *parent = "", *title = "", *key = "";
  sd_bus_message_read(call, "ss", &parent, &title);
  shown.method = sd_bus_message_get_member(call);
  shown.parent = parent;
  shown.title = title;
  sd_bus_message_enter_container(call, 'a', "{sv}");
  while (sd_bus_message_enter_container(call, 'e', "sv") > 0) {
    sd_bus_message_read(call, "s", &key);
    if (std::strcmp(key, "directory") == 0) {
      int directory = 0;
      sd_bus_message_read(call, "v", "b", &directory);
      shown.directory = directory != 0;
    } else if (std::strcmp(key, "current_name") == 0) {
      const char* name = "";
      sd_bus_message_read(call, "v", "s", &name);
      shown.name = name;
    } else if (std::strcmp(key, "current_folder") == 0) {
      const void* bytes = nullptr;
      std::size_t size = 0;
      sd_bus_message_enter_container(call, 'v', "ay");
      sd_bus_message_read_array(call, 'y', &bytes, &size);
      sd_bus_message_exit_container(call);
      if (size > 0) shown.folder.assign(static_cast<const char*>(bytes), size - 1);
    } else {
      sd_bus_message_skip(call, "v");
    }
    sd_bus_message_exit_container(call);
  }
  return shown;
}

}  // namespace

FakeDesktop::~FakeDesktop() { stop(); }

void FakeDesktop::stop() {
  stopped_ = true;
  if (daemon_ > 0) {
    ::kill(daemon_, SIGTERM);
    ::waitpid(daemon_, nullptr, 0);
    daemon_ = -1;
  }
  if (thread_.joinable()) thread_.join();
}

bool FakeDesktop::start(const std::filesystem::path& folder) {
  address_ = "unix:path=" + (folder / "bus").string();
  const std::string config = (folder / "bus.conf").string();
  std::ofstream(config) << "<busconfig><type>session</type><listen>" << address_
                        << "</listen><policy context='default'><allow send_destination='*' "
                           "eavesdrop='true'/><allow eavesdrop='true'/>"
                           "<allow own='*'/></policy></busconfig>";
  daemon_ = ::fork();
  if (daemon_ == 0) {
    ::execlp("dbus-daemon", "dbus-daemon", "--nofork", ("--config-file=" + config).c_str(), nullptr);
    ::_exit(127);
  }
  static const sd_bus_vtable kChooser[] = {
      SD_BUS_VTABLE_START(0), SD_BUS_PROPERTY("version", "u", read_version, 0, SD_BUS_VTABLE_PROPERTY_CONST),
      SD_BUS_METHOD("OpenFile", "ssa{sv}", "o", on_dialog, SD_BUS_VTABLE_UNPRIVILEGED),
      SD_BUS_METHOD("SaveFile", "ssa{sv}", "o", on_dialog, SD_BUS_VTABLE_UNPRIVILEGED), SD_BUS_VTABLE_END};
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (std::chrono::steady_clock::now() < end && ::waitpid(daemon_, nullptr, WNOHANG) == 0) {
    sd_bus* bus = nullptr;
    sd_bus_new(&bus);
    sd_bus_set_address(bus, address_.c_str());
    sd_bus_set_bus_client(bus, 1);
    if (sd_bus_start(bus) >= 0 &&
        sd_bus_add_object_vtable(bus, nullptr, kPath, "org.freedesktop.portal.FileChooser", kChooser, this) >=
            0 &&
        sd_bus_request_name(bus, kName, 0) >= 0) {
      thread_ = std::thread([this, bus] { serve(bus); });
      return true;
    }
    sd_bus_unref(bus);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return false;
}

void FakeDesktop::answer(End end, const std::string& uri) {
  const std::lock_guard lock(mutex_);
  end_ = end;
  uri_ = uri;
}

std::vector<FakeDesktop::Shown> FakeDesktop::shown() const {
  const std::lock_guard lock(mutex_);
  return shown_;
}

void FakeDesktop::serve(sd_bus* bus) {
  while (!stopped_ && sd_bus_process(bus, nullptr) >= 0) sd_bus_wait(bus, 20'000);
  sd_bus_close_unref(bus);
}

int FakeDesktop::on_dialog(sd_bus_message* call, void* desktop, sd_bus_error* error) {
  FakeDesktop& self = *static_cast<FakeDesktop*>(desktop);
  const std::lock_guard lock(self.mutex_);
  self.shown_.push_back(read_call(call));
  if (self.end_ == End::refused)
    return sd_bus_error_set(error, "org.freedesktop.portal.Error.Failed", "no screen");
  const std::string handle = std::string(kPath) + "/request/" + std::to_string(self.shown_.size());
  if (const int problem = sd_bus_reply_method_return(call, "o", handle.c_str()); problem < 0) return problem;
  if (self.end_ == End::never) return 1;
  sd_bus* bus = sd_bus_message_get_bus(call);
  const char* interface = "org.freedesktop.portal.Request";
  sd_bus_emit_signal(bus, "/other/request", interface, "Response", "ua{sv}", 0, 0);  // another program's
  return self.end_ == End::cancelled
             ? sd_bus_emit_signal(bus, handle.c_str(), interface, "Response", "ua{sv}", 1, 0)
             : sd_bus_emit_signal(bus, handle.c_str(), interface, "Response", "ua{sv}", 0, 2, "choices",
                                  "a(ss)", 0, "uris", "as", 1, self.uri_.c_str());
}

}  // namespace saccade
