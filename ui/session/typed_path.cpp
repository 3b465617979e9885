#include "ui/session/typed_path.hpp"

#include <climits>

#include <algorithm>
#include <charconv>
#include <cstdlib>

namespace saccade {
namespace {

constexpr std::string_view kSpace = " \t\r\n";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

std::string_view first_line(std::string_view text) {
  text = trimmed(text);
  return trimmed(text.substr(0, text.find('\n')));
}

std::string_view without_quotes(std::string_view text) {
  const bool quoted = text.size() > 1 && text.front() == text.back() && (text[0] == '\'' || text[0] == '"');
  return quoted ? text.substr(1, text.size() - 2) : text;
}

// "%20" becomes a space; what is no such code stays.
std::string decoded(std::string_view text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned char byte = 0;
    const char* end = text.data() + std::min(i + 3, text.size());
    const bool coded = text[i] == '%' && end - (text.data() + i) == 3 &&
                       std::from_chars(text.data() + i + 1, end, byte, 16).ptr == end;
    plain += coded ? static_cast<char>(byte) : text[i];
    if (coded) i += 2;
  }
  return plain;
}

// file:///path and file://host/path.
std::string path_of_uri(std::string_view uri) {
  const std::string_view rest = uri.substr(std::string_view("file://").size());
  const std::size_t slash = rest.find('/');
  return slash == std::string_view::npos ? "" : decoded(rest.substr(slash));
}

}  // namespace

std::string typed_path(std::string_view text) {
  std::string source(without_quotes(first_line(text)));
  if (source.starts_with("file://")) source = path_of_uri(source);
  const char* home = std::getenv("HOME");
  if (home != nullptr && (source == "~" || source.starts_with("~/"))) source = home + source.substr(1);
  const bool control = std::ranges::any_of(source, [](unsigned char c) { return c < ' ' || c == 0x7f; });
  return control || source.size() >= PATH_MAX ? "" : source;
}

}  // namespace saccade
