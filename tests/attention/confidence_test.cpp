#include "attention/confidence.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace saccade {
namespace {

double formula(double front_share, double saliency, bool plane, bool without) {
  const double log_odds = 0.1 + 3.4 * std::sqrt(front_share) + 0.37 * std::log(std::max(0.01, saliency)) -
                          (plane ? 2.4 : 0) + (without ? 0.3 : 0);
  return 1 / (1 + std::exp(-log_odds));
}

TEST(Confidence, IsTheDocumentedFormula) {
  for (const float front : {0.0F, 0.1F, 0.5F, 1.0F})
    for (const float saliency : {1e-6F, 0.01F, 0.3F, 1.0F})
      for (const bool plane : {false, true})
        for (const bool without : {false, true})
          EXPECT_NEAR(confidence({front, saliency, plane, without}),
                      formula(static_cast<double>(front), static_cast<double>(saliency), plane, without),
                      1e-5);
}

TEST(Confidence, AThingInFrontIsProbablyAnObjectAndATableIsNot) {
  EXPECT_GT(confidence({.front_share = 0.6F, .relative_saliency = 0.5F}), 0.9F);
  EXPECT_LT(confidence({.front_share = 0, .relative_saliency = 0.05F, .on_supporting_plane = true}), 0.1F);
  EXPECT_LT(confidence({.front_share = 0, .relative_saliency = 0.5F}), kProbablyObject);
  EXPECT_EQ(confidence({.front_share = 0.6F, .relative_saliency = 5}),
            confidence({.front_share = 0.6F, .relative_saliency = 1}));
}

}  // namespace
}  // namespace saccade
