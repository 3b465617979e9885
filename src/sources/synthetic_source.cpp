#include "sources/synthetic_source.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "core/image_size.hpp"
#include "scene/random.hpp"
#include "scene/strips.hpp"
#include "sources/source_kind.hpp"

namespace saccade {
namespace {

using std::string_view;

constexpr string_view kSyntheticScheme = "synthetic:";

cv::Affine3d as_affine(const scene::Pose& pose) {
  cv::Matx33d rotation;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) rotation(r, c) = pose.rotation(r, c);
  return {rotation, cv::Vec3d(pose.position_mm.x(), pose.position_mm.y(), pose.position_mm.z())};
}

template <typename Number>
std::optional<Number> number(string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// The value as a number in [low, high]; false otherwise. NaN is in no range.
template <typename Number, typename Target>
bool read_number(string_view text, Number low, Number high, Target& target) {
  const auto value = number<Number>(text);
  if (!value || !(*value >= low && *value <= high)) return false;
  target = *value;
  return true;
}

bool read_size(string_view text, cv::Size& size) {
  const auto cross = text.find('x');
  return cross != string_view::npos && read_number(text.substr(0, cross), 1, kLargestSide, size.width) &&
         read_number(text.substr(cross + 1), 1, kLargestSide, size.height) &&
         std::int64_t{size.width} * size.height <= kMostPixels;
}

// One of the words for the values of an enumeration, in their order.
template <typename Enum>
bool read_word(string_view text, std::initializer_list<string_view> words, Enum& target) {
  const auto word = std::ranges::find(words, text);
  if (word == words.end()) return false;
  target = static_cast<Enum>(word - words.begin());
  return true;
}

struct Key {
  string_view name, expects;
  bool (*read)(string_view, SyntheticSpec&);  // false: another value than expected
};

using Spec = SyntheticSpec;

constexpr std::array<Key, 12> kKeys = {{
    {"seed", "an integer, 0..9007199254740992",
     [](string_view v, Spec& s) { return read_number<std::uint64_t>(v, 0, std::uint64_t{1} << 53, s.seed); }},
    {"noise", "none or kinect",
     [](string_view v, Spec& s) {
       return read_word(v, {"none", "kinect"}, s.noise);
     }},
    {"missing", "a share of the pixels, 0..0.9",
     [](string_view v, Spec& s) { return read_number<double>(v, 0, 0.9, s.missing); }},
    {"frames", "an integer, 1..1000000",
     [](string_view v, Spec& s) { return read_number<std::int64_t>(v, 1, 1'000'000, s.frames); }},
    {"scenes", "an integer, 1..1000000",
     [](string_view v, Spec& s) { return read_number<std::int64_t>(v, 1, 1'000'000, s.scenes); }},
    {"size", "WxH with both in 1..8192 and at most 16 megapixels, e.g. 640x480",
     [](string_view v, Spec& s) { return read_size(v, s.size); }},
    {"camera", "still, orbit, pan or walk",
     [](string_view v, Spec& s) {
       return read_word(v, {"still", "orbit", "pan", "walk"}, s.camera);
     }},
    {"event", "none, move, add, take or hide",
     [](string_view v, Spec& s) {
       return read_word(v, {"none", "move", "add", "take", "hide"}, s.event);
     }},
    {"at", "s, 0..86400", [](string_view v, Spec& s) { return read_number<double>(v, 0, 86400, s.at_s); }},
    {"rate", "Hz, 0.1..1000",
     [](string_view v, Spec& s) { return read_number<double>(v, 0.1, 1000, s.rate_hz); }},
    {"objects", "an integer, 1..20; the scene table only",
     [](string_view v, Spec& s) {
       return s.scene == "table" && read_number<int>(v, 1, scene::kMostTableObjects, s.objects);
     }},
    {"distance", "mm, 400..10000",
     [](string_view v, Spec& s) { return read_number<double>(v, 400, 10000, s.distance_mm); }},
}};

std::string known_keys() {
  std::string names;
  for (const Key& key : kKeys) names += (names.empty() ? "" : ", ") + std::string(key.name);
  return names;
}

void read_pair(string_view pair, const std::string& uri, std::vector<string_view>& seen, Spec& spec) {
  const auto equals = pair.find('=');
  const string_view name = pair.substr(0, equals);
  const auto key = std::ranges::find(kKeys, name, &Key::name);
  if (key == kKeys.end())
    throw usage_error(fmt::format("unknown key '{}'", name), uri, "known keys: " + known_keys());
  if (std::ranges::find(seen, name) != seen.end())
    throw usage_error(fmt::format("key '{}' is given twice", name), uri, "give it once");
  seen.push_back(name);
  const string_view value = equals == string_view::npos ? string_view() : pair.substr(equals + 1);
  if (!key->read(value, spec))
    throw usage_error(fmt::format("bad value '{}' of key '{}'", value, name), uri,
                      fmt::format("expected: {}", key->expects));
}

}  // namespace

SyntheticSpec parse_synthetic(const std::string& uri) {
  string_view rest = uri;
  if (!rest.starts_with(kSyntheticScheme))
    throw usage_error("not a synthetic source", uri, "it is written synthetic:NAME?key=value&...");
  rest.remove_prefix(kSyntheticScheme.size());
  const auto question = rest.find('?');
  SyntheticSpec spec;
  spec.scene = rest.substr(0, question);
  const auto names = scene::scene_names();
  if (std::ranges::find(names, spec.scene) == names.end())
    throw usage_error(fmt::format("unknown scene '{}'", spec.scene), uri,
                      fmt::format("known scenes: {}", fmt::join(names, ", ")));
  if (question == string_view::npos) return spec;
  rest.remove_prefix(question + 1);
  std::vector<string_view> seen;
  while (true) {
    const auto end = rest.find('&');
    read_pair(rest.substr(0, end), uri, seen, spec);
    if (end == string_view::npos) return spec;
    rest.remove_prefix(end + 1);
  }
}

SyntheticSource::SyntheticSource(const std::string& uri) : spec_(parse_synthetic(uri)) {
  make_scene(0);
  info_.uri = uri;
  info_.kind = "synthetic";
  info_.size = spec_.size;
  info_.frame_count = spec_.frames;
  info_.rate_hz = spec_.rate_hz;
  if (spec_.noise == SyntheticSpec::Noise::kinect) info_.depth_unit_mm = 1;
  info_.sequence = spec_.scenes == 1 && !is_still();
  const double focal = 525.0 * spec_.size.width / 640;
  info_.intrinsics = {focal, focal, (spec_.size.width - 1) / 2.0, (spec_.size.height - 1) / 2.0,
                      IntrinsicsOrigin::sensor};
}

bool SyntheticSource::is_still() const {
  return spec_.camera == scene::CameraPath::still && spec_.event == scene::EventKind::none;
}

void SyntheticSource::make_scene(std::int64_t number) {
  const std::uint64_t seed = spec_.seed + static_cast<std::uint64_t>(number);
  scene_ = scene::make_scene(spec_.scene, {seed, spec_.objects, spec_.distance_mm});
  event_ = scene::plan_event(scene_, spec_.event, spec_.at_s, seed);
  scene_number_ = number;
  looked_ = false;
}

void SyntheticSource::look(double time_s) {
  pose_ = scene::camera_on(scene_, spec_.camera, time_s);
  scene::render(scene::scene_at(scene_, event_, time_s), info_.intrinsics, spec_.size, pose_, view_);
  if (spec_.noise == SyntheticSpec::Noise::kinect) kinect_.set_view(view_, info_.intrinsics);
}

ReadResult SyntheticSource::read(Frame& frame, std::chrono::milliseconds) {
  if (next_ >= spec_.frames) return {ReadStatus::end, {}};
  const std::int64_t index = next_++;
  if (index % spec_.scenes != scene_number_) make_scene(index % spec_.scenes);
  if (!is_still()) {
    look(static_cast<double>(index) / spec_.rate_hz);
  } else if (!looked_) {
    look(0);
    looked_ = true;
  }
  frame.index = index;
  frame.timestamp_us = std::llround(static_cast<double>(index) * 1e6 / spec_.rate_hz);
  frame.name.clear();
  frame.intrinsics = info_.intrinsics;
  // A still camera's view of one scene is rendered once and shared by all frames.
  const bool rendered_once = is_still() && spec_.scenes == 1;
  const auto give = [rendered_once](const auto& seen, auto& to) {
    if (rendered_once)
      to = seen;
    else
      seen.copyTo(to);
  };
  give(view_.colour, frame.colour);
  give(view_.labels, frame.truth.labels);
  give(view_.normals, frame.truth.normals);
  frame.truth.camera_to_world = as_affine(pose_);
  frame.truth.classes.release();
  if (spec_.noise == SyntheticSpec::Noise::kinect)
    kinect_.sense(scene::mix(scene::mix(spec_.seed, 2), static_cast<std::uint64_t>(index)), frame.depth_mm);
  else if (spec_.missing > 0)
    view_.depth_mm.copyTo(frame.depth_mm);
  else
    give(view_.depth_mm, frame.depth_mm);
  if (spec_.missing > 0)
    scene::remove_strips(scene::mix(spec_.seed + static_cast<std::uint64_t>(scene_number_), 3), spec_.missing,
                         frame.depth_mm);
  return {ReadStatus::frame, {}};
}

void SyntheticSource::seek(std::int64_t index) {
  if (index < 0) throw std::invalid_argument("SyntheticSource: negative frame index");
  next_ = index;
}

extern const SourceKind kSyntheticKind = {
    .name = "synthetic",
    .written = "synthetic:NAME?KEY=VALUE&...",
    .help = "a ray-cast scene with exact labels: cone, cube, cylinder, sphere, table or room",
    .recognised_by = "synthetic:",
    .recognises = [](const SourceInput& input) { return input.uri.starts_with(kSyntheticScheme); },
    .open = [](const SourceInput& input, const SourceOptions&) -> std::unique_ptr<FrameSource> {
      return std::make_unique<SyntheticSource>(input.uri);
    },
    .is_path = false,
};

}  // namespace saccade
