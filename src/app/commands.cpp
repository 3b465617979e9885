#include "app/commands.hpp"

#include <sstream>

#include <CLI/CLI.hpp>

#include "app/bench_command.hpp"
#include "app/devices_command.hpp"
#include "app/doctor_command.hpp"
#include "app/eval_command.hpp"
#include "app/export_command.hpp"
#include "app/oni_command.hpp"
#include "app/record_command.hpp"
#include "app/run_command.hpp"
#include "app/settings_command.hpp"
#include "app/standard_output.hpp"
#include "app/version_option.hpp"
#include "app/view_command.hpp"
#include "core/error.hpp"

namespace saccade {

void add_commands(CLI::App& app, std::function<void()>& action,
                  const std::vector<std::string>& command_line) {
  app.name("saccade");
  app.description("Saccade: saliency and attention points of RGB-D images by local 3D symmetry");
  add_version_option(app, action);
  add_view_command(app, action);
  add_run_command(app, action, command_line);
  add_record_command(app, action);
  add_export_command(app, action);
  add_devices_command(app, action);
  add_doctor_command(app, action);
  add_eval_command(app, action);
  add_oni_command(app, action);
  add_settings_command(app, action);
  add_bench_command(app, action);
}

void run_command_line(int argc, char** argv) {
  CLI::App app;
  std::function<void()> action;
  add_commands(app, action, {argv, argv + argc});
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {  // --help
    std::ostringstream text;
    app.exit(success, text);
    return print_text(text.str(), Reader::may_leave);
  } catch (const CLI::ParseError& error) {
    throw usage_error(error.what(), "", "see saccade --help");
  }
  if (!action) throw usage_error("no command", "", "see saccade --help");
  action();
}

}  // namespace saccade
