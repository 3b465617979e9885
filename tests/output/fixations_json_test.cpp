#include "output/fixations_json.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace saccade {
namespace {

TEST(FixationsJson, HasExactlyTheDocumentedFields) {
  Result result;
  result.frame.index = 7;
  result.frame.timestamp_us = 233333;
  result.frame.name = "a \"quoted\" name";
  result.attention.fixations.push_back({3, 4, 0.1F, {1.5F, -2, 1000.25F}, {}});
  result.attention.fixations.push_back({5, 6, 0.05F, {}, {12, {1, 2, 3}, {4, 5, 6}}, 0.75F});
  result.attention.ended_early = "no more";
  EXPECT_EQ(
      fixations_json(result),
      R"({"frame":7,"name":"a \"quoted\" name","timestamp_us":233333,"fixations":[)"
      R"({"rank":1,"row":3,"col":4,"saliency":0.1,"x_mm":1.5,"y_mm":-2,"z_mm":1000.25},)"
      R"({"rank":2,"row":5,"col":6,"saliency":0.05,"x_mm":0,"y_mm":0,"z_mm":0,"confidence":0.75,"pixels":12,)"
      R"("centroid_mm":[1,2,3],"extent_mm":[4,5,6]}],"ended_early":"no more"})");
  EXPECT_NO_THROW(nlohmann::json::parse(fixations_json(result)));
}

}  // namespace
}  // namespace saccade
