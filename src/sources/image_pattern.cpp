// Depth images by their names: numbered, as a pattern gives them (depth_%04d.png), or a single one.
#include <charconv>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "core/error.hpp"
#include "sources/numbered_frames.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kPngEnding = ".png";
constexpr int kWidest = 18;  // digits of a number

// A name with one number, as printf writes it: "depth_%04d.png".
struct NamePattern {
  std::string before, after;
  int width = 0;       // the least number of characters of the number
  bool zeros = false;  // filled up with zeros, else with blanks

  std::string name_of(std::int64_t number) const {
    return before + (zeros ? fmt::format("{:0{}}", number, width) : fmt::format("{:{}}", number, width)) +
           after;
  }

  // The number in a name of this pattern.
  std::optional<std::int64_t> number_in(const std::string& name) const {
    if (name.size() <= before.size() + after.size() || !name.starts_with(before) || !name.ends_with(after))
      return std::nullopt;
    const char* begin = name.data() + before.size();
    const char* end = name.data() + name.size() - after.size();
    while (!zeros && begin != end && *begin == ' ') ++begin;
    std::int64_t number = 0;
    const auto [stop, code] = std::from_chars(begin, end, number);
    if (code != std::errc{} || stop != end || number < 0 || name_of(number) != name) return std::nullopt;
    return number;
  }
};

// std::nullopt for a name that is no pattern, or has more than one '%'.
std::optional<NamePattern> parse_pattern(const std::string& name) {
  const auto percent = name.find('%');
  if (percent == std::string::npos || !name.ends_with(kPngEnding)) return std::nullopt;
  NamePattern pattern;
  pattern.before = name.substr(0, percent);
  const char* at = name.data() + percent + 1;
  const char* end = name.data() + name.size();
  if (at != end && *at == '0') {
    pattern.zeros = true;
    ++at;
  }
  if (const auto [stop, code] = std::from_chars(at, end, pattern.width); code == std::errc{}) at = stop;
  if (at == end || *at != 'd' || pattern.width < 0 || pattern.width > kWidest) return std::nullopt;
  pattern.after.assign(at + 1, end);
  if (pattern.after.find('%') != std::string::npos) return std::nullopt;
  return pattern;
}

// The pattern of an input, whose folder has none.
std::optional<NamePattern> pattern_of(const SourceInput& input) {
  if (input.path.parent_path().string().find('%') != std::string::npos) return std::nullopt;
  return parse_pattern(input.path.filename().string());
}

// The colour image beside a depth image: "rgb" for the last "depth" of its name.
fs::path colour_of(const FolderNames& names, const std::string& depth) {
  constexpr std::string_view kDepth = "depth";
  const std::string stem = depth.substr(0, depth.size() - kPngEnding.size());
  const auto found = stem.rfind(kDepth);
  if (found == std::string::npos) return {};
  for (const char* word : {"rgb", "color", "colour"}) {
    std::string colour = stem;
    colour.replace(found, kDepth.size(), word);
    fs::path path = names.first_of({colour + ".png", colour + ".jpg", colour + ".jpeg"});
    if (!path.empty()) return path;
  }
  return {};
}

FolderListing list_one(const SourceInput& input) {
  FolderListing listing;
  FolderEntry entry;
  entry.name = input.path.stem().string();
  entry.depth = input.path;
  entry.colour = colour_of(FolderNames(input.path.parent_path()), input.path.filename().string());
  listing.entries.push_back(std::move(entry));
  return listing;
}

bool is_png_file(const SourceInput& input) {
  return input.type == SourceInput::Type::file && input.ending == kPngEnding;
}

FolderListing list_images(const SourceInput& input) {
  if (is_png_file(input)) return list_one(input);
  const fs::path folder = input.path.parent_path();
  const NamePattern pattern = pattern_of(input).value();
  const FolderNames names(folder);
  std::map<std::int64_t, FolderEntry> found;
  for (const std::string& name : names.all()) {
    const auto number = pattern.number_in(name);
    if (!number) continue;
    FolderEntry entry;
    entry.name = fs::path(name).stem().string();
    entry.depth = folder / name;
    entry.colour = colour_of(names, name);
    found.emplace(*number, std::move(entry));
  }
  if (found.empty())
    throw unreadable("no images of that pattern", input.uri,
                     "e.g. depth_%04d.png for depth_0000.png, depth_0001.png, ..");
  FolderListing listing = list_by_number(std::move(found));
  return listing;
}

}  // namespace

extern const SourceKind kImagesKind = {
    .name = "images",
    .written = "depth_%04d.png",
    .help = "depth images (PNG, 16 bits), numbered or one, with colour from rgb_%04d.png or .jpg",
    .recognised_by = "a pattern with one %d that ends in .png, or a .png file",
    .recognises =
        [](const SourceInput& input) { return is_png_file(input) || pattern_of(input).has_value(); },
    .open =
        [](const SourceInput& input, const SourceOptions& options) {
          return open_folder(input, input.path.parent_path(), kImagesKind.name, list_images(input),
                             options.input);
        },
};

}  // namespace saccade
