#pragma once

#include <atomic>
#include <cstdint>

namespace saccade {

/// Counts every frame that was read, so that none is lost silently. When the pipeline has ended,
/// captured = processed + dropped + rejected; while it runs, the difference is the number of frames in
/// flight, from 0 to the number of slots of the pipeline.
struct Ledger {
  std::int64_t captured = 0;   ///< frames read from the source, usable or not
  std::int64_t processed = 0;  ///< computed and handed to the consumer
  std::int64_t dropped = 0;    ///< usable, but not computed: `replaced` and stopped()
  std::int64_t rejected = 0;   ///< not usable: unreadable, of another size, not depth

  std::int64_t replaced = 0;  ///< of the dropped: overtaken by a newer frame

  /// Of the dropped: the pipeline stopped or failed first.
  std::int64_t stopped() const { return dropped - replaced; }
  std::int64_t in_flight() const { return captured - processed - dropped - rejected; }
  bool operator==(const Ledger&) const = default;
};

/// The counters behind a Ledger. Lock-free; any thread may count and read. `Counter` is an atomic integer; a
/// test has one that changes while it is read.
template <typename Counter>
class LedgerCountersOf {
 public:
  enum Event { captured, processed, replaced, stopped, rejected };

  void count(Event event) noexcept { counts_[event].fetch_add(1); }

  /// A consistent state: counters only grow, so two equal readings in succession are of one state.
  Ledger snapshot() const noexcept {
    Ledger last = read();
    for (Ledger now = read(); !(now == last); now = read()) last = now;
    return last;
  }

 private:
  Ledger read() const noexcept {
    Ledger ledger;
    ledger.captured = counts_[captured];
    ledger.processed = counts_[processed];
    ledger.rejected = counts_[rejected];
    ledger.replaced = counts_[replaced];
    ledger.dropped = ledger.replaced + counts_[stopped];
    return ledger;
  }

  Counter counts_[rejected + 1] = {};
};

using LedgerCounters = LedgerCountersOf<std::atomic<std::int64_t>>;

}  // namespace saccade
