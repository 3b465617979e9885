#include "ui/session/source_fit.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "models/model.hpp"
#include "saliency/params.hpp"

namespace saccade {
namespace {

constexpr const char* kModelOfImage = "colour_symmetry2d";
constexpr Selector kSelectorOfImage = Selector::wta;

// The kinds of sources that give a frame no time of its own.
constexpr std::array<std::string_view, 4> kKindsOfStills = {"folder", "osd", "images", "nyu"};

}  // namespace

bool has_stills(const SourceInfo& source) {
  return std::ranges::find(kKindsOfStills, source.kind) != kKindsOfStills.end();
}

std::vector<std::string> SourceFit::fit(ComparedSettings& settings, const SourceInfo& source) {
  restore(settings);
  std::vector<std::string> notes = source.notes;
  const std::array<Settings*, 2> sides = {&settings.a, &settings.b};
  for (std::size_t i = 0; i < sides.size() && !source.has_depth; ++i) {
    Settings& s = *sides[i];
    if (needs_depth(s.model)) {
      if (i == 0)
        notes.push_back(
            fmt::format("Model {} needs depth, and this source has none: {} is shown instead; choose another "
                        "2D model under Tuning",
                        s.model, kModelOfImage));
      replaced_[i].model = std::exchange(s.model, kModelOfImage);
    }
    if (s.selector == Selector::proto) replaced_[i].selector = std::exchange(s.selector, kSelectorOfImage);
  }
  const int last = last_level_for(settings.a, source.size);
  if (last < settings.a.last_level)
    notes.push_back(fmt::format("{}x{} images have room for levels 0..{} only", source.size.width,
                                source.size.height, last));
  return notes;
}

void SourceFit::restore(ComparedSettings& settings) {
  const std::array<Settings*, 2> sides = {&settings.a, &settings.b};
  for (std::size_t i = 0; i < sides.size(); ++i) {
    Replaced& was = replaced_[i];
    if (was.model && sides[i]->model == kModelOfImage) sides[i]->model = *was.model;
    if (was.selector && sides[i]->selector == kSelectorOfImage) sides[i]->selector = *was.selector;
    was = {};
  }
}

}  // namespace saccade
