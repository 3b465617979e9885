#include "core/settings.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>

#include "core/error.hpp"

namespace saccade {
namespace {

using Parse = std::function<void(Settings&, const std::string&)>;
using Print = std::function<std::string(const Settings&)>;

template <typename Number>
Number parse_number(const std::string& text, Number low, Number high, const std::string& expected) {
  Number value{};
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc{} || end != text.data() + text.size() || !(value >= low && value <= high))
    throw std::invalid_argument(expected);
  return value;
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find(separator, begin)) != std::string::npos; begin = end + 1)
    parts.push_back(text.substr(begin, end - begin));
  parts.push_back(text.substr(begin));
  return parts;
}

template <typename Number>
SettingSpec number(std::string_view key, std::string_view value, std::string_view help,
                   Number Settings::*field, Number low, Number high) {
  const std::string expected = fmt::format("{}..{}", low, high);
  return {key, value, help,
          [=](Settings& s, const std::string& text) { s.*field = parse_number(text, low, high, expected); },
          [=](const Settings& s) { return fmt::format("{}", s.*field); }};
}

SettingSpec word(std::string_view key, std::string_view help, std::string Settings::*field,
                 std::vector<std::string> words) {
  return {key,
          "NAME",
          help,
          [=](Settings& s, const std::string& text) {
            if (std::find(words.begin(), words.end(), text) == words.end())
              throw std::invalid_argument(fmt::format("one of {}", fmt::join(words, ", ")));
            s.*field = text;
          },
          [=](const Settings& s) { return s.*field; },
          words};
}

template <typename Enum>
SettingSpec choice(std::string_view key, std::string_view help, Enum Settings::*field,
                   std::vector<std::string> words) {
  return {key,
          "NAME",
          help,
          [=](Settings& s, const std::string& text) {
            const auto found = std::find(words.begin(), words.end(), text);
            if (found == words.end())
              throw std::invalid_argument(fmt::format("one of {}", fmt::join(words, ", ")));
            s.*field = static_cast<Enum>(found - words.begin());
          },
          [=](const Settings& s) { return words[static_cast<std::size_t>(s.*field)]; },
          words};
}

bool parse_truth(const std::string& text) {
  if (text != "true" && text != "false") throw std::invalid_argument("true or false");
  return text == "true";
}

SettingSpec flag(std::string_view key, std::string_view help, bool Settings::*field) {
  return {key, "", help, [=](Settings& s, const std::string& text) { s.*field = parse_truth(text); },
          [=](const Settings& s) { return s.*field ? "true" : "false"; }};
}

void parse_levels(Settings& s, const std::string& text) {
  const std::string expected = "A..B with 0 <= A <= B <= 12, e.g. 0..4";
  const auto dots = text.find("..");
  const std::string low = text.substr(0, dots),
                    high = dots == std::string::npos ? low : text.substr(dots + 2);
  const int first = parse_number(low, 0, 12, expected), last = parse_number(high, 0, 12, expected);
  if (first > last) throw std::invalid_argument(expected);
  s.first_level = first;
  s.last_level = last;
  s.levels_chosen = true;
}

void parse_intrinsics(Settings& s, const std::string& text) {
  if (text.empty()) {
    s.intrinsics.reset();
    return;
  }
  const std::string expected = "fx,fy,cx,cy in pixels, finite numbers, fx and fy above 0";
  const auto parts = split(text, ',');
  if (parts.size() != 4) throw std::invalid_argument(expected);
  constexpr double kHuge = 1e6;
  std::array<double, 4> v{};
  for (std::size_t i = 0; i < 4; ++i) v[i] = parse_number(parts[i], -kHuge, kHuge, expected);
  const Intrinsics camera{v[0], v[1], v[2], v[3], IntrinsicsOrigin::option};
  if (!camera.valid()) throw std::invalid_argument(expected);
  s.intrinsics = camera;
}

std::string print_intrinsics(const Settings& s) {
  if (!s.intrinsics) return "";
  return fmt::format("{},{},{},{}", s.intrinsics->fx, s.intrinsics->fy, s.intrinsics->cx, s.intrinsics->cy);
}

void parse_dump(Settings& s, const std::string& text) {
  static const std::vector<std::string> known = {"maps", "levels", "overlay", "normals", "masks", "labels"};
  std::set<std::string> dump;
  if (text != "none")
    for (const std::string& part : split(text, ',')) {
      if (std::find(known.begin(), known.end(), part) == known.end())
        throw std::invalid_argument("none, or a list of maps, levels, overlay, normals, masks, labels");
      dump.insert(part);
    }
  s.dump = dump;
}

std::string print_dump(const Settings& s) {
  return s.dump.empty() ? "none" : fmt::format("{}", fmt::join(s.dump, ","));
}

void parse_mode(Settings& s, const std::string& text) {
  if (text.empty()) return s.sensor.mode.reset();
  const std::string expected = "WxH@HZ, e.g. 640x480@30";
  const auto x = text.find('x'), at = text.find('@');
  if (x == std::string::npos || (at != std::string::npos && at < x)) throw std::invalid_argument(expected);
  SensorMode mode;
  mode.width = parse_number(text.substr(0, x), 1, 16384, expected);
  mode.height =
      parse_number(text.substr(x + 1, at == std::string::npos ? at : at - x - 1), 1, 16384, expected);
  if (at != std::string::npos) mode.rate_hz = parse_number(text.substr(at + 1), 1, 1000, expected);
  s.sensor.mode = mode;
}

std::string print_mode(const Settings& s) { return s.sensor.mode ? to_text(*s.sensor.mode) : ""; }

SettingSpec sensor_flag(std::string_view key, std::string_view help, bool SensorSettings::*field) {
  return {key, "", help, [=](Settings& s, const std::string& text) { s.sensor.*field = parse_truth(text); },
          [=](const Settings& s) { return s.sensor.*field ? "true" : "false"; }};
}

std::vector<SettingSpec> sensor_specs() {
  return {
      {"mode", "WxH@HZ",
       "live sensor: size and rate, e.g. 320x240@60; default 640x480@30, or the nearest it has", parse_mode,
       print_mode},
      sensor_flag("registration", "live sensor: depth as seen from the colour camera",
                  &SensorSettings::registration),
      sensor_flag("mirror", "live sensor: images mirrored left to right", &SensorSettings::mirror),
      {"exposure", "N", "live sensor: exposure of the colour camera in the device's own unit, or auto",
       [](Settings& s, const std::string& text) {
         if (text == "auto")
           s.sensor.exposure.reset();
         else
           s.sensor.exposure = parse_number(text, 0, 1'000'000, "auto or 0..1000000");
       },
       [](const Settings& s) {
         return s.sensor.exposure ? fmt::format("{}", *s.sensor.exposure) : std::string("auto");
       }},
      {"white-balance", "NAME", "live sensor: auto, or fixed as it is",
       [](Settings& s, const std::string& text) {
         if (text != "auto" && text != "fixed") throw std::invalid_argument("auto or fixed");
         s.sensor.auto_white_balance = text == "auto";
       },
       [](const Settings& s) { return s.sensor.auto_white_balance ? "auto" : "fixed"; }},
      sensor_flag("reconnect", "live sensor: wait for a device that is lost; without it that is an error",
                  &SensorSettings::reconnect),
      {"wait", "S", "live sensor: seconds to wait for a device that is not there at the start",
       [](Settings& s, const std::string& text) {
         s.sensor.wait_s = parse_number(text, 0.0, 1e9, "seconds, 0..1e9");
       },
       [](const Settings& s) { return fmt::format("{}", s.sensor.wait_s); }},
  };
}

std::vector<SettingSpec> make_specs() {
  constexpr std::int64_t kMany = 1'000'000'000;
  std::vector<SettingSpec> specs = {
      word("model",
           "saliency model: symmetry3d, combined, symmetry2d, colour_symmetry2d, radial2d, itti, "
           "itti_orientation, random or centre",
           &Settings::model,
           {"symmetry3d", "combined", "symmetry2d", "colour_symmetry2d", "radial2d", "itti",
            "itti_orientation", "random", "centre"}),
      number("kernel", "K", "kernel size k in pixels of each level, 3..127", &Settings::kernel, 3, 127),
      {"levels", "A..B", "pyramid levels, 0 = full size; each halves the last", parse_levels,
       [](const Settings& s) { return fmt::format("{}..{}", s.first_level, s.last_level); }},
      choice("length-scale", "unit of the symmetry distances: relative (5 % of the window) or millimetre",
             &Settings::length_scale, {"relative", "millimetre"}),
      choice("normalisation", "of each level's map before they are added: none, max or itti",
             &Settings::normalisation, {"none", "max", "itti"}),
      word("simd", "highest instruction set to use: auto, avx512, avx2, sse4, neon or scalar",
           &Settings::simd, {"auto", "avx512", "avx2", "sse4", "neon", "scalar"}),
      choice("selector",
             "how attention points are chosen: proto (one per object) or wta (the paper's network)",
             &Settings::selector, {"proto", "wta"}),
      number("fixations", "N", "attention points per frame, 1..1000", &Settings::fixations, 1, 1000),
      number("foa", "PX", "wta: focus of attention, diameter in image pixels, 1..1000", &Settings::foa, 1.0,
             1000.0),
      number("frames", "N", "stop after so many frames; 0 = all", &Settings::frames, std::int64_t{0}, kMany),
      number("start", "N", "index of the first frame, from 0", &Settings::start, std::int64_t{0}, kMany),
      number("every", "N", "take each N-th frame, from 1", &Settings::every, std::int64_t{1}, kMany),
      {"intrinsics", "FX,FY,CX,CY", "camera in pixels, overriding what the source says", parse_intrinsics,
       print_intrinsics},
      number("workers", "N", "computing threads, 0 = one per processor, at most 256", &Settings::workers, 0,
             256),
      {"dump", "LIST", "what to write of each frame: maps,levels,overlay,normals,masks,labels or none",
       parse_dump, print_dump},
      flag("json", "a summary in JSON on standard output, nothing else there", &Settings::json),
      flag("quiet", "no progress and no summary, only warnings and errors", &Settings::quiet),
      word("log-level", "trace, debug, info, warn, error or off", &Settings::log_level,
           {"trace", "debug", "info", "warn", "error", "off"}),
  };
  const auto of_frames =
      std::find_if(specs.begin(), specs.end(), [](const auto& s) { return s.key == "workers"; });
  const auto sensor = sensor_specs();
  specs.insert(of_frames, sensor.begin(), sensor.end());
  return specs;
}

// Edits (insert, delete, replace) from a to b; to guess what a mistyped key was meant to be.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replace = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replace, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

}  // namespace

std::string to_text(const SensorMode& mode) {
  return fmt::format("{}x{}@{}", mode.width, mode.height, mode.rate_hz);
}

std::span<const SettingSpec> setting_specs() {
  static const std::vector<SettingSpec> specs = make_specs();
  return specs;
}

void apply_setting(Settings& settings, const std::string& key, const std::string& value) {
  const auto specs = setting_specs();
  const auto spec =
      std::find_if(specs.begin(), specs.end(), [&](const SettingSpec& s) { return s.key == key; });
  if (spec == specs.end()) {
    const auto nearest = std::min_element(specs.begin(), specs.end(), [&](const auto& a, const auto& b) {
      return edit_distance(key, a.key) < edit_distance(key, b.key);
    });
    throw usage_error("unknown setting", key, fmt::format("did you mean {}?", nearest->key));
  }
  try {
    spec->parse(settings, value);
  } catch (const std::invalid_argument& expected) {
    throw usage_error(fmt::format("bad value for {}", key), fmt::format("'{}'", value),
                      fmt::format("expected {}", expected.what()));
  }
}

}  // namespace saccade
