#include "core/worker_pool.hpp"

#include <atomic>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace saccade {
namespace {

class WorkerPoolOf : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Workers, WorkerPoolOf, ::testing::Values(1, 2, 3, 8));

TEST_P(WorkerPoolOf, RunsEveryChunkOnceInEveryRound) {
  WorkerPool pool(GetParam());
  for (int round = 0; round < 200; ++round) {
    std::vector<int> hits(97, 0);  // each chunk writes its own element: no atomics needed
    pool.for_each(97, [&](int chunk, int worker) {
      ASSERT_LT(worker, pool.workers());
      ++hits[static_cast<std::size_t>(chunk)];
    });
    EXPECT_EQ(hits, std::vector<int>(97, 1));
  }
}

TEST_P(WorkerPoolOf, NoChunksIsNoWork) {
  WorkerPool pool(GetParam());
  pool.for_each(0, [](int, int) { FAIL(); });
}

TEST_P(WorkerPoolOf, RethrowsAndCanBeUsedAgain) {
  WorkerPool pool(GetParam());
  EXPECT_THROW(pool.for_each(50,
                             [](int chunk, int) {
                               if (chunk == 20) throw std::runtime_error("chunk");
                             }),
               std::runtime_error);
  std::atomic<int> count = 0;
  pool.for_each(50, [&](int, int) { ++count; });
  EXPECT_EQ(count, 50);
}

TEST_P(WorkerPoolOf, StopsWhenInterruptedAndCanBeUsedAgain) {
  WorkerPool pool(GetParam());
  std::atomic<int> count = 0, late = 0;
  std::atomic<bool> interrupted = false;
  // So many that they do not end while the thread that interrupts them waits for a processor.
  EXPECT_THROW(pool.for_each(100'000'000,
                             [&](int, int) {
                               if (interrupted) ++late;
                               if (++count == 20) {
                                 pool.interrupt();
                                 interrupted = true;
                               }
                             }),
               WorkerPool::Interrupted);
  EXPECT_GE(count, 20);
  EXPECT_LT(late, GetParam()) << "chunks that were being begun are finished, and no others are begun";
  EXPECT_THROW(pool.for_each(1, [&](int, int) { FAIL(); }), WorkerPool::Interrupted);
  pool.resume();
  count = 0;
  pool.for_each(50, [&](int, int) { ++count; });
  EXPECT_EQ(count, 50);
}

TEST(WorkerPool, RefusesNoWorkers) { EXPECT_THROW(WorkerPool(0), std::invalid_argument); }

}  // namespace
}  // namespace saccade
