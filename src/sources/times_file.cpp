#include "sources/times_file.hpp"

#include <charconv>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/file.hpp"

namespace saccade {
namespace {

// Reads a number and the blanks after it from the front of `text`; false if there is none.
bool take_number(std::string_view& text, std::int64_t& number) {
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (code != std::errc{}) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r"), text.size()));
  return true;
}

}  // namespace

std::map<std::int64_t, std::int64_t> read_times(const std::filesystem::path& file) {
  std::map<std::int64_t, std::int64_t> times;
  std::error_code code;
  if (!std::filesystem::exists(file, code)) return times;
  const auto bytes = read_file(file, 256u << 20);
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.empty() || line[0] == '#' || line == "\r") continue;
    std::int64_t frame = 0, time_us = 0;
    if (!take_number(line, frame) || !take_number(line, time_us) || !line.empty())
      throw unreadable("not a 'number microseconds' line", fmt::format("{}:{}", file.string(), number),
                       "fix or delete the file; without it, frames have 30 a second");
    if (time_us < -kFarthestTime_us || time_us > kFarthestTime_us)
      throw unreadable("a time more than 30 years from 0", fmt::format("{}:{}", file.string(), number),
                       "fix or delete the file; without it, frames have 30 a second");
    times[frame] = time_us;
  }
  return times;
}

}  // namespace saccade
