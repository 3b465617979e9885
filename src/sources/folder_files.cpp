#include "sources/folder_files.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "core/file.hpp"
#include "sources/source_kind.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kDigits = "0123456789";

std::pair<std::string, std::string> natural_parts(const std::string& name) {
  const auto digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  const auto begin = std::find_if_not(name.rbegin(), name.rend(), digit).base();
  const auto number = std::find_if(begin, name.end(), [](char c) { return c != '0'; });
  return {{name.begin(), begin}, {number, name.end()}};
}

std::optional<std::int64_t> number_of(std::string_view digits) {
  std::int64_t number = 0;
  const auto [stop, code] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return code == std::errc{} ? std::optional(number) : std::nullopt;
}

}  // namespace

bool NaturalOrder::operator()(const std::string& a, const std::string& b) const {
  const auto [text_a, number_a] = natural_parts(a);
  const auto [text_b, number_b] = natural_parts(b);
  if (text_a != text_b) return text_a < text_b;
  if (number_a.size() != number_b.size()) return number_a.size() < number_b.size();
  return number_a != number_b ? number_a < number_b : a < b;
}

FilesByStem files_of(const fs::path& folder, const std::vector<std::string>& endings) {
  FilesByStem files;
  if (!fs::is_directory(folder)) return files;
  std::vector<fs::path> paths;
  for (const auto& file : fs::directory_iterator(folder)) paths.push_back(file.path());
  std::sort(paths.begin(), paths.end());  // the same one of two with one stem, on every machine
  for (const fs::path& path : paths)
    if (std::find(endings.begin(), endings.end(), ending_of(path)) != endings.end())
      files.emplace(path.stem().string(), path);
  return files;
}

fs::path first_folder(const fs::path& parent, const std::vector<std::string_view>& names) {
  std::error_code code;
  for (const std::string_view name : names)
    if (fs::is_directory(parent / name, code)) return parent / name;
  return {};
}

std::optional<std::int64_t> last_number(std::string_view name) {
  const std::size_t end = name.find_last_of(kDigits);
  if (end == std::string_view::npos) return std::nullopt;
  const std::size_t before = name.find_last_not_of(kDigits, end);
  const std::size_t begin = before == std::string_view::npos ? 0 : before + 1;
  return number_of(name.substr(begin, end + 1 - begin));
}

std::optional<std::int64_t> first_number(std::string_view name) {
  const std::size_t begin = name.find_first_of(kDigits);
  if (begin == std::string_view::npos) return std::nullopt;
  const std::size_t end = std::min(name.find_first_not_of(kDigits, begin), name.size());
  return number_of(name.substr(begin, end - begin));
}

std::vector<double> read_numbers(const fs::path& file, std::uintmax_t largest_file) {
  const auto bytes = read_file(file, largest_file);
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  std::vector<double> numbers;
  constexpr std::string_view kBlank = " \t\r\n,";
  while (!text.empty()) {
    const std::size_t begin = std::min(text.find_first_not_of(kBlank), text.size());
    text.remove_prefix(begin);
    if (text.empty()) break;
    double number = 0;
    if (text[0] == '+') text.remove_prefix(1);
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (code != std::errc{}) throw unreadable("not only numbers", file.string(), "fix or delete it");
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    numbers.push_back(number);
  }
  return numbers;
}

Intrinsics read_camera_matrix(const fs::path& file) {
  const std::vector<double> m = read_numbers(file);
  const std::size_t row = m.size() == 16 ? 4 : 3;
  if (m.size() < 3 * row) throw unreadable("not a 3 x 3 or 4 x 4 matrix", file.string(), "fix or delete it");
  const Intrinsics camera{m[0], m[row + 1], m[2], m[row + 2], IntrinsicsOrigin::file};
  if (!camera.valid()) throw unreadable("not the matrix of a camera", file.string(), "fix or delete it");
  return camera;
}

}  // namespace saccade
