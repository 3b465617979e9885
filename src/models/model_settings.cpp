#include "models/model_settings.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "models/model.hpp"

namespace saccade {
namespace {

using S = ModelSettings;

void parse_levels(S& s, const std::string& text) {
  const std::string expected = "A..B with integers 0 <= A <= B <= 12, e.g. 0..4";
  const auto dots = text.find("..");
  const std::string low = text.substr(0, dots),
                    high = dots == std::string::npos ? low : text.substr(dots + 2);
  const int first = parse_number(without_blanks(low), 0, 12, expected),
            last = parse_number(without_blanks(high), 0, 12, expected);
  if (first > last) throw std::invalid_argument(expected);
  s.first_level = first;
  s.last_level = last;
  s.levels_chosen = true;
}

std::string print_levels(const S& s) { return fmt::format("{}..{}", s.first_level, s.last_level); }

SettingOf<S> model_setting() {
  std::string help = "saliency model";
  std::vector<std::string> names;
  for (const ModelInfo& model : models()) {
    help += fmt::format("\n  {:<17}  {}", model.name, model.help);
    names.emplace_back(model.name);
  }
  return word_setting<S>("model", help, &S::model, names);
}

}  // namespace

std::vector<SettingOf<S>> model_setting_specs() {
  return {
      model_setting(),
      number_setting<S>("kernel", "K", "size k of the window in pixels of each level, 3..127", &S::kernel, 3,
                        127),
      {"levels",
       "A..B",
       "pyramid levels to add, 0 = full size; each level is half the size of the one before",
       parse_levels,
       print_levels,
       {},
       [](const S& s) { return s.levels_chosen; }},
      enum_setting<S>(
          "length-scale",
          "unit of the distances of the symmetry: relative (5 % of the window's width) or millimetre",
          &S::length_scale, {"relative", "millimetre"}),
      enum_setting<S>("normalisation",
                      "normalisation of each level's map before the levels are added: none, max or itti",
                      &S::normalisation, {"none", "max", "itti"}),
      word_setting<S>("simd", "highest instruction set to use: auto, avx512, avx2, sse4, neon or scalar",
                      &S::simd, {"auto", "avx512", "avx2", "sse4", "neon", "scalar"}),
  };
}

int last_level_for(const ModelSettings& settings, cv::Size image) {
  const int deepest = deepest_level(image);
  if (settings.levels_chosen || deepest < 0) return settings.last_level;
  return std::min(settings.last_level, deepest);
}

}  // namespace saccade
