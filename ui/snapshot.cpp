#include "ui/snapshot.hpp"

#include <ctime>

#include <fmt/format.h>

#include "app/fixations_json.hpp"
#include "app/frame_writer.hpp"
#include "core/error.hpp"
#include "core/file.hpp"

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

fs::path write_snapshot(const fs::path& base, const Result& result, const OverlayStyle& style,
                        std::chrono::system_clock::time_point now) {
  const fs::path folder = unused_path(base, "snapshot", "", now);
  std::error_code code;
  fs::create_directories(folder, code);
  if (code)
    throw failed("cannot make a folder: " + code.message(), folder.string(), "is its parent writable?");
  write_frame(folder, result, {"maps", "overlay"}, 0, style);
  write_file(folder / fmt::format("{:06}_fixations.json", result.frame.index), fixations_json(result) + "\n");
  return folder;
}

}  // namespace saccade
