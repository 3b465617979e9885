#include "app/settings_command.hpp"

#include <memory>
#include <string>

#include "app/options.hpp"
#include "app/settings_texts.hpp"
#include "app/standard_output.hpp"

namespace saccade {

void add_settings_command(CLI::App& app, std::function<void()>& action) {
  CLI::App& command = *app.add_subcommand(
      "settings",
      "print settings as a file for --config: those of a file and of the options, or all defaults");
  struct State {
    explicit State(CLI::App& app_)
        : options(app_, {{SettingScope::model, SettingScope::attention, SettingScope::frames,
                          SettingScope::sensor, SettingScope::output, SettingScope::program}}) {}
    SettingsOptions options;
    bool all_defaults = false, paper = false;
  };
  const auto state = std::make_shared<State>(command);
  auto* all_defaults = command.add_flag("--default", state->all_defaults,
                                        "every setting with its default, unit and an explanation");
  command.add_flag("--paper", state->paper, "the set-up of the paper")->excludes(all_defaults);
  command.callback([state, &action] {
    action = [state] {
      const Settings settings = state->options.resolve();
      const std::string text = state->all_defaults ? std::string(kDefaultToml)
                               : state->paper      ? std::string(kPaperToml)
                                                   : settings_toml(settings);
      print_text(text, Reader::may_leave);
    };
  });
}

}  // namespace saccade
