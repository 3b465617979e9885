#include "app/view_command.hpp"

#include <malloc.h>

#include <cstdio>
#include <memory>

#include <spdlog/spdlog.h>

#include "app/command.hpp"
#include "app/doctor.hpp"
#include "app/interrupt.hpp"
#include "app/options.hpp"
#include "app/source_option.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "drivers/openni2/openni2_devices.hpp"
#include "sources/open_source.hpp"
#include "ui/window/viewer.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

constexpr double kSmallestScale = 0.5, kLargestScale = 4;

struct ViewArguments {
  std::string source, size, screenshot, log;
  std::int64_t after_frames = 1;
  double ui_scale = 0;
  bool paused = false;
};

std::vector<DeviceChoice> connected_sensors() {
  std::vector<DeviceChoice> choices;
  for (const DeviceListing& device : list_devices())
    choices.push_back({device.identity.name.empty() ? device.identity.uri : device.identity.name,
                       device.source, device.driver.empty() ? device.identity.vendor : device.driver});
  return choices;
}

std::vector<std::string> sensor_advice() {
  std::vector<std::string> lines;
  for (const Problem& problem : diagnose(examine("/sys")))
    lines.push_back(problem.what + ": " + problem.remedy);
  return lines;
}

cv::Size parse_size(const std::string& text) {
  int width = 0, height = 0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest) != 2 || width < 480 || height < 360 ||
      width > 16384 || height > 16384)
    throw usage_error("bad value for size", "'" + text + "'", "expected WxH from 480x360 to 16384x16384");
  return {width, height};
}

// Restores the state of the last session. The viewer starts even if the file cannot be read.
void load_state(ViewState& state, const fs::path& file) {
  std::error_code code;
  if (file.empty() || !fs::exists(file, code)) return;
  try {
    const auto bytes = read_file(file, 1u << 20);
    apply_view_state(state, {bytes.begin(), bytes.end()});
  } catch (const Error& error) {
    spdlog::warn("{}", error.what());
  }
}

void save_state(const ViewState& state, const fs::path& file) {
  if (file.empty()) return;
  std::error_code code;
  fs::create_directories(file.parent_path(), code);
  try {
    write_file(file, std::string_view(view_state_json(state)));
  } catch (const Error& error) {
    spdlog::warn("{}", error.what());
  }
}

// Images come and go with every frame. By default the C library returns their memory to the kernel, and the
// page faults of the next images are half of the drawing thread's time.
void keep_freed_memory() {
  ::mallopt(M_MMAP_THRESHOLD, 32 << 20);
  ::mallopt(M_TRIM_THRESHOLD, 256 << 20);
}

void view(const ViewArguments& arguments, const SettingsOptions& options) {
  if (arguments.paused && arguments.after_frames > 1)
    throw usage_error("a paused viewer computes one frame only", "--after-frames", "leave out --paused");
  keep_freed_memory();
  ViewState state;
  const fs::path folder = config_folder(), file = folder.empty() ? fs::path() : folder / "viewer.json";
  load_state(state, file);
  Settings& settings = state.settings.a = options.resolve(state.settings.a);
  share_source(state.settings);
  if (arguments.ui_scale > 0) state.ui_scale = arguments.ui_scale;
  set_log_level(settings);

  ViewerOptions viewer_options;
  viewer_options.source = {
      arguments.source, {settings.start, settings.every, settings.frames}, settings.sensor};
  std::error_code code;
  viewer_options.example = find_bundled_recording(fs::read_symlink("/proc/self/exe", code)).string();
  viewer_options.welcome = arguments.source.empty() && arguments.screenshot.empty();
  if (arguments.source.empty()) viewer_options.source.uri = viewer_options.example;
  if (viewer_options.source.uri.empty() && !arguments.screenshot.empty())
    throw usage_error("nothing to show", "--screenshot", "name a SOURCE; the bundled recording is not there");
  if (!arguments.size.empty()) viewer_options.size = parse_size(arguments.size);
  viewer_options.screenshot = arguments.screenshot;
  viewer_options.after_frames = arguments.after_frames;
  viewer_options.log = arguments.log;
  viewer_options.paused = arguments.paused;

  Interrupt interrupt;
  const auto open = [uri = arguments.source, input = InputSettings(settings)](const std::string& source,
                                                                              const SensorSettings& sensor) {
    return open_source(source, {sensor, source == uri ? input : InputSettings{}});
  };
  Viewer viewer(std::move(state), std::move(viewer_options), open, connected_sensors, sensor_advice);
  const Interrupt::Handler handler(interrupt, [&] { viewer.stop(); });
  viewer.run();
  if (arguments.screenshot.empty()) save_state(viewer.state(), file);
}

}  // namespace

fs::path find_bundled_recording(const fs::path& program) {
  fs::path installed = (program.parent_path() / SACCADE_DATA_FROM_BIN / "table.oni").lexically_normal();
  std::error_code code;  // a folder above may not be readable
  if (fs::exists(installed, code)) return installed;
  for (fs::path folder = program.parent_path(); folder.has_relative_path(); folder = folder.parent_path())
    if (fs::path file = folder / "recordings/table.oni"; fs::exists(file, code)) return file;
  return {};
}

void add_view_command(CLI::App& app, std::function<void()>& action) {
  CLI::App& command =
      *app.add_subcommand("view", "open the viewer: see what attracts attention, and change the settings");
  const auto arguments = std::make_shared<ViewArguments>();
  ViewArguments& a = *arguments;
  add_source_option(command, "SOURCE", a.source,
                    "what to show; see the end of this help [the bundled recording]");
  command.add_option("--size", a.size, "size of the window in pixels; without it, that of the last session")
      ->type_name("WxH");
  command
      .add_option("--ui-scale", a.ui_scale,
                  "size of text and buttons, 1 = normal; 0 = as the screen reports [0]")
      ->type_name("S")
      ->check(CLI::Range(kSmallestScale, kLargestScale) | CLI::IsMember({0.0}));
  command.add_flag("--paused", a.paused, "show the first frame and wait");
  command.add_option("--screenshot", a.screenshot, "write the window as a PNG file and quit")
      ->type_name("FILE");
  command.add_option("--after-frames", a.after_frames, "with --screenshot: after N computed frames [1]")
      ->type_name("N")
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{1'000'000'000}));
  command
      .add_option("--ui-log", a.log,
                  "write a line of JSON for each frame of the window: its duration and its content")
      ->type_name("FILE");
  const auto options = std::make_shared<SettingsOptions>(
      command, AcceptedSettings{{SettingScope::model, SettingScope::attention, SettingScope::tracking,
                                 SettingScope::frames, SettingScope::sensor, SettingScope::program}});
  command.callback(
      [arguments, options, &action] { action = [arguments, options] { view(*arguments, *options); }; });
}

}  // namespace saccade
