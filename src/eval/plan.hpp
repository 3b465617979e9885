#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "settings/settings.hpp"

namespace saccade {

/// One method of choosing points, to be compared with others.
struct Condition {
  std::string model;
  int kernel = 15;
  Selector selector = Selector::proto;

  friend bool operator==(const Condition&, const Condition&) = default;
};

/// "symmetry3d, k = 15, proto"
std::string describe(const Condition& condition);
std::string to_string(Selector selector);

inline constexpr int kMostPoints = 1000;

/// The settings that a plan replaces by fields of its own (models, kernels, selectors, points) or, for the
/// confidence, by 0: every point counts.
inline constexpr std::array<std::string_view, 5> kPlanKeys = {"model", "kernel", "selector", "fixations",
                                                              "min-confidence"};

/// Whether plan_json() keeps this setting: those that change results, apart from kPlanKeys.
bool is_kept(const SettingSpec& spec);

/// What an evaluation compares, and on which part of a data set.
struct EvalPlan {
  std::string dataset;  ///< as open_source() takes it
  std::string content;  ///< of the data set: data_set_content()
  std::vector<std::string> models;
  std::vector<int> kernels;
  std::vector<Selector> selectors;
  int points = 30;             ///< n of the Hit Ratio goes from 1 to this
  Settings settings;           ///< everything else; kPlanKeys have no effect
  int shard = 1, shards = 1;   ///< this part of how many; a part holds every shards-th frame
  std::int64_t positions = 0;  ///< number of frames that `settings` selects, in all shards
  std::string missing{};       ///< for reports: what merged results lack; empty = nothing. Not stored

  /// Every model with every kernel and every selector, in this order of nesting.
  std::vector<Condition> conditions() const;

  /// The settings that compute a condition.
  Settings settings_of(const Condition& condition) const;

  /// Number of frames of this shard.
  std::int64_t positions_of_shard() const { return positions < shard ? 0 : (positions - shard) / shards + 1; }

  /// Index in the source of the selected frame at `position`.
  std::int64_t frame_at(std::int64_t position) const { return settings.start + position * settings.every; }

  /// The position of a frame; none if it is not selected, or not of this shard.
  std::optional<std::int64_t> position_of(std::int64_t frame) const;
};

/// Reads lists as on the command line, "a,b"; empty = the value in `settings`. Throws Error (usage): an
/// unknown name, a number out of range, a value given twice.
void parse_lists(EvalPlan& plan, const std::string& models, const std::string& kernels,
                 const std::string& selectors);

/// As parse_shard(text).
void parse_shard(EvalPlan& plan, const std::string& text);

/// Everything that the results depend on.
nlohmann::ordered_json plan_json(const EvalPlan& plan);

/// "kernels is [15], not [10]" for the first difference; none if the results of both plans belong together.
/// The content of the data sets counts, not where they lie.
[[nodiscard]] std::optional<std::string> difference(const EvalPlan& stored, const EvalPlan& wanted);

/// The plan that plan_json() wrote. Throws Error (usage) or a JSON exception if `json` is not one.
EvalPlan plan_from_json(const nlohmann::ordered_json& json);

}  // namespace saccade
