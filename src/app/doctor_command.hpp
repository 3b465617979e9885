#pragma once

#include <functional>
#include <string>

#include <CLI/CLI.hpp>

namespace saccade {

struct DoctorArguments {
  std::string sysfs = "/sys";
  bool json = false;
};

/// `saccade doctor`: tells why a sensor is not found or cannot be used: OpenNI2 and its driver modules, what
/// is on USB, permissions, speed; and what mends it. Finding problems is its work, not its failure.
void doctor(const DoctorArguments& arguments);

/// Adds the command to `app`; parsing it sets `action` to what it does.
void add_doctor_command(CLI::App& app, std::function<void()>& action);

}  // namespace saccade
