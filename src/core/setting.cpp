#include "core/setting.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace saccade {

std::string print_number(std::int64_t value) { return fmt::format("{}", value); }

std::string print_number(double value) { return fmt::format("{}", value); }

bool parse_switch(std::string_view text) {
  if (text != "true" && text != "false") throw std::invalid_argument("true or false");
  return text == "true";
}

std::size_t find_word(const std::vector<std::string>& words, std::string_view text) {
  const auto found = std::find(words.begin(), words.end(), text);
  if (found == words.end()) throw std::invalid_argument(fmt::format("one of {}", fmt::join(words, ", ")));
  return static_cast<std::size_t>(found - words.begin());
}

std::string_view without_blanks(std::string_view text) {
  const auto begin = text.find_first_not_of(' ');
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(' ') + 1 - begin);
}

std::vector<std::string> split_list(std::string_view text) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find(',', begin)) != std::string_view::npos; begin = end + 1)
    parts.emplace_back(without_blanks(text.substr(begin, end - begin)));
  parts.emplace_back(without_blanks(text.substr(begin)));
  return parts;
}

}  // namespace saccade
