#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace saccade {

/// Describes the program to `app` and adds every command. Parsing sets `action` to the work of the command
/// that was given; it stays empty if there was none. `command_line` is noted in manifests.
void add_commands(CLI::App& app, std::function<void()>& action, const std::vector<std::string>& command_line);

/// Does what the arguments of main() say. Throws Error, also (usage) if the arguments have a mistake.
void run_command_line(int argc, char** argv);

}  // namespace saccade
