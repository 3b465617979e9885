#include "eval/plan.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/version.hpp"
#include "eval/evaluation_format.hpp"
#include "output/json_text.hpp"
#include "pipeline/shard.hpp"

namespace saccade {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::int64_t kMostPositions = 1'000'000'000'000;

// Reads each word of the list with the setting's own parser; `take` gets the settings that hold it.
template <typename Take>
void parse_list(const EvalPlan& plan, const std::string& key, const std::string& list, Take take) {
  const auto words = split_list(list.empty() ? setting_spec(key).print(plan.settings) : list);
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (std::find(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(i), words[i]) !=
        words.begin() + static_cast<std::ptrdiff_t>(i))
      throw usage_error(fmt::format("'{}' is given twice", words[i]), fmt::format("--{}s", key),
                        "give it once");
    Settings settings;
    apply_setting(settings, key, words[i]);
    take(settings);
  }
}

// For the first key whose values differ.
std::optional<std::string> first_difference(const Json& stored, const Json& wanted) {
  for (const auto& [key, value] : wanted.items()) {
    if (key == "dataset") continue;
    const auto other = stored.find(key);
    if (other == stored.end()) return fmt::format("{} is missing", key);
    if (*other == value) continue;
    if (value.is_object()) return first_difference(*other, value);
    if (key == "content")
      return fmt::format("the images of the data sets {} and {} differ", dump(stored.at("dataset")),
                         dump(wanted.at("dataset")));
    return fmt::format("{} is {}, not {}", key, dump(*other), dump(value));
  }
  return std::nullopt;
}

}  // namespace

std::string to_string(Selector selector) {
  Settings settings;
  settings.selector = selector;
  return setting_spec("selector").print(settings);
}

std::string describe(const Condition& condition) {
  return fmt::format("{}, k = {}, {}", condition.model, condition.kernel, to_string(condition.selector));
}

bool is_kept(const SettingSpec& spec) {
  const bool changes_results = spec.scope == SettingScope::model || spec.scope == SettingScope::attention ||
                               spec.scope == SettingScope::frames;
  return changes_results && std::find(kPlanKeys.begin(), kPlanKeys.end(), spec.key) == kPlanKeys.end();
}

std::vector<Condition> EvalPlan::conditions() const {
  std::vector<Condition> all;
  for (const std::string& model : models)
    for (const int kernel : kernels)
      for (const Selector selector : selectors) all.push_back({model, kernel, selector});
  return all;
}

std::optional<std::int64_t> EvalPlan::position_of(std::int64_t frame) const {
  const std::int64_t offset = frame - settings.start, position = offset / settings.every;
  const bool selected = offset >= 0 && offset % settings.every == 0 && position < positions;
  return selected && position % shards == shard - 1 ? std::optional(position) : std::nullopt;
}

Settings EvalPlan::settings_of(const Condition& condition) const {
  Settings s = settings;
  s.model = condition.model;
  s.kernel = condition.kernel;
  s.selector = condition.selector;
  s.fixations = points;
  s.min_confidence = 0;
  return s;
}

void parse_lists(EvalPlan& plan, const std::string& models, const std::string& kernels,
                 const std::string& selectors) {
  parse_list(plan, "model", models, [&](const Settings& s) { plan.models.push_back(s.model); });
  parse_list(plan, "kernel", kernels, [&](const Settings& s) { plan.kernels.push_back(s.kernel); });
  parse_list(plan, "selector", selectors, [&](const Settings& s) { plan.selectors.push_back(s.selector); });
}

void parse_shard(EvalPlan& plan, const std::string& text) {
  const Shard shard = parse_shard(text);
  plan.shard = shard.index;
  plan.shards = shard.count;
}

Json plan_json(const EvalPlan& plan) {
  Json settings = Json::object(), selectors = Json::array();
  for (const SettingSpec& spec : setting_specs())
    if (is_kept(spec)) settings[std::string(spec.key)] = spec.print(plan.settings);
  for (const Selector selector : plan.selectors) selectors.push_back(to_string(selector));
  return {{"format", kEvaluationFormat}, {"version", kVersion},      {"dataset", plan.dataset},
          {"content", plan.content},     {"frames", plan.positions}, {"models", plan.models},
          {"kernels", plan.kernels},     {"selectors", selectors},   {"points", plan.points},
          {"settings", settings},        {"shard", plan.shard},      {"shards", plan.shards}};
}

std::optional<std::string> difference(const EvalPlan& stored, const EvalPlan& wanted) {
  return first_difference(plan_json(stored), plan_json(wanted));
}

EvalPlan plan_from_json(const Json& json) {
  if (json.at("format") != kEvaluationFormat)
    throw usage_error("results of another version", "", "evaluate again");
  EvalPlan plan;
  plan.dataset = json.at("dataset");
  plan.content = json.at("content");
  const auto integer = [&](const char* key, std::int64_t low, std::int64_t high) {
    const Json& value = json.at(key);
    if (!value.is_number_integer() || value.get<double>() < static_cast<double>(low) ||
        value.get<double>() > static_cast<double>(high))
      throw usage_error(fmt::format("{} is not an integer from {} to {}", key, low, high), "",
                        "evaluate again");
    return value.get<std::int64_t>();
  };
  plan.positions = integer("frames", 0, kMostPositions);
  plan.points = static_cast<int>(integer("points", 1, kMostPoints));
  plan.shards = static_cast<int>(integer("shards", 1, kMostShards));
  plan.shard = static_cast<int>(integer("shard", 1, plan.shards));
  const auto list = [&](const char* key) {
    std::string words;
    for (const auto& word : json.at(key))
      words += (words.empty() ? "" : ",") + (word.is_string() ? word.get<std::string>() : word.dump());
    return words;
  };
  parse_lists(plan, list("models"), list("kernels"), list("selectors"));
  for (const auto& [key, value] : json.at("settings").items()) apply_setting(plan.settings, key, value);
  return plan;
}

}  // namespace saccade
