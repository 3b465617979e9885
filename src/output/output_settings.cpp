#include "output/output_settings.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "models/model.hpp"

namespace saccade {
namespace {

using S = OutputSettings;

void parse_dump(S& s, const std::string& text) {
  static const std::vector<std::string> known = {"maps",   "levels", "overlay", "normals", "masks",
                                                 "labels", "depth",  "colour",  "cloud"};
  std::set<std::string> dump;
  if (text != "none")
    for (const std::string& part : split_list(text)) {
      if (std::find(known.begin(), known.end(), part) == known.end())
        throw std::invalid_argument(fmt::format("none, or a list of {}", fmt::join(known, ", ")));
      dump.insert(part);
    }
  s.dump = dump;
}

std::string print_dump(const S& s) {
  return s.dump.empty() ? "none" : fmt::format("{}", fmt::join(s.dump, ","));
}

// The parts of an overlay that are switched on and off by name; the map is off at opacity 0.
constexpr std::array<std::pair<const char*, bool OverlayStyle::*>, 3> kOverlayParts = {
    {{"fixations", &OverlayStyle::marks},
     {"path", &OverlayStyle::path},
     {"outlines", &OverlayStyle::outlines}}};

void parse_overlay(S& s, const std::string& text) {
  OverlayStyle style = s.overlay;
  for (const auto& [name, part] : kOverlayParts) style.*part = false;
  if (text != "none")
    for (const std::string& word : split_list(text)) {
      const auto found =
          std::ranges::find_if(kOverlayParts, [&](const auto& part) { return word == part.first; });
      if (found == kOverlayParts.end())
        throw std::invalid_argument("none, or a list of fixations, path, outlines");
      style.*found->second = true;
    }
  s.overlay = style;
}

std::string print_overlay(const S& s) {
  std::vector<std::string> words;
  for (const auto& [name, part] : kOverlayParts)
    if (s.overlay.*part) words.emplace_back(name);
  return words.empty() ? "none" : fmt::format("{}", fmt::join(words, ","));
}

SettingOf<S> palette_setting(std::string_view key, const std::string& help, Palette& (*palette)(S&)) {
  std::vector<std::string> names;
  names.reserve(std::size(kPalettes));
  for (const Palette p : kPalettes) names.emplace_back(to_string(p));
  return {key,
          "NAME",
          help + fmt::format(": {}", fmt::join(names, ", ")),
          [=](S& s, const std::string& text) { palette(s) = kPalettes[find_word(names, text)]; },
          [=](const S& s) {
            S copy = s;
            return std::string(to_string(palette(copy)));
          },
          names};
}

SettingOf<S> share_setting(std::string_view key, std::string help, double MapStyle::*field) {
  return {key, "SHARE", std::move(help),
          [=](S& s, const std::string& text) { s.overlay.map.*field = parse_number(text, 0.0, 1.0, "0..1"); },
          [=](const S& s) { return print_number(s.overlay.map.*field); }};
}

// "LOW..HIGH" or "auto".
SettingOf<S> range_setting(std::string_view key, std::string help, std::optional<ValueRange>& (*range)(S&)) {
  return {key, "LOW..HIGH", std::move(help),
          [=](S& s, const std::string& text) {
            if (text == "auto") return range(s).reset();
            const std::string expected = "auto, or two numbers LOW..HIGH with LOW < HIGH";
            const auto dots = text.find("..");
            if (dots == std::string::npos) throw std::invalid_argument(expected);
            const ValueRange value{parse_number(text.substr(0, dots), -1e9F, 1e9F, expected),
                                   parse_number(text.substr(dots + 2), -1e9F, 1e9F, expected)};
            if (!(value.low < value.high)) throw std::invalid_argument(expected);
            range(s) = value;
          },
          [=](const S& s) {
            S copy = s;
            const auto& value = range(copy);
            return value ? fmt::format("{}..{}", value->low, value->high) : std::string("auto");
          }};
}

std::vector<SettingOf<S>> overlay_setting_specs() {
  return {
      {"overlay", "LIST", "what the overlay shows besides the map: fixations,path,outlines or none",
       parse_overlay, print_overlay},
      {"background",
       "NAME",
       "picture below the map of the overlay: colour or depth",
       [](S& s, const std::string& text) {
         s.overlay.background = static_cast<Background>(find_word({"colour", "depth"}, text));
       },
       [](const S& s) { return s.overlay.background == Background::depth ? "depth" : "colour"; },
       {"colour", "depth"}},
      palette_setting("map-colours", "colours of the map in the overlay",
                      [](S& s) -> Palette& { return s.overlay.map.palette; }),
      range_setting("map-range", "saliency of the first and the last of these colours, or auto",
                    [](S& s) -> std::optional<ValueRange>& { return s.overlay.map.range; }),
      share_setting("map-opacity", "opacity of the most salient pixel of the overlay, 0..1",
                    &MapStyle::opacity),
      share_setting("map-threshold", "share of the range, 0..1, below which the overlay shows no map",
                    &MapStyle::threshold),
      palette_setting("depth-colours", "colours of depth in the overlay",
                      [](S& s) -> Palette& { return s.overlay.depth.palette; }),
      range_setting("depth-range", "depth in mm of the first and the last of these colours, or auto",
                    [](S& s) -> std::optional<ValueRange>& { return s.overlay.depth.range_mm; }),
      {"depth-percentile", "PERCENT",
       "for depth-range auto: percent of the depths, 0..25, beyond each end of the range",
       [](S& s, const std::string& text) {
         s.overlay.depth.percentile = parse_number(text, 0.0, 25.0, "0..25");
       },
       [](const S& s) { return print_number(s.overlay.depth.percentile); }},
  };
}

}  // namespace

std::vector<SettingOf<S>> output_setting_specs() {
  std::vector<SettingOf<S>> specs = {
      {"dump", "LIST",
       "files to write of each frame: maps,levels,overlay,normals,masks,labels,depth,colour,cloud or none",
       parse_dump, print_dump},
      switch_setting<S>("json", "print a summary in JSON, and nothing else, on standard output", &S::json),
  };
  for (SettingOf<S>& spec : overlay_setting_specs()) specs.push_back(std::move(spec));
  return specs;
}

RequestedOutputs requested_outputs(const OutputSettings& settings) {
  return {settings.dump.contains("levels"), settings.dump.contains("normals")};
}

void check_dump(const OutputSettings& settings, std::string_view model) {
  if (needs_depth(model)) return;
  for (const char* part : {"levels", "normals"})
    if (settings.dump.contains(part))
      throw usage_error(
          fmt::format("model {} has no {} to dump", model, part), "--dump " + print_dump(settings),
          fmt::format("leave {} out, or use --model {}", part, fmt::join(model_names(true), " or ")));
}

}  // namespace saccade
