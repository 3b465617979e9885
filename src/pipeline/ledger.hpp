#pragma once

#include <atomic>
#include <cstdint>

namespace saccade {

/// What became of every frame that was read. Nothing is lost silently: when the pipeline has ended,
/// captured = processed + dropped + rejected; while it runs the difference is what is in flight, which is
/// never less than 0 nor more than the pipeline has slots.
struct Ledger {
  std::int64_t captured = 0;   ///< read from the source, usable or not
  std::int64_t processed = 0;  ///< computed and handed to the consumer
  std::int64_t dropped = 0;    ///< usable, but given up, for one of two causes
  std::int64_t rejected = 0;   ///< not usable: unreadable, of another size, not depth

  std::int64_t replaced = 0;  ///< of the dropped: a newer frame came before their turn

  /// Of the dropped: the pipeline was stopped, or failed, before they were computed.
  std::int64_t stopped() const { return dropped - replaced; }
  std::int64_t in_flight() const { return captured - processed - dropped - rejected; }
  bool operator==(const Ledger&) const = default;
};

/// The counters behind a Ledger. Lock-free; any thread may count and read.
class LedgerCounters {
 public:
  enum Event { captured, processed, replaced, stopped, rejected };

  void count(Event event) noexcept { counts_[event].fetch_add(1); }

  /// As it was at one moment: counters only grow, so two equal readings in a row are of one state.
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

  std::atomic<std::int64_t> counts_[rejected + 1] = {};
};

}  // namespace saccade
