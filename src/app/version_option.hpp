#pragma once

#include <functional>
#include <string>

#include <CLI/CLI.hpp>

namespace saccade {

/// The program's version, those of the formats of its files, and what it was built of, as JSON.
[[nodiscard]] std::string version_json();

/// Adds --version and its --json to `app`; parsing --version sets `action` to printing it.
void add_version_option(CLI::App& app, std::function<void()>& action);

}  // namespace saccade
