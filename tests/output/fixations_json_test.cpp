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

TEST(FixationsJson, ANameThatIsNotUtf8IsReplacedAndNoError) {
  Result result;
  result.frame.name = "caf\xe9";  // Latin-1
  EXPECT_EQ(nlohmann::json::parse(fixations_json(result))["name"], "caf\xef\xbf\xbd");
}

TEST(FixationsJson, OverTimeHasIdsGazeAndPose) {
  Result result;
  Fixation fixation{3, 4, 0.5F, {1, 2, 3}, {}};
  fixation.id = 9;
  fixation.age_frames = 12;
  fixation.world_mm = {4, 5, 6};
  result.attention.fixations.push_back(fixation);
  const cv::Affine3d pose(cv::Matx33d::eye(), cv::Vec3d(0.25, -2, 1000));
  result.attention.sequence = SequenceState{9, true, pose};
  EXPECT_EQ(fixations_json(result),
            R"({"frame":0,"name":"","timestamp_us":0,"gaze":9,"cut":true,)"
            R"("camera_to_world":[1,0,0,0.25,0,1,0,-2,0,0,1,1000,0,0,0,1],)"
            R"("fixations":[{"rank":1,"row":3,"col":4,"saliency":0.5,"x_mm":1,"y_mm":2,"z_mm":3,)"
            R"("id":9,"age_frames":12,"world_mm":[4,5,6]}]})");
  result.attention.sequence->gaze.reset();
  EXPECT_TRUE(nlohmann::json::parse(fixations_json(result))["gaze"].is_null());
}

}  // namespace
}  // namespace saccade
