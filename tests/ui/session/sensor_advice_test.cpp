#include "ui/session/sensor_advice.hpp"

#include <chrono>
#include <stdexcept>
#include <thread>

#include <gmock/gmock.h>

namespace saccade {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// The answer, once it is there.
std::vector<std::string> answer_of(SensorAdvice& advice) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (advice.poll().empty() && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return advice.poll();
}

TEST(SensorAdvice, SaysWhatIsWrongWhileItIsAsked) {
  SensorAdvice advice([] { return std::vector<std::string>{"no power: plug it in"}; }, [] {});
  EXPECT_FALSE(advice.active());
  EXPECT_THAT(advice.poll(), IsEmpty());
  advice.ask();
  EXPECT_TRUE(advice.active());
  EXPECT_THAT(answer_of(advice), ElementsAre("no power: plug it in"));
  advice.clear();
  EXPECT_THAT(advice.poll(), IsEmpty());
}

TEST(SensorAdvice, AQuestionThatFailsIsAnsweredByItsError) {
  SensorAdvice advice([]() -> std::vector<std::string> { throw std::runtime_error("no drivers"); }, [] {});
  advice.ask();
  EXPECT_THAT(answer_of(advice), ElementsAre("no drivers"));
}

}  // namespace
}  // namespace saccade
