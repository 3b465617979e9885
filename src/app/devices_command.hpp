#pragma once

#include <functional>

#include <CLI/CLI.hpp>

namespace saccade {

/// `saccade devices`: prints the sensors that OpenNI2 finds, with driver, modes and serial number. Finding
/// none is no failure. Throws Error if OpenNI2 does not start.
void devices(bool json);

/// Adds `saccade devices` to `app`; parsing it sets `action` to devices().
void add_devices_command(CLI::App& app, std::function<void()>& action);

}  // namespace saccade
