#include "ui/session/sensor_settings_sync.hpp"

namespace saccade {

void store_request(SensorSettings& settings, const SensorValues& wanted, const SensorValues& now) {
  if (wanted.registration) settings.registration = *wanted.registration;
  if (wanted.mirror) settings.mirror = *wanted.mirror;
  if (wanted.auto_white_balance) settings.auto_white_balance = *wanted.auto_white_balance;
  if (wanted.auto_exposure) {
    if (*wanted.auto_exposure)
      settings.exposure.reset();
    else if (now.exposure)
      settings.exposure = now.exposure;
  }
  if (wanted.exposure) settings.exposure = wanted.exposure;
}

SensorValues changed_values(const SensorSettings& from, const SensorSettings& to) {
  SensorValues request;
  if (from.registration != to.registration) request.registration = to.registration;
  if (from.mirror != to.mirror) request.mirror = to.mirror;
  if (from.auto_white_balance != to.auto_white_balance) request.auto_white_balance = to.auto_white_balance;
  if (from.exposure != to.exposure) {
    request.auto_exposure = !to.exposure;
    request.exposure = to.exposure;
  }
  return request;
}

}  // namespace saccade
