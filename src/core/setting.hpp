#pragma once

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace saccade {

/// One setting of `Part`, a structure of settings: its name, its text form, its help, and how it is read from
/// and written to that text form. A room lists the settings of its own structure; Settings
/// (settings/settings.hpp) joins the lists.
template <typename Part>
struct SettingOf {
  using Parse = std::function<void(Part&, const std::string&)>;
  using Print = std::function<std::string(const Part&)>;
  using Chosen = std::function<bool(const Part&)>;

  std::string_view key;    ///< option --key and TOML key
  std::string_view value;  ///< stands for the value in the help, e.g. "K"; empty for a switch
  std::string help;        ///< with unit and range
  /// Throws std::invalid_argument whose text says what is expected, e.g. "3..127".
  Parse parse;
  Print print;                     ///< parse(print(part)) restores the value
  std::vector<std::string> words;  ///< all possible values; empty = not a choice of words
  /// True if the value was set explicitly, where that matters even if it prints as the default does. Empty:
  /// it never matters.
  Chosen chosen;

  SettingOf(std::string_view key_, std::string_view value_, std::string help_, Parse parse_, Print print_,
            std::vector<std::string> words_ = {}, Chosen chosen_ = {})
      : key(key_),
        value(value_),
        help(std::move(help_)),
        parse(std::move(parse_)),
        print(std::move(print_)),
        words(std::move(words_)),
        chosen(std::move(chosen_)) {}

  bool is_switch() const { return value.empty(); }
};

/// The value of `text`, which must be nothing but a number in [low, high]. Throws
/// std::invalid_argument(expected).
template <typename Number>
[[nodiscard]] Number parse_number(std::string_view text, Number low, Number high,
                                  const std::string& expected) {
  Number value{};
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc{} || end != text.data() + text.size() || !(value >= low && value <= high))
    throw std::invalid_argument(expected);
  return value;
}

/// The shortest text that parse_number() reads back as the same number.
[[nodiscard]] std::string print_number(std::int64_t value);
[[nodiscard]] std::string print_number(double value);
[[nodiscard]] inline std::string print_number(int value) { return print_number(std::int64_t{value}); }

/// "true" or "false". Throws std::invalid_argument for anything else.
[[nodiscard]] bool parse_switch(std::string_view text);

/// Index of `text` in `words`. Throws std::invalid_argument that lists the words.
[[nodiscard]] std::size_t find_word(const std::vector<std::string>& words, std::string_view text);

/// `text` without the blanks at its ends.
[[nodiscard]] std::string_view without_blanks(std::string_view text);

/// The parts of a list with commas, without the blanks around them; an empty text has one empty part.
[[nodiscard]] std::vector<std::string> split_list(std::string_view text);

/// A number in [low, high]. In all four functions `field` is a member of Part or of a base of it.
template <typename Part, typename Base, typename Number>
SettingOf<Part> number_setting(std::string_view key, std::string_view value, std::string help,
                               Number Base::*field, std::type_identity_t<Number> low,
                               std::type_identity_t<Number> high) {
  const std::string expected = std::string(std::is_integral_v<Number> ? "an integer in " : "a number in ") +
                               print_number(low) + ".." + print_number(high);
  return {key, value, std::move(help),
          [=](Part& part, const std::string& text) { part.*field = parse_number(text, low, high, expected); },
          [=](const Part& part) { return print_number(part.*field); }};
}

/// One of `words`, kept as text.
template <typename Part, typename Base>
SettingOf<Part> word_setting(std::string_view key, std::string help, std::string Base::*field,
                             const std::vector<std::string>& words) {
  return {key,
          "NAME",
          std::move(help),
          [=](Part& part, const std::string& text) { part.*field = words[find_word(words, text)]; },
          [=](const Part& part) { return part.*field; },
          words};
}

/// One of the values of an enumeration, which `words` names in their order.
template <typename Part, typename Base, typename Enum>
SettingOf<Part> enum_setting(std::string_view key, std::string help, Enum Base::*field,
                             const std::vector<std::string>& words) {
  return {
      key,
      "NAME",
      std::move(help),
      [=](Part& part, const std::string& text) { part.*field = static_cast<Enum>(find_word(words, text)); },
      [=](const Part& part) { return words[static_cast<std::size_t>(part.*field)]; },
      words};
}

/// On or off.
template <typename Part, typename Base>
SettingOf<Part> switch_setting(std::string_view key, std::string help, bool Base::*field) {
  return {key, "", std::move(help),
          [=](Part& part, const std::string& text) { part.*field = parse_switch(text); },
          [=](const Part& part) { return part.*field ? "true" : "false"; }};
}

}  // namespace saccade
