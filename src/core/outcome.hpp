#pragma once

#include <string>
#include <utility>

namespace saccade {

/// Success, or the reason for a failure that the caller is expected to handle, such as one damaged frame in a
/// stream. A failure that ends the work is an Error instead.
class [[nodiscard]] Outcome {
 public:
  static Outcome success() { return Outcome(true, {}); }
  /// `reason`: one clause without the name of the thing that failed, e.g. "depth has 5 bytes too few".
  static Outcome failure(std::string reason) { return Outcome(false, std::move(reason)); }

  explicit operator bool() const { return ok_; }
  /// Empty after a success.
  const std::string& reason() const { return reason_; }

 private:
  Outcome(bool ok, std::string reason) : ok_(ok), reason_(std::move(reason)) {}

  bool ok_;
  std::string reason_;
};

}  // namespace saccade
