#include "ui/session/source_fit.hpp"

#include <utility>

#include <fmt/format.h>

#include "models/model.hpp"
#include "saliency/params.hpp"

namespace saccade {
namespace {

constexpr const char* kModelOfImage = "colour_symmetry2d";
constexpr Selector kSelectorOfImage = Selector::wta;

}  // namespace

std::vector<std::string> SourceFit::fit(ComparedSettings& settings, const SourceInfo& source) {
  restore(settings);
  std::vector<std::string> notes = source.notes;
  const std::array<Settings*, 2> sides = {&settings.a, &settings.b};
  for (std::size_t i = 0; i < sides.size() && !source.has_depth; ++i) {
    Settings& s = *sides[i];
    if (needs_depth(s.model)) {
      if (i == 0)
        notes.push_back(fmt::format(
            "Model {} needs depth, and there is none: {} is shown instead; other models of the image can be "
            "chosen under Tuning",
            s.model, kModelOfImage));
      exchanged_[i].model = std::exchange(s.model, kModelOfImage);
    }
    if (s.selector == Selector::proto) exchanged_[i].selector = std::exchange(s.selector, kSelectorOfImage);
  }
  const int last = last_level_for(settings.a, source.size);
  if (last < settings.a.last_level)
    notes.push_back(fmt::format("{}x{} images have room for levels 0..{} only, not for the default",
                                source.size.width, source.size.height, last));
  return notes;
}

void SourceFit::restore(ComparedSettings& settings) {
  const std::array<Settings*, 2> sides = {&settings.a, &settings.b};
  for (std::size_t i = 0; i < sides.size(); ++i) {
    Exchanged& was = exchanged_[i];
    if (was.model && sides[i]->model == kModelOfImage) sides[i]->model = *was.model;
    if (was.selector && sides[i]->selector == kSelectorOfImage) sides[i]->selector = *was.selector;
    was = {};
  }
}

}  // namespace saccade
