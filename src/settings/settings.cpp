#include "settings/settings.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"

namespace saccade {
namespace {

// Appends the settings of one part; `part_of` gives the part of a Settings.
template <typename Part, typename PartOf>
void append(std::vector<SettingSpec>& specs, SettingScope scope, std::vector<SettingOf<Part>> settings,
            PartOf part_of) {
  for (SettingOf<Part>& setting : settings) {
    SettingSpec::Chosen chosen;
    if (setting.chosen)
      chosen = [=, of_part = std::move(setting.chosen)](const Settings& s) { return of_part(part_of(s)); };
    specs.push_back({{setting.key, setting.value, std::move(setting.help),
                      [=, parse = std::move(setting.parse)](Settings& s, const std::string& text) {
                        parse(part_of(s), text);
                      },
                      [=, print = std::move(setting.print)](const Settings& s) { return print(part_of(s)); },
                      std::move(setting.words), std::move(chosen)},
                     scope});
  }
}

std::vector<SettingSpec> make_specs() {
  const auto whole = [](auto& settings) -> auto& { return settings; };  // it derives from the part
  const auto sensor = [](auto& settings) -> auto& { return settings.sensor; };
  std::vector<SettingSpec> specs;
  append(specs, SettingScope::model, model_setting_specs(), whole);
  append(specs, SettingScope::attention, attention_setting_specs(), whole);
  append(specs, SettingScope::tracking, tracking_setting_specs(), whole);
  append(specs, SettingScope::frames, frame_setting_specs(), whole);
  append(specs, SettingScope::frames, input_setting_specs(), whole);
  append(specs, SettingScope::sensor, sensor_setting_specs(), sensor);
  append(specs, SettingScope::output, output_setting_specs(), whole);
  append(specs, SettingScope::program, program_setting_specs(), whole);
  return specs;
}

// The number of edits (insert, delete, replace) from a to b, to guess which key a mistyped one means.
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

std::string_view title(SettingScope scope) {
  constexpr std::array<std::string_view, 7> kTitles = {
      "Model", "Attention", "Attention over time", "Frames", "Sensor", "Output", "Program"};
  return kTitles[static_cast<std::size_t>(scope)];
}

std::span<const SettingSpec> setting_specs() {
  static const std::vector<SettingSpec> specs = make_specs();
  return specs;
}

const SettingSpec& setting_spec(std::string_view key) {
  const auto specs = setting_specs();
  const auto spec =
      std::find_if(specs.begin(), specs.end(), [&](const SettingSpec& s) { return s.key == key; });
  if (spec != specs.end()) return *spec;
  const auto nearest = std::min_element(specs.begin(), specs.end(), [&](const auto& a, const auto& b) {
    return edit_distance(key, a.key) < edit_distance(key, b.key);
  });
  throw usage_error("unknown setting", std::string(key), fmt::format("did you mean {}?", nearest->key));
}

void apply_setting(Settings& settings, std::string_view key, const std::string& value) {
  const SettingSpec& spec = setting_spec(key);
  try {
    spec.parse(settings, std::string(without_blanks(value)));
  } catch (const std::invalid_argument& expected) {
    throw usage_error(fmt::format("bad value for {}", key), fmt::format("'{}'", value),
                      fmt::format("expected {}", expected.what()));
  }
}

bool is_default(const SettingSpec& spec, const Settings& settings) {
  return spec.print(settings) == spec.print(Settings{}) && !(spec.chosen && spec.chosen(settings));
}

bool same_values(SettingScope scope, const Settings& a, const Settings& b) {
  const auto specs = setting_specs();
  return std::all_of(specs.begin(), specs.end(), [&](const SettingSpec& spec) {
    return spec.scope != scope || spec.print(a) == spec.print(b);
  });
}

}  // namespace saccade
