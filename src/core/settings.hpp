#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/intrinsics.hpp"

namespace saccade {

enum class LengthScale {
  relative,    ///< lambda = 5 % of the window's width at the depth of the pixel
  millimetre,  ///< lambda = 1 mm, as in the authors' experiments
};
enum class LevelNormalisation { none, max, itti };
enum class Selector { proto, wta };

/// A video mode of a sensor; written as 640x480@30.
struct SensorMode {
  int width = 640, height = 480;  ///< px
  int rate_hz = 30;
  bool operator==(const SensorMode&) const = default;
};
std::string to_text(const SensorMode& mode);

/// How a live sensor is to be used.
struct SensorSettings {
  std::optional<SensorMode> mode;  ///< none: 640x480@30, or what the device has that comes nearest
  bool registration = true;        ///< depth as seen from the colour camera
  bool mirror = false;
  std::optional<int> exposure;  ///< in the device's own unit; none: automatic
  bool auto_white_balance = true;
  bool reconnect = true;  ///< a lost device is waited for; false: losing it is an error
  double wait_s = 5;      ///< for a device that is not there at the start
};

/// Everything a person can set, with its default. The same names are the options of the command line and the
/// keys of a TOML file; `setting_specs()` is the one list of them.
struct Settings {
  // What is computed
  std::string model = "symmetry3d";
  int kernel = 15;             ///< k, px; the window is 2*floor(k/2)+1 a side; 3..127
  bool levels_chosen = false;  ///< false: the default levels, which may be cut to what an image has room for
  int first_level = 0, last_level = 4;                          ///< pyramid levels L1..L2 of Eq. (15)
  LengthScale length_scale = LengthScale::relative;             ///< unit of Delta D and Delta d in Eqs. (3)
  LevelNormalisation normalisation = LevelNormalisation::none;  ///< of each level's map before they are added
  std::string simd = "auto";  ///< highest instruction set of the fast operator

  // Attention points
  Selector selector = Selector::proto;
  int fixations = 10;  ///< points asked for per frame
  double foa = 64;     ///< focus of attention of wta, image px

  // Which frames
  std::int64_t frames = 0;  ///< at most so many; 0 = all
  std::int64_t start = 0;   ///< index of the first
  std::int64_t every = 1;   ///< take each n-th
  std::optional<Intrinsics> intrinsics;

  SensorSettings sensor;

  // How the program runs
  int workers = 0;  ///< threads that compute; 0 = one per processor
  std::set<std::string> dump = {"maps", "overlay"};
  bool json = false;
  bool quiet = false;
  std::string log_level = "info";
};

/// One setting: its name, how it is written, what it means, and the way in and out of Settings.
struct SettingSpec {
  std::string_view key;    ///< option --key and TOML key
  std::string_view value;  ///< what the help calls the value, e.g. "K"; empty for a switch
  std::string_view help;   ///< one line, with unit and range
  /// Throws std::invalid_argument whose text says what is expected, e.g. "3..127".
  std::function<void(Settings&, const std::string&)> parse;
  std::function<std::string(const Settings&)> print;  ///< parse(print(s)) gives s again
  std::vector<std::string> words{};                   ///< all that it can be; empty = no such list

  bool is_switch() const { return value.empty(); }
};

/// The keys of SensorSettings.
inline constexpr std::array<std::string_view, 7> kSensorKeys = {
    "mode", "registration", "mirror", "exposure", "white-balance", "reconnect", "wait"};

/// All settings, in the order of the help.
std::span<const SettingSpec> setting_specs();

/// Sets one by name. Throws Error (usage): unknown key (with the nearest known one), or a value out of range.
void apply_setting(Settings& settings, const std::string& key, const std::string& value);

/// Reads a TOML file of settings over `settings`. Throws Error (usage) for a syntax error, an unknown key or
/// a bad value, naming file and line; Error (unreadable) for a file that cannot be read.
void load_settings(Settings& settings, const std::string& path);

/// The settings that are not the default as a TOML file that load_settings() reads.
std::string settings_toml(const Settings& settings);

}  // namespace saccade
