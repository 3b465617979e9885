#include "pipeline/source_state_notifier.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "pipeline_parts.hpp"

namespace saccade {
namespace {

using Connection = SourceState::Connection;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

// A source whose state the test sets.
class MutableSource : public CountingSource {
 public:
  MutableSource() : CountingSource(0) { info_.notes = {"opened so"}; }
  SourceState state() const override {
    ++looks;
    return now;
  }
  SourceState now;
  mutable int looks = 0;
};

class StateWatchTest : public ::testing::Test {
 protected:
  void watch() {
    watch_.emplace(source_, [this](const SourceState& state) { told_.push_back(state); });
    source_.looks = 0;
  }
  void becomes(Connection connection, std::vector<std::string> notes) {
    source_.now.connection = connection;
    source_.now.notes = std::move(notes);
  }

  MutableSource source_;
  std::vector<SourceState> told_;
  std::optional<SourceStateNotifier> watch_;
};

TEST_F(StateWatchTest, FramesInTimeCostNothing) {
  watch();
  for (int i = 0; i < 5; ++i) watch_->after_read(ReadStatus::frame);
  EXPECT_EQ(source_.looks, 0);
  EXPECT_THAT(told_, IsEmpty());
}

TEST_F(StateWatchTest, ALossAndTheReturnAreToldOnceEach) {
  becomes(Connection::streaming, {"opened so"});
  watch();
  becomes(Connection::lost, {"opened so"});
  for (int i = 0; i < 3; ++i) watch_->after_read(ReadStatus::timeout);
  becomes(Connection::streaming, {"opened so"});
  for (int i = 0; i < 3; ++i) watch_->after_read(ReadStatus::frame);
  ASSERT_EQ(told_.size(), 2U);
  EXPECT_EQ(told_[0].connection, Connection::lost);
  EXPECT_EQ(told_[1].connection, Connection::streaming);
  EXPECT_THAT(told_[1].notes, IsEmpty()) << "they are those of the opening";
}

TEST_F(StateWatchTest, WhatTheDeviceThatComesBackDoesOtherwiseIsTold) {
  watch();
  for (int round = 0; round < 2; ++round) {
    becomes(Connection::lost, {"opened so"});
    watch_->after_read(ReadStatus::timeout);
    becomes(Connection::streaming, {"no mirror"});
    watch_->after_read(ReadStatus::frame);
  }
  ASSERT_EQ(told_.size(), 4U);
  EXPECT_THAT(told_[0].notes, IsEmpty()) << "a device that is away does nothing";
  EXPECT_THAT(told_[1].notes, ElementsAre("no mirror"));
  EXPECT_THAT(told_[3].notes, IsEmpty()) << "it was told";
}

TEST_F(StateWatchTest, ADeviceThatComesWithinTheFirstReadIsSeen) {
  becomes(Connection::waiting, {});
  watch();
  becomes(Connection::streaming, {"no mirror"});
  watch_->after_read(ReadStatus::frame);
  ASSERT_EQ(told_.size(), 1U);
  EXPECT_THAT(told_[0].notes, ElementsAre("no mirror"));
}

}  // namespace
}  // namespace saccade
