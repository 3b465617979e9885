#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <set>
#include <string>
#include <thread>
#include <utility>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "pipeline/pipeline.hpp"

namespace saccade {

/// Frames whose depth is their index; some are rejected, some fail.
class CountingSource : public FrameSource {
 public:
  explicit CountingSource(std::int64_t count, std::set<std::int64_t> rejected = {},
                          std::int64_t fails_at = -1)
      : count_(count), rejected_(std::move(rejected)), fails_at_(fails_at) {
    info_.size = {8, 8};
    info_.frame_count = count;
  }

  const SourceInfo& info() const override { return info_; }

  ReadResult read(Frame& frame, std::chrono::milliseconds) override {
    if (next_ >= count_) return {ReadStatus::end, ""};
    if (next_ == fails_at_) throw failed("source failed", "here", "nothing");
    frame.index = next_++;
    frame.depth_mm.create(8, 8);
    frame.depth_mm = static_cast<float>(frame.index);
    if (rejected_.contains(frame.index)) return {ReadStatus::rejected, "bad"};
    return {ReadStatus::frame, ""};
  }

  void seek(std::int64_t index) override { next_ = index; }

 protected:
  SourceInfo info_;
  std::int64_t next_ = 0;

 private:
  std::int64_t count_;
  std::set<std::int64_t> rejected_;
  std::int64_t fails_at_;
};

/// Copies the depth to the map, after a delay.
class CopyProcessor : public FrameProcessor {
 public:
  explicit CopyProcessor(std::chrono::microseconds delay = {}, std::int64_t fails_at = -1)
      : delay_(delay), fails_at_(fails_at) {}
  void process(Result& result) override {
    if (result.frame.index == fails_at_) throw failed("processor failed", "here", "nothing");
    if (delay_.count() > 0) std::this_thread::sleep_for(delay_);
    result.frame.depth_mm.copyTo(result.maps.master);
  }

 private:
  std::chrono::microseconds delay_;
  std::int64_t fails_at_;
};

inline void expect_balanced(const Ledger& ledger) {
  EXPECT_EQ(ledger.in_flight(), 0) << ledger.captured << " captured, " << ledger.processed << " processed, "
                                   << ledger.dropped << " dropped, " << ledger.rejected << " rejected";
  EXPECT_LE(ledger.replaced, ledger.dropped);
}

/// Checks the ledger all the time while a pipeline runs.
class LedgerWatch {
 public:
  LedgerWatch(const Pipeline& pipeline, int slots)
      : thread_([&pipeline, slots](const std::stop_token& token) {
          while (!token.stop_requested()) {
            const Ledger ledger = pipeline.ledger();
            ASSERT_GE(ledger.in_flight(), 0);
            ASSERT_LE(ledger.in_flight(), slots);
            ASSERT_LE(ledger.replaced, ledger.dropped);
            std::this_thread::yield();
          }
        }) {}

 private:
  std::jthread thread_;
};

}  // namespace saccade
