// write_manual DIR: the manual pages and the completion scripts, below DIR as below a prefix's share/.
#include <cstdio>
#include <filesystem>
#include <functional>

#include <CLI/CLI.hpp>

#include "app/commands.hpp"
#include "app/completion.hpp"
#include "app/manual.hpp"
#include "core/error.hpp"
#include "core/file.hpp"

namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  saccade::write_file(file, text);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return static_cast<int>(saccade::ExitStatus::usage);
  try {
    const fs::path share = argv[1];
    CLI::App program;
    std::function<void()> action;
    saccade::add_commands(program, action, {});
    const auto page = [&](const CLI::App& command) {
      write(share / "man/man1" / (saccade::man_page_name(program, command) + ".1"),
            saccade::man_page(program, command));
    };
    page(program);
    for (const CLI::App* command : saccade::commands_of(program)) page(*command);
    write(share / "bash-completion/completions/saccade", saccade::bash_completion(program));
    write(share / "zsh/vendor-completions/_saccade", saccade::zsh_completion(program));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "write_manual: %s\n", error.what());
    return static_cast<int>(saccade::ExitStatus::failed);
  }
}
