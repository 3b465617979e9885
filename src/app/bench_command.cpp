#include "app/bench_command.hpp"

#include <memory>

#include "app/bench.hpp"
#include "app/options.hpp"

namespace saccade {

void add_bench_command(CLI::App& app, std::function<void()>& action) {
  CLI::App& command =
      *app.add_subcommand("bench", "measure the speed of this machine and the sensor modes that it sustains");
  const auto seconds = std::make_shared<double>(2);
  command.add_option("--seconds", *seconds, "time spent on each image size [2]")
      ->type_name("S")
      ->check(CLI::Range(0.0, 3600.0));
  const auto options = std::make_shared<SettingsOptions>(
      command, AcceptedSettings{{SettingScope::model, SettingScope::attention}, {"json", "workers"}});
  command.callback(
      [options, seconds, &action] { action = [options, seconds] { bench(options->resolve(), *seconds); }; });
}

}  // namespace saccade
