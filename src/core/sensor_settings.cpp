#include "core/sensor_settings.hpp"

#include <fmt/format.h>

namespace saccade {
namespace {

void parse_mode(SensorSettings& s, const std::string& text) {
  if (text.empty()) return s.mode.reset();
  const std::string expected = "WxH@HZ, e.g. 640x480@30";
  const auto x = text.find('x'), at = text.find('@');
  if (x == std::string::npos || (at != std::string::npos && at < x)) throw std::invalid_argument(expected);
  SensorMode mode;
  mode.width = parse_number(text.substr(0, x), 1, 16384, expected);
  mode.height =
      parse_number(text.substr(x + 1, at == std::string::npos ? at : at - x - 1), 1, 16384, expected);
  if (at != std::string::npos) mode.rate_hz = parse_number(text.substr(at + 1), 1, 1000, expected);
  s.mode = mode;
}

std::string print_mode(const SensorSettings& s) { return s.mode ? to_text(*s.mode) : ""; }

void parse_exposure(SensorSettings& s, const std::string& text) {
  if (text == "auto") return s.exposure.reset();
  s.exposure = parse_number(text, 0, 1'000'000, "auto, or an integer in 0..1000000");
}

std::string print_exposure(const SensorSettings& s) {
  return s.exposure ? print_number(*s.exposure) : std::string("auto");
}

void parse_white_balance(SensorSettings& s, const std::string& text) {
  if (text != "auto" && text != "fixed") throw std::invalid_argument("auto or fixed");
  s.auto_white_balance = text == "auto";
}

std::string print_white_balance(const SensorSettings& s) { return s.auto_white_balance ? "auto" : "fixed"; }

void parse_wait(SensorSettings& s, const std::string& text) {
  s.wait_s = parse_number(text, 0.0, 1e9, "seconds, 0..1e9");
}

}  // namespace

std::string to_text(const SensorMode& mode) {
  return fmt::format("{}x{}@{}", mode.width, mode.height, mode.rate_hz);
}

std::vector<SettingOf<SensorSettings>> sensor_setting_specs() {
  return {
      {"mode", "WxH@HZ", "size and rate, e.g. 320x240@60; default 640x480@30, or the sensor's nearest mode",
       parse_mode, print_mode},
      switch_setting<SensorSettings>("registration",
                                     "register depth to the colour camera, if the sensor can do so",
                                     &SensorSettings::registration),
      switch_setting<SensorSettings>("mirror", "mirror the images left to right", &SensorSettings::mirror),
      {"exposure", "N", "exposure of the colour camera in the sensor's own unit, or auto", parse_exposure,
       print_exposure},
      {"white-balance", "NAME", "white balance of the colour camera: auto, or fixed at its present value",
       parse_white_balance, print_white_balance},
      switch_setting<SensorSettings>(
          "reconnect", "wait for a sensor that was unplugged; with --no-reconnect its loss is an error",
          &SensorSettings::reconnect),
      {"wait", "S", "seconds to wait at the start for a sensor that is not connected", parse_wait,
       [](const SensorSettings& s) { return print_number(s.wait_s); }},
  };
}

}  // namespace saccade
