#include "app/run_command.hpp"

#include <memory>
#include <utility>

#include "app/command.hpp"
#include "app/options.hpp"
#include "app/run.hpp"
#include "app/source_option.hpp"

namespace saccade {

void add_run_command(CLI::App& app, std::function<void()>& action, std::vector<std::string> command_line) {
  CLI::App& command = *app.add_subcommand(
      "run", "process a source without a window: write maps, overlays and attention points");
  const auto arguments = std::make_shared<RunArguments>();
  arguments->command_line = std::move(command_line);
  add_source_option(command, "SOURCE", arguments->source, "what to process; see the end of this help")
      ->required();
  command.add_option("--out", arguments->out, "folder to write to; made if it does not exist")
      ->required()
      ->type_name("DIR");
  command
      .add_option("--shard", arguments->shard,
                  "process the i-th of n parts of the frames only, which follow one another [1/1]")
      ->type_name("i/n");
  command.add_flag("--resume", arguments->resume,
                   "go on with an interrupted run of the same command in the folder; exit status 4 if "
                   "interrupted again");
  const auto options = std::make_shared<SettingsOptions>(
      command, AcceptedSettings{{SettingScope::model, SettingScope::attention, SettingScope::tracking,
                                 SettingScope::frames, SettingScope::sensor, SettingScope::output,
                                 SettingScope::program}});
  command.callback([arguments, options, &action] {
    action = [arguments, options] {
      const Settings settings = options->resolve();
      set_log_level(settings);
      run(*arguments, settings);
    };
  });
}

}  // namespace saccade
