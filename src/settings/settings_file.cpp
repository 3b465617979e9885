#include <charconv>
#include <cstdint>
#include <vector>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "core/error.hpp"
#include "core/file.hpp"
#include "settings/settings.hpp"
#include "settings/settings_format.hpp"

namespace saccade {
namespace {

// The text of a TOML value as the command line would have it; an array becomes a list with commas.
std::string as_text(const toml::node& node) {
  if (const auto* text = node.as_string()) return text->get();
  if (const auto* number = node.as_integer()) return fmt::format("{}", number->get());
  if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
  if (const auto* truth = node.as_boolean()) return truth->get() ? "true" : "false";
  if (const auto* array = node.as_array()) {
    std::vector<std::string> list;
    for (const toml::node& element : *array) list.push_back(as_text(element));
    return fmt::format("{}", fmt::join(list, ","));
  }
  throw usage_error("not a value", "", "a number, a string, true, false or a list is expected");
}

void check_format(const toml::node& node) {
  const auto format = node.value<std::int64_t>();
  if (!format || *format < 1) throw usage_error("bad value for format", "", "a number from 1 is expected");
  if (*format > kSettingsFormat)
    throw usage_error(
        fmt::format("settings of format {}", *format), "",
        fmt::format("this version reads formats up to {}; a newer Saccade wrote them", kSettingsFormat));
}

}  // namespace

void load_settings(Settings& settings, const std::string& path) {
  const auto bytes = read_file(path, 1u << 20);
  const std::string hint = "saccade settings --default lists all keys";
  toml::table table;
  try {
    table = toml::parse(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()), path);
  } catch (const toml::parse_error& error) {
    throw usage_error("not valid TOML",
                      fmt::format("{}:{}: {}", path, error.source().begin.line, error.description()), hint);
  }
  for (const auto& [key, node] : table) {
    try {
      if (key.str() == "format")
        check_format(node);
      else
        apply_setting(settings, key.str(), as_text(node));
    } catch (const Error& error) {
      throw usage_error(error.what(), fmt::format("{}:{}", path, node.source().begin.line), hint);
    }
  }
}

std::string settings_toml(const Settings& settings) {
  std::string text = fmt::format(
      "# Settings of Saccade that differ from the default. Use them with --config FILE.\nformat = {}\n",
      kSettingsFormat);
  for (const SettingSpec& spec : setting_specs()) {
    if (is_default(spec, settings)) continue;
    const std::string value = spec.print(settings);
    double number = 0;
    const auto [end, code] = std::from_chars(value.data(), value.data() + value.size(), number);
    const bool bare = spec.is_switch() || (code == std::errc{} && end == value.data() + value.size());
    text += fmt::format("{} = {}\n", spec.key, bare ? value : fmt::format("\"{}\"", value));
  }
  return text;
}

}  // namespace saccade
