// `saccade view` in a build with SACCADE_VIEWER=OFF: the command is known, and says why it does nothing.
#include "app/view_command.hpp"
#include "core/error.hpp"

namespace saccade {

void add_view_command(CLI::App& app, std::function<void()>& action) {
  CLI::App& command = *app.add_subcommand("view", "the viewer, which this build leaves out");
  command.prefix_command();  // whatever follows
  command.callback([&action] { action = [] { throw not_in_this_build("viewer", "SACCADE_VIEWER"); }; });
}

}  // namespace saccade
