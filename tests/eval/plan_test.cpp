#include "eval/plan.hpp"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "samples.hpp"
#include "tests/support/error_of.hpp"
#include "tests/support/other_value.hpp"

namespace saccade {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

template <typename Action>
std::string usage_error_of(const Action& action) {
  return error_of(ExitStatus::usage, action);
}

TEST(EvalPlan, ConditionsAreAllCombinations) {
  const auto conditions = sample_plan().conditions();
  ASSERT_EQ(conditions.size(), 4U);
  EXPECT_EQ(conditions[0], (Condition{"symmetry3d", 10, Selector::proto}));
  EXPECT_EQ(conditions[1], (Condition{"symmetry3d", 10, Selector::wta}));
  EXPECT_EQ(conditions[2], (Condition{"symmetry3d", 15, Selector::proto}));
  EXPECT_EQ(describe(conditions[3]), "symmetry3d, k = 15, wta");
  const Settings settings = sample_plan().settings_of(conditions[1]);
  EXPECT_EQ(settings.kernel, 10);
  EXPECT_EQ(settings.selector, Selector::wta);
  EXPECT_EQ(settings.fixations, 3);
  EXPECT_EQ(settings.min_confidence, 0) << "every point counts";
}

TEST(EvalPlan, EmptyListsAreThoseOfTheSettings) {
  EvalPlan plan;
  plan.settings.kernel = 21;
  plan.settings.selector = Selector::wta;
  parse_lists(plan, "", "", "");
  EXPECT_THAT(plan.models, ElementsAre("symmetry3d"));
  EXPECT_THAT(plan.kernels, ElementsAre(21));
  EXPECT_THAT(plan.selectors, ElementsAre(Selector::wta));
}

TEST(EvalPlan, ListsThatAreWrong) {
  EvalPlan plan;
  EXPECT_THAT(usage_error_of([&] { parse_lists(plan, "nonsense", "", ""); }), HasSubstr("symmetry3d"));
  EXPECT_THAT(usage_error_of([&] { parse_lists(plan, "", "10,", ""); }), HasSubstr("3..127"));
  EXPECT_THAT(usage_error_of([&] { parse_lists(plan, "", "10,200", ""); }), HasSubstr("'200'"));
  EXPECT_THAT(usage_error_of([&] { parse_lists(plan, "", "", "wta,proto,wta"); }), HasSubstr("twice"));
}

TEST(EvalPlan, Shards) {
  EvalPlan plan;
  parse_shard(plan, "3/8");
  EXPECT_EQ(plan.shard, 3);
  EXPECT_EQ(plan.shards, 8);
  for (const char* wrong : {"", "3", "3/", "/8", "0/8", "9/8", "3/8x", "-1/8", "1/100001", "1.5/8"})
    EXPECT_THAT(usage_error_of([&] { parse_shard(plan, wrong); }), HasSubstr("i/n")) << wrong;
}

TEST(EvalPlan, FramesAreThoseOfStartAndEvery) {
  EvalPlan plan;
  plan.settings.start = 4;
  plan.settings.every = 3;
  EXPECT_EQ(plan.frame_at(0), 4);
  EXPECT_EQ(plan.frame_at(5), 19);
  plan.positions = 6;
  for (int frame = 0; frame < 25; ++frame) {
    const bool is_one = frame >= 4 && frame <= 19 && (frame - 4) % 3 == 0;
    EXPECT_EQ(plan.position_of(frame), is_one ? std::optional<std::int64_t>((frame - 4) / 3) : std::nullopt)
        << frame;
  }
  plan.shards = 4;
  plan.shard = 2;  // of the positions 0..5: 1 and 5
  EXPECT_EQ(plan.position_of(7), 1);
  EXPECT_EQ(plan.position_of(19), 5);
  EXPECT_FALSE(plan.position_of(4) || plan.position_of(10) || plan.position_of(16));
}

TEST(EvalPlan, ComesBackFromJson) {
  EvalPlan plan = sample_plan();
  plan.settings.first_level = 1;
  plan.settings.length_scale = LengthScale::millimetre;
  plan.settings.every = 2;
  plan.settings.intrinsics = Intrinsics{500, 501, 300.5, 200, IntrinsicsOrigin::option};
  plan.shard = 2;
  plan.shards = 5;
  const EvalPlan again = plan_from_json(plan_json(plan));
  EXPECT_EQ(plan_json(again), plan_json(plan));
  EXPECT_EQ(again.settings.length_scale, LengthScale::millimetre);
  EXPECT_EQ(again.settings.intrinsics->cx, 300.5);
  EXPECT_EQ(again.conditions(), plan.conditions());
}

TEST(EvalPlan, JsonOfNoPlan) {
  const std::vector<std::pair<std::string, std::string>> wrong = {{"models", R"(["../nonsense"])"},
                                                                  {"kernels", "[1]"},
                                                                  {"selectors", R"(["none"])"},
                                                                  {"points", "0"},
                                                                  {"shard", "2"},
                                                                  {"format", "2"}};
  for (const auto& [key, value] : wrong) {
    auto json = plan_json(sample_plan());
    json[key] = nlohmann::ordered_json::parse(value);
    usage_error_of([&] { plan_from_json(json); });
    json.erase(key);
    EXPECT_ANY_THROW(plan_from_json(json)) << key;
  }
}

TEST(EvalPlan, JsonKeepsTheSettingsThatChangeResults) {
  EvalPlan plan = sample_plan();
  const auto before = plan_json(plan);
  for (const SettingSpec& spec : setting_specs()) {
    plan.settings = changed(spec);
    const bool listed = std::find(kPlanKeys.begin(), kPlanKeys.end(), spec.key) != kPlanKeys.end();
    const bool kept = spec.scope <= SettingScope::frames && spec.scope != SettingScope::tracking && !listed;
    EXPECT_EQ(plan_json(plan) != before, kept) << spec.key;
  }
}

}  // namespace
}  // namespace saccade
