#include <csignal>
#include <cstdio>
#include <exception>
#include <functional>
#include <new>
#include <string>
#include <vector>

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include "app/commands.hpp"
#include "core/error.hpp"

namespace {

using saccade::ExitStatus;

int report(const std::string& line, ExitStatus status) {
  std::fprintf(stderr, "saccade: %s\n", line.c_str());
  return static_cast<int>(status);
}

int run_program(int argc, char** argv) {
  spdlog::set_default_logger(spdlog::stderr_color_mt("saccade"));
  spdlog::set_pattern("%n: %l: %v");

  CLI::App app;
  std::function<void()> action;
  saccade::add_commands(app, action, {argv, argv + argc});

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {  // --help
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    return report(std::string(error.what()) + " (see saccade --help)", ExitStatus::usage);
  }
  if (!action) return report("no command (see saccade --help)", ExitStatus::usage);
  action();
  return static_cast<int>(ExitStatus::done);
}

}  // namespace

int main(int argc, char** argv) {
  // A file-size limit and a closed pipe then appear as a failed write, which is reported like a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  try {
    return run_program(argc, argv);
  } catch (const saccade::Error& error) {
    return report(error.what(), error.status());
  } catch (const std::bad_alloc&) {
    return report("out of memory (try a smaller image or fewer --workers)", ExitStatus::failed);
  } catch (const std::exception& error) {
    return report(std::string("unexpected: ") + error.what(), ExitStatus::failed);
  }
}
