// Thousands of damaged recordings. In every build, this program has copies of the recording code of its own
// that are compiled with AddressSanitizer and UndefinedBehaviorSanitizer.
#include "exercise.hpp"
#include "mutator.hpp"
#include "oni/repair.hpp"

// No number in a file may cause a large allocation.
extern "C" const char* __asan_default_options() {
  return "max_allocation_size_mb=200:allocator_may_return_null=0:detect_leaks=1";
}

namespace saccade {
namespace {

constexpr int kMutantsPerSeed = 450;

class OniMutants : public OniFiles {};

TEST_F(OniMutants, SeedsPlay) {
  for (const auto& seed : seed_recordings(folder_)) EXPECT_EQ(exercise(seed), 4);
}

TEST_F(OniMutants, AreReadOrRefused) {
  const auto seeds = seed_recordings(folder_);
  int played = 0;
  for (std::size_t s = 0; s < seeds.size(); ++s)
    for (int k = 0; k < kMutantsPerSeed; ++k) {
      const unsigned number = static_cast<unsigned>(1000 * s) + static_cast<unsigned>(k);
      const auto mutant = OniMutator(number).mutate(seeds[s]);
      try {
        played += exercise(mutant) > 0 ? 1 : 0;
      } catch (const std::exception& fault) {
        FAIL() << "mutant " << number << ": " << fault.what();
      }
    }
  EXPECT_GT(played, static_cast<int>(seeds.size()) * kMutantsPerSeed / 4)
      << "most damage leaves frames to play";
}

TEST_F(OniMutants, OldVersionsWithShortRecordsToo) {
  // The same bytes under an older version number: no record fits its layout.
  for (auto seed : seed_recordings(folder_))
    for (unsigned k = 0; k < 40; ++k) {
      auto mutant = OniMutator(k).mutate(seed);
      if (mutant.size() < kOniHeaderSize) continue;
      mutant[6] = 0;
      mutant[8] = static_cast<std::uint8_t>(4 + k % 3);
      EXPECT_NO_THROW(exercise(mutant)) << k;
    }
}

TEST_F(OniMutants, RepairIsSoundOrRefuses) {
  const auto seeds = seed_recordings(folder_);
  for (std::size_t s = 0; s < seeds.size(); ++s)
    for (unsigned k = 0; k < 30; ++k) {
      write_bytes(path("mutant.oni"), OniMutator(5000 + k).mutate(seeds[s]));
      try {
        repair_recording(path("mutant.oni"), path("repaired.oni"), true);
        Recording repaired(path("repaired.oni"));
        const OniProblems problems = check_recording(repaired);
        for (const OniProblem& problem : problems.list())
          EXPECT_NE(problem.severity, OniSeverity::error)
              << "seed " << s << ", mutant " << k << ": " << problem.meaning;
      } catch (const Error& error) {
        EXPECT_EQ(error.status(), ExitStatus::unreadable) << error.what();
      }
    }
}

}  // namespace
}  // namespace saccade
