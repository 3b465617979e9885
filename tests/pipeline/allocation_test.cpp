// Once running, a frame costs no memory: every operator new of this program is counted here.
#include <cstdlib>
#include <new>

#include "pipeline_parts.hpp"

namespace {
std::atomic<bool> counting = false;
std::atomic<int> allocations = 0;
}  // namespace

// Not inlined, or GCC takes free() for a mistake.
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (counting) ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace saccade {
namespace {

TEST(PipelineMemory, NothingIsAllocatedPerFrame) {
  for (const FramePolicy policy : {FramePolicy::every_frame, FramePolicy::newest}) {
    PipelineOptions options;
    options.policy = policy;
    options.on_state = [](const SourceState&) {};
    Pipeline pipeline(std::make_unique<CountingSource>(1'000'000'000), std::make_unique<CopyProcessor>(),
                      options);
    std::set<const void*> images;
    for (int i = 0; i < 100; ++i) images.insert(pipeline.next()->frame.depth_mm.data);
    counting = true;
    for (int i = 0; i < 1000; ++i) {
      const ResultHandle result = pipeline.next();
      if (!images.contains(result->frame.depth_mm.data)) ++allocations;
    }
    counting = false;
    EXPECT_EQ(allocations.exchange(0), 0);
  }
}

}  // namespace
}  // namespace saccade
