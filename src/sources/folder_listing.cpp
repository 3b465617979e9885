#include "sources/folder_listing.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/file.hpp"
#include "sources/osd_listing.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

constexpr const char* kLayoutHint =
    "expected NNNN_depth.png files, a TUM RGB-D folder with depth.txt, or image_color/, depth/, annotation/";

// The number of "NNNN_depth.png"; nothing for another name.
std::optional<std::int64_t> frame_number(const std::string& name) {
  constexpr std::string_view kEnding = "_depth.png";
  if (!name.ends_with(kEnding)) return std::nullopt;
  std::int64_t number = 0;
  const char* end = name.data() + name.size() - kEnding.size();
  const auto [stop, code] = std::from_chars(name.data(), end, number);
  if (code != std::errc{} || stop != end || number < 0) return std::nullopt;
  return number;
}

fs::path first_existing(const fs::path& folder, const std::vector<std::string>& names) {
  for (const std::string& name : names)
    if (fs::exists(folder / name)) return folder / name;
  return {};
}

// "frames 3, 7..9 are missing": what a person needs to know of holes in the numbers.
std::string describe_gaps(const std::map<std::int64_t, FolderEntry>& found) {
  std::vector<std::string> gaps;
  std::int64_t missing = 0, expected = found.begin()->first;
  for (const auto& [number, entry] : found) {
    if (number > expected) {
      missing += number - expected;
      gaps.push_back(number - expected == 1 ? fmt::format("{}", expected)
                                            : fmt::format("{}..{}", expected, number - 1));
    }
    expected = number + 1;
  }
  if (gaps.empty()) return "";
  constexpr std::size_t kShown = 8;
  const std::size_t shown = std::min(kShown, gaps.size());
  std::vector<std::string> first(gaps.begin(), gaps.begin() + static_cast<std::ptrdiff_t>(shown));
  return fmt::format("{} frame{} missing in the numbering: {}{}", missing, missing == 1 ? " is" : "s are",
                     fmt::join(first, ", "), shown < gaps.size() ? ", ..." : "");
}

FolderListing list_numbered(const fs::path& folder) {
  std::map<std::int64_t, FolderEntry> found;
  for (const auto& file : fs::directory_iterator(folder)) {
    const std::string name = file.path().filename().string();
    const auto number = frame_number(name);
    if (!number) continue;
    const std::string stem = name.substr(0, name.find('_'));
    FolderEntry entry;
    entry.name = stem;
    entry.depth = file.path();
    entry.colour = first_existing(folder, {stem + "_rgb.png", stem + "_rgb.jpg", stem + "_rgb.jpeg"});
    entry.label = first_existing(folder, {stem + "_label.png"});
    entry.classes = first_existing(folder, {stem + "_class.png"});
    if (!found.emplace(*number, entry).second)
      throw unreadable("two depth images have the same number", file.path().string(), "rename or remove one");
  }
  if (found.empty()) throw unreadable("no frames in the folder", folder.string(), kLayoutHint);
  FolderListing listing;
  listing.kind = "folder";
  for (auto& [number, entry] : found) {
    entry.timestamp_us =
        std::llround(static_cast<double>(number - found.begin()->first) * 1e6 / listing.rate_hz);
    listing.entries.push_back(entry);
  }
  if (const std::string gaps = describe_gaps(found); !gaps.empty()) listing.notes.push_back(gaps);
  return listing;
}

struct TimedFile {
  double time_s = 0;
  std::string stamp;
  fs::path path;
};

// A TUM list: "timestamp filename" lines, '#' starts a comment.
std::vector<TimedFile> read_tum_list(const fs::path& list) {
  const auto bytes = read_file(list, 256u << 20);
  std::istringstream text(std::string(bytes.begin(), bytes.end()));
  std::vector<TimedFile> files;
  std::string line;
  for (int number = 1; std::getline(text, line); ++number) {
    if (line.empty() || line[0] == '#' || line == "\r") continue;
    std::istringstream fields(line);
    std::string stamp, name;
    fields >> stamp >> name;
    double time_s = 0;
    const auto [end, code] = std::from_chars(stamp.data(), stamp.data() + stamp.size(), time_s);
    if (code != std::errc{} || end != stamp.data() + stamp.size() || !std::isfinite(time_s) || name.empty())
      throw unreadable("not a 'timestamp filename' line", fmt::format("{}:{}", list.string(), number),
                       kLayoutHint);
    files.push_back({time_s, stamp, list.parent_path() / name});
  }
  std::stable_sort(files.begin(), files.end(),
                   [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
  return files;
}

FolderListing list_tum(const fs::path& folder) {
  constexpr double kUnitsPerMetre = 5000, kSameMoment_s = 0.02;
  FolderListing listing;
  listing.kind = "tum";
  listing.mm_per_unit = 1000 / kUnitsPerMetre;
  const auto depth = read_tum_list(folder / "depth.txt");
  if (depth.empty()) throw unreadable("no frames in the list", (folder / "depth.txt").string(), kLayoutHint);
  std::vector<TimedFile> colour;
  if (fs::exists(folder / "rgb.txt")) colour = read_tum_list(folder / "rgb.txt");
  std::size_t without = 0;
  for (const TimedFile& file : depth) {
    FolderEntry entry{
        file.stamp, std::llround((file.time_s - depth.front().time_s) * 1e6), file.path, {}, {}};
    const auto distance = [&](const TimedFile& other) { return std::abs(other.time_s - file.time_s); };
    const auto nearest = std::min_element(colour.begin(), colour.end(), [&](const auto& a, const auto& b) {
      return distance(a) < distance(b);
    });
    if (nearest != colour.end() && distance(*nearest) <= kSameMoment_s)
      entry.colour = nearest->path;
    else
      ++without;
    listing.entries.push_back(entry);
  }
  const double span_s = depth.back().time_s - depth.front().time_s;
  if (span_s > 0) listing.rate_hz = static_cast<double>(depth.size() - 1) / span_s;
  if (!colour.empty() && without > 0)
    listing.notes.push_back(fmt::format("{} depth frames have no colour image within 20 ms", without));
  return listing;
}

}  // namespace

FolderListing list_folder(const fs::path& folder) {
  std::error_code code;
  if (!fs::is_directory(folder, code)) throw unreadable("no such folder", folder.string(), "check the path");
  try {
    if (fs::exists(folder / "depth.txt")) return list_tum(folder);
    return is_osd(folder) ? list_osd(folder) : list_numbered(folder);
  } catch (const fs::filesystem_error& error) {
    throw unreadable("cannot list the folder: " + error.code().message(), folder.string(),
                     "check its permissions");
  }
}

std::optional<Intrinsics> read_meta(const fs::path& folder) {
  const fs::path path = folder / "meta.json";
  if (!fs::exists(path)) return std::nullopt;
  const std::string hint = "mend or remove it; fx, fy, cx, cy in pixels are expected";
  const auto bytes = read_file(path, 256u << 20);
  const auto meta = nlohmann::json::parse(bytes.begin(), bytes.end(), nullptr, /*allow_exceptions=*/false);
  if (!meta.is_object()) throw unreadable("broken meta.json: not a JSON object", path.string(), hint);
  Intrinsics camera;
  camera.origin = IntrinsicsOrigin::file;
  int found = 0;
  for (const auto& [key, field] : {std::pair{"fx", &Intrinsics::fx}, std::pair{"fy", &Intrinsics::fy},
                                   std::pair{"cx", &Intrinsics::cx}, std::pair{"cy", &Intrinsics::cy}}) {
    const auto value = meta.find(key);
    if (value == meta.end()) continue;
    if (!value->is_number())
      throw unreadable(fmt::format("broken meta.json: {} is no number", key), path.string(), hint);
    camera.*field = value->get<double>();
    ++found;
  }
  if (found == 0) return std::nullopt;
  if (found < 4)
    throw unreadable("broken meta.json: some of fx, fy, cx, cy are missing", path.string(), hint);
  if (!camera.valid())
    throw unreadable("broken meta.json: fx and fy must be above 0 and all four finite", path.string(), hint);
  return camera;
}

}  // namespace saccade
