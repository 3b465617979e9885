#pragma once

#include <cstdint>
#include <ostream>
#include <span>
#include <string_view>
#include <vector>

namespace saccade {

using Bytes = std::vector<std::uint8_t>;

/// A parser of what others write, as a target of fuzzing.
struct FuzzedParser {
  std::string_view name;
  std::vector<Bytes> (*seeds)();  ///< small sound inputs
  /// Reads any bytes as the program would; false if it refuses them. Throws only if the parser did what it
  /// must not do: an exception that its header does not name, an error of several lines, or a result that
  /// breaks a promise.
  bool (*read)(std::span<const std::uint8_t>);
};

/// For messages of tests.
inline void PrintTo(const FuzzedParser& parser, std::ostream* out) { *out << parser.name; }

/// All of them but the reader of recordings, which has mutants of its own kind (tests/oni).
[[nodiscard]] std::span<const FuzzedParser> fuzzed_parsers();

/// Throws std::invalid_argument for an unknown name.
[[nodiscard]] const FuzzedParser& fuzzed_parser(std::string_view name);

}  // namespace saccade
