#include "core/error.hpp"

#include <algorithm>

#include "core/text.hpp"

namespace saccade {
namespace {

std::string one_line(const std::string& what, const std::string& on, const std::string& hint) {
  std::string line = what;
  if (!on.empty()) line += ": " + on;
  if (!hint.empty()) line += " (" + hint + ")";
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return printable(line);
}

}  // namespace

Error::Error(ExitStatus status, const std::string& what, const std::string& on, const std::string& hint)
    : std::runtime_error(one_line(what, on, hint)), status_(status) {}

Error failed(const std::string& what, const std::string& on, const std::string& hint) {
  return {ExitStatus::failed, what, on, hint};
}
Error usage_error(const std::string& what, const std::string& on, const std::string& hint) {
  return {ExitStatus::usage, what, on, hint};
}
Error unreadable(const std::string& what, const std::string& on, const std::string& hint) {
  return {ExitStatus::unreadable, what, on, hint};
}
Error not_in_this_build(const std::string& part, const std::string& option) {
  return usage_error("this build has no " + part, "", "it was configured with " + option + "=OFF");
}

}  // namespace saccade
