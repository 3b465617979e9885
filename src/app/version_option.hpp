#pragma once

#include <functional>

#include <CLI/CLI.hpp>
#include <nlohmann/json_fwd.hpp>

namespace saccade {

/// The program's version, those of the formats of its files, and what it was built of.
[[nodiscard]] nlohmann::ordered_json version_info();

/// Adds --version and its --json to `app`; parsing --version sets `action` to printing it.
void add_version_option(CLI::App& app, std::function<void()>& action);

}  // namespace saccade
