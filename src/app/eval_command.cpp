#include "app/eval_command.hpp"

#include <memory>

#include "app/command.hpp"
#include "app/eval.hpp"
#include "app/eval_over_time.hpp"
#include "app/options.hpp"
#include "app/source_option.hpp"
#include "core/error.hpp"
#include "eval/plan.hpp"

namespace saccade {
namespace {

// The options that are not settings. Those that would have no effect beside another one are refused.
void add_arguments(CLI::App& command, EvalArguments& a) {
  const auto add = [&](const char* name, auto& value, const char* type, const char* help) {
    return command.add_option(name, value, help)->type_name(type);
  };
  auto* dataset = add_source_option(command, "DATASET", a.dataset,
                                    "a source whose images have labels; see the end of this help");
  auto* out = add("--out", a.out, "DIR", "folder to write to; made if it does not exist");
  auto* models = add("--models", a.models, "LIST", "models to compare [that of the settings]");
  auto* kernels =
      add("--kernels", a.kernels, "LIST", "kernel sizes to compare, in px [that of the settings]");
  auto* selectors = add("--selectors", a.selectors, "LIST", "selectors to compare [that of the settings]");
  auto* points =
      add("--points", a.points, "N", "attention points per image, 1..1000 [30; with --over-time 10]")
          ->check(CLI::Range(1, kMostPoints));
  auto* over_time = command.add_flag(
      "--over-time", a.over_time,
      "measure how attention holds over time instead, on a sequence with camera poses or with "
      "labels that keep their identity");
  auto* shard = add("--shard", a.shard, "i/n",
                    "evaluate every n-th image only, from the i-th; combine the shards with --merge [1/1]");
  auto* merge =
      add("--merge", a.merge, "DIR...", "combine the results of all shards, instead of evaluating DATASET");
  command
      .add_flag("--partial", a.partial,
                "with --merge: also if shards are missing or not complete; the report says which")
      ->needs(merge);
  auto* status = add("--status", a.status, "DIR...",
                     "report how far each shard is, and which are missing; exit status 4 unless all are "
                     "complete");
  for (CLI::Option* option : {kernels, selectors, shard}) over_time->excludes(option);
  for (CLI::Option* option : {dataset, models, kernels, selectors, points, shard, over_time})
    merge->excludes(option);
  for (CLI::Option* option : {out, dataset, models, kernels, selectors, points, shard, over_time, merge})
    status->excludes(option);
}

}  // namespace

void add_eval_command(CLI::App& app, std::function<void()>& action) {
  struct State {
    explicit State(CLI::App& command)
        : options(command, {{SettingScope::model, SettingScope::attention, SettingScope::frames,
                             SettingScope::program},
                            {"json"},
                            {kPlanKeys.begin(), kPlanKeys.end()}}) {}
    EvalArguments arguments;
    SettingsOptions options;
  };
  CLI::App& command = *app.add_subcommand(
      "eval", "measure the Hit Ratio of models, kernels and selectors on labelled images");
  const auto state = std::make_shared<State>(command);
  add_arguments(command, state->arguments);
  command.callback([state, &action] {
    action = [state] {
      const Settings settings = state->options.resolve();
      set_log_level(settings);
      if (!state->arguments.status.empty()) return eval_status(state->arguments, settings.json);
      if (state->arguments.out.empty())
        throw usage_error("no folder to write to", "eval", "name one with --out");
      if (state->arguments.over_time && !state->arguments.dataset.empty())
        eval_over_time(state->arguments, settings);
      else if (!state->arguments.merge.empty())
        eval_merge(state->arguments, settings);
      else if (!state->arguments.dataset.empty())
        eval(state->arguments, settings);
      else
        throw usage_error("no data set", "eval", "name a DATASET, or the folders of shards with --merge");
    };
  });
}

}  // namespace saccade
