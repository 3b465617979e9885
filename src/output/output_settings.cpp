#include "output/output_settings.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.hpp"
#include "models/model.hpp"

namespace saccade {
namespace {

using S = OutputSettings;

void parse_dump(S& s, const std::string& text) {
  static const std::vector<std::string> known = {"maps", "levels", "overlay", "normals", "masks", "labels"};
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

}  // namespace

std::vector<SettingOf<S>> output_setting_specs() {
  return {
      {"dump", "LIST", "files to write of each frame: maps,levels,overlay,normals,masks,labels or none",
       parse_dump, print_dump},
      switch_setting<S>("json", "print a summary in JSON, and nothing else, on standard output", &S::json),
  };
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
