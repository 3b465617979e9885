#include "ui/session/snapshot.hpp"

#include <ctime>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/file.hpp"
#include "output/fixations_json.hpp"
#include "output/frame_writer.hpp"

namespace saccade {
namespace fs = std::filesystem;

fs::path unused_path(const fs::path& base, const std::string& stem, const std::string& ending,
                     std::chrono::system_clock::time_point now) {
  const std::time_t seconds = std::chrono::system_clock::to_time_t(now);
  std::tm local{};
  localtime_r(&seconds, &local);
  std::string time(32, '\0');
  time.resize(std::strftime(time.data(), time.size(), "%Y%m%d-%H%M%S", &local));
  fs::path path = base / fmt::format("{}-{}{}", stem, time, ending);
  std::error_code code;
  for (int i = 2; fs::exists(path, code); ++i) path = base / fmt::format("{}-{}-{}{}", stem, time, i, ending);
  return path;
}

namespace {

void write_side(const fs::path& folder, const Computed& computed, const OverlayStyle& style) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (code)
    throw failed("cannot make a folder: " + code.message(), folder.string(), "is its parent writable?");
  const Result& result = computed.result;
  Settings settings = computed.settings;
  settings.overlay = style;
  write_frame(folder, result, {"maps", "overlay", "depth", "colour", "cloud"}, 0, style);
  write_file(folder / fmt::format("{:06}_fixations.json", result.frame.index), fixations_json(result) + "\n");
  write_file(folder / "settings.toml", std::string_view(settings_toml(settings)));
}

}  // namespace

fs::path write_snapshot(const fs::path& base, const ViewResult& result, const OverlayStyle& style,
                        std::chrono::system_clock::time_point now) {
  fs::path folder = unused_path(base, "snapshot", "", now);
  write_side(result.compared ? folder / "a" : folder, result.a, style);
  if (result.compared) write_side(folder / "b", result.b, style);
  return folder;
}

}  // namespace saccade
