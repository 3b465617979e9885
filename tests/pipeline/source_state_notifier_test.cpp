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

class SourceStateNotifierTest : public ::testing::Test {
 protected:
  void watch() {
    notifier_.emplace(source_, [this](const SourceState& state) { reported_.push_back(state); });
    source_.looks = 0;
  }
  void becomes(Connection connection, std::vector<std::string> notes) {
    source_.now.connection = connection;
    source_.now.notes = std::move(notes);
  }

  MutableSource source_;
  std::vector<SourceState> reported_;
  std::optional<SourceStateNotifier> notifier_;
};

TEST_F(SourceStateNotifierTest, FramesInTimeCostNothing) {
  watch();
  for (int i = 0; i < 5; ++i) notifier_->after_read(ReadStatus::frame);
  EXPECT_EQ(source_.looks, 0);
  EXPECT_THAT(reported_, IsEmpty());
}

TEST_F(SourceStateNotifierTest, ALossAndAReconnectionAreReportedOnceEach) {
  becomes(Connection::streaming, {"opened so"});
  watch();
  becomes(Connection::lost, {"opened so"});
  for (int i = 0; i < 3; ++i) notifier_->after_read(ReadStatus::timeout);
  becomes(Connection::streaming, {"opened so"});
  for (int i = 0; i < 3; ++i) notifier_->after_read(ReadStatus::frame);
  ASSERT_EQ(reported_.size(), 2U);
  EXPECT_EQ(reported_[0].connection, Connection::lost);
  EXPECT_EQ(reported_[1].connection, Connection::streaming);
  EXPECT_THAT(reported_[1].notes, IsEmpty()) << "they are those of the opening";
}

TEST_F(SourceStateNotifierTest, SettingsThatAReconnectedDeviceIgnoresAreReported) {
  watch();
  for (int round = 0; round < 2; ++round) {
    becomes(Connection::lost, {"opened so"});
    notifier_->after_read(ReadStatus::timeout);
    becomes(Connection::streaming, {"no mirror"});
    notifier_->after_read(ReadStatus::frame);
  }
  ASSERT_EQ(reported_.size(), 4U);
  EXPECT_THAT(reported_[0].notes, IsEmpty()) << "a lost device has no notes";
  EXPECT_THAT(reported_[1].notes, ElementsAre("no mirror"));
  EXPECT_THAT(reported_[3].notes, IsEmpty()) << "they were reported before";
}

TEST_F(SourceStateNotifierTest, ADeviceThatComesDuringTheFirstReadIsReported) {
  becomes(Connection::waiting, {});
  watch();
  becomes(Connection::streaming, {"no mirror"});
  notifier_->after_read(ReadStatus::frame);
  ASSERT_EQ(reported_.size(), 1U);
  EXPECT_THAT(reported_[0].notes, ElementsAre("no mirror"));
}

}  // namespace
}  // namespace saccade
