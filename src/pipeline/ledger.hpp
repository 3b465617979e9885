#pragma once

#include <cstdint>

namespace saccade {

/// What became of every frame that was read. Nothing is lost silently: when the pipeline has ended,
/// captured = processed + dropped + rejected; while it runs the difference is what is in flight.
struct Ledger {
  std::int64_t captured = 0;   ///< read from the source, usable or not
  std::int64_t processed = 0;  ///< computed and handed to the consumer
  std::int64_t dropped = 0;    ///< usable, but given up: the pipeline was stopped before their turn
  std::int64_t rejected = 0;   ///< not usable: unreadable, of another size, not depth

  std::int64_t in_flight() const { return captured - processed - dropped - rejected; }
  bool operator==(const Ledger&) const = default;
};

}  // namespace saccade
