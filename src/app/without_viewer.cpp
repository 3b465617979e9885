// `saccade view` in a build with SACCADE_VIEWER=OFF: an error that says so.
#include "app/view_command.hpp"
#include "core/error.hpp"

namespace saccade {

void add_view_command(CLI::App& app, std::function<void()>& action) {
  CLI::App& command = *app.add_subcommand("view", "not in this build");
  command.prefix_command();  // accepts any arguments
  command.callback([&action] { action = [] { throw not_in_this_build("viewer", "SACCADE_VIEWER"); }; });
}

}  // namespace saccade
