#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>

#include "sources/source_kind.hpp"

namespace saccade {
namespace fs = std::filesystem;

// Each is defined at the end of the file that reads it. A new kind: its file (added to CMakeLists.txt), and
// its name here and in the list below.
extern const SourceKind kOpenNi2Kind, kSyntheticKind, kWebcamKind, kImagesKind, kTumKind, kOsdKind, kBopKind,
    kPairedKind, kNumberedKind, kSuffixKind, kCloudsKind, kOniKind, kBagKind, kNyuKind, kVideoKind;

namespace {

constexpr std::array kKinds = {&kOpenNi2Kind, &kSyntheticKind, &kWebcamKind, &kImagesKind,   &kTumKind,
                               &kOsdKind,     &kBopKind,       &kPairedKind, &kNumberedKind, &kSuffixKind,
                               &kCloudsKind,  &kOniKind,       &kBagKind,    &kNyuKind,      &kVideoKind};

constexpr std::size_t kHeadBytes = 1024;

std::string read_head(const fs::path& path) {
  std::error_code code;
  if (!fs::is_regular_file(path, code)) return {};
  std::string head(kHeadBytes, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  return head;
}

SourceInput::Type type_of(const fs::path& path) {
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (fs::is_directory(status)) return SourceInput::Type::folder;
  if (fs::is_regular_file(status)) return SourceInput::Type::file;
  return fs::exists(status) ? SourceInput::Type::special : SourceInput::Type::absent;
}

}  // namespace

SourceInput::SourceInput(const std::string& text)
    : uri(text), path(text), type(type_of(path)), ending(ending_of(path)), head(read_head(path)) {}

std::string ending_of(const fs::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

std::span<const SourceKind* const> source_kinds() { return kKinds; }

const SourceKind* kind_of(const SourceInput& input) {
  const auto takes = [&](const SourceKind* kind) {
    if (kind->recognises != nullptr && kind->recognises(input)) return true;
    return input.type == SourceInput::Type::file && std::ranges::count(kind->endings, input.ending) > 0;
  };
  const auto found = std::ranges::find_if(kKinds, takes);
  return found == kKinds.end() ? nullptr : *found;
}

}  // namespace saccade
