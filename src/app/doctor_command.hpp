#pragma once

#include <functional>
#include <string>

#include <CLI/CLI.hpp>

namespace saccade {

struct DoctorArguments {
  std::string sysfs = "/sys";
  bool json = false;
};

/// `saccade doctor`: reports why a sensor is not found or cannot be used, and the remedy. Examines OpenNI2
/// and its driver modules, the sensors on USB, their permissions and speed. Problems that it finds are no
/// failure.
void doctor(const DoctorArguments& arguments);

/// Adds `saccade doctor` to `app`; parsing it sets `action` to doctor().
void add_doctor_command(CLI::App& app, std::function<void()>& action);

}  // namespace saccade
