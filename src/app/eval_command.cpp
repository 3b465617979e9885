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
  EvalArguments& a = state->arguments;
  auto* dataset = add_source_option(command, "DATASET", a.dataset,
                                    "a source whose images have labels; see the end of this help");
  command.add_option("--out", a.out, "folder to write to; made if it does not exist")
      ->required()
      ->type_name("DIR");
  command.add_option("--models", a.models, "models to compare [that of the settings]")->type_name("LIST");
  command.add_option("--kernels", a.kernels, "kernel sizes to compare, in px [that of the settings]")
      ->type_name("LIST");
  command.add_option("--selectors", a.selectors, "selectors to compare [that of the settings]")
      ->type_name("LIST");
  command.add_option("--points", a.points, "attention points per image, 1..1000 [30; with --over-time 10]")
      ->type_name("N")
      ->check(CLI::Range(1, kMostPoints));
  command.add_flag("--over-time", a.over_time,
                   "measure how attention holds over time instead, on a sequence with camera poses or with "
                   "labels that keep their identity");
  command
      .add_option("--shard", a.shard,
                  "evaluate every n-th image only, from the i-th; combine the shards with --merge [1/1]")
      ->type_name("i/n");
  command.add_option("--merge", a.merge, "combine the results of all shards, instead of evaluating DATASET")
      ->type_name("DIR...")
      ->excludes(dataset);
  command.callback([state, &action] {
    action = [state] {
      const Settings settings = state->options.resolve();
      set_log_level(settings);
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
