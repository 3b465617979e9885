#pragma once

#include <functional>

#include <CLI/CLI.hpp>

namespace saccade {

/// `saccade devices`: the sensors that OpenNI2 finds, with driver, modes and serial number. None is no
/// failure. Throws Error if OpenNI2 does not start.
void devices(bool json);

/// Adds the command to `app`; parsing it sets `action` to what it does.
void add_devices_command(CLI::App& app, std::function<void()>& action);

}  // namespace saccade
