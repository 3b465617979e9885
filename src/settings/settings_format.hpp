#pragma once

namespace saccade {

/// Version of the format of settings files (src/app/README.md, Versions): the value of their optional key
/// `format`. load_settings() refuses files of a newer one.
inline constexpr int kSettingsFormat = 1;

}  // namespace saccade
