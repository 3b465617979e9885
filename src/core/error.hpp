#pragma once

#include <stdexcept>
#include <string>

namespace saccade {

/// The exit statuses of the program.
enum class ExitStatus {
  done = 0,
  failed = 1,      ///< failed while running: device lost, disk full
  usage = 2,       ///< the command line or the configuration is wrong
  unreadable = 3,  ///< the input cannot be read
  unfinished = 4,  ///< interrupted, or not complete: the same command goes on from there
};

/// A failure of the environment or of the input, for the user to read: what failed, on what, what to try.
/// A mistake in the calling code is std::invalid_argument instead.
class Error : public std::runtime_error {
 public:
  /// what() becomes the one line "what: on (try)"; `on` and `hint` may be empty. Line breaks become blanks,
  /// and characters that are not printable() are escaped.
  Error(ExitStatus status, const std::string& what, const std::string& on, const std::string& hint);

  ExitStatus status() const noexcept { return status_; }

 private:
  ExitStatus status_;
};

/// Shorthands for the three kinds of failure.
Error failed(const std::string& what, const std::string& on, const std::string& hint);
Error usage_error(const std::string& what, const std::string& on, const std::string& hint);
Error unreadable(const std::string& what, const std::string& on, const std::string& hint);

/// For a part that this build leaves out, an Error (usage): "OpenNI2", by the CMake option "SACCADE_OPENNI2".
Error not_in_this_build(const std::string& part, const std::string& option);

}  // namespace saccade
