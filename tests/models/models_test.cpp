// Properties of every model.

#include <gmock/gmock.h>

#include "core/error.hpp"
#include "displays.hpp"

namespace saccade {
namespace {

using ::testing::HasSubstr;

const std::vector<std::string> kNeedColour = {"symmetry2d", "colour_symmetry2d", "radial2d",
                                              "itti",       "itti_orientation",  "combined"};
std::vector<std::string> all_models() {
  std::vector<std::string> names;
  for (const ModelInfo& model : models()) names.emplace_back(model.name);
  return names;
}

const std::vector<std::string> kAll = all_models();

Frame frame_with_depth(cv::Size size) {
  Frame frame = frame_of(noise_image(size));
  cv::Mat1b depth(size);
  cv::RNG(7).fill(depth, cv::RNG::UNIFORM, 0, 256);
  for (int r = 0; r < size.height; ++r)
    for (int c = 0; c < size.width; ++c)
      frame.depth_mm(r, c) = depth(r, c) < 20 ? 0 : 1000 + 0.1F * static_cast<float>(depth(r, c) + 3 * c);
  return frame;
}

void expect_usable(const cv::Mat1f& map, cv::Size size, const std::string& model) {
  ASSERT_EQ(map.size(), size) << model;
  EXPECT_TRUE(cv::checkRange(map)) << model << size;
  EXPECT_GE(*std::min_element(map.begin(), map.end()), 0) << model << size;
}

TEST(Models, TheSettingKnowsThemAll) {
  const SettingOf<ModelSettings> setting = model_setting_specs().front();
  ASSERT_EQ(setting.key, "model");
  EXPECT_EQ(setting.words, kAll);
  for (const ModelInfo& model : models()) {
    ModelSettings settings;
    EXPECT_NO_THROW(setting.parse(settings, std::string(model.name)));
    WorkerPool pool(1);
    EXPECT_NE(make_model(settings, pool), nullptr);
    EXPECT_NE(model.help, "");
    EXPECT_THAT(setting.help, HasSubstr(std::string(model.help)));
  }
  EXPECT_THROW(needs_depth("nonsense"), std::invalid_argument);
}

TEST(Models, GiveFiniteMapsOfAnySizeOnColourOnly) {
  for (const std::string& model : kAll)
    for (const cv::Size size : {cv::Size(1, 1), cv::Size(2, 9), cv::Size(5, 3), cv::Size(17, 33),
                                cv::Size(64, 40), cv::Size(161, 121)}) {
      if (needs_depth(model) && std::min(size.width, size.height) < 8) continue;
      expect_usable(map_of(model, frame_of(noise_image(size)), 1, 0), size, model);
    }
}

TEST(Models, SameBitsForAnyNumberOfWorkersAndAgain) {
  const Frame frame = frame_with_depth({173, 131});
  for (const std::string& model : kAll) {
    const cv::Mat1f one = map_of(model, frame);
    expect_usable(one, frame.size(), model);
    EXPECT_GT(cv::norm(one, cv::NORM_INF), 0) << model;
    for (const int workers : {2, 5}) EXPECT_EQ(cv::norm(one, map_of(model, frame, workers)), 0) << model;

    // An object that has seen other frames, of this size and of another.
    WorkerPool pool(2);
    const auto used = make_model(settings_for(model), pool);
    SaliencyMaps maps;
    StageTimes times;
    used->compute(frame_with_depth({160, 128}), {}, maps, times);
    Frame other = frame_with_depth({173, 131});
    other.colour = noise_image({173, 131}, 9);
    other.index = 5;
    used->compute(other, {}, maps, times);
    used->compute(frame, {}, maps, times);
    EXPECT_EQ(cv::norm(one, maps.master), 0) << model;
  }
}

TEST(Models, FlatImagesAreZero) {
  for (const std::string& model : kNeedColour)
    for (const cv::Vec3b& colour : {cv::Vec3b(0, 0, 0), cv::Vec3b(255, 255, 255), cv::Vec3b(17, 133, 201)}) {
      const cv::Mat1f map = map_of(model, frame_of(cv::Mat3b(150, 170, colour)));
      EXPECT_EQ(cv::norm(map, cv::NORM_INF), 0) << model;
    }
}

TEST(Models, WithoutColourSayWhatToDo) {
  Frame frame = frame_with_depth({160, 128});
  frame.colour.release();
  for (const std::string& model : kNeedColour) try {
      map_of(model, frame);
      ADD_FAILURE() << model;
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::unreadable);
      EXPECT_THAT(error.what(), HasSubstr(model + " needs colour"));
      EXPECT_THAT(error.what(), HasSubstr("--model symmetry3d"));
    }
  for (const char* model : {"symmetry3d", "random", "centre"}) EXPECT_NO_THROW(map_of(model, frame));
}

TEST(Models, GiveByProductsOnlyIfTheyHaveThem) {
  const Frame frame = frame_with_depth({160, 128});
  WorkerPool pool(1);
  for (const std::string& model : kAll) {
    SaliencyMaps maps;
    StageTimes times;
    maps.levels.resize(3);
    maps.normals.create(4, 4);
    const bool has = needs_depth(model);
    make_model(settings_for(model), pool)->compute(frame, {.levels = true, .normals = true}, maps, times);
    EXPECT_EQ(maps.levels.size(), has ? 5U : 0U) << model;
    EXPECT_EQ(maps.normals.empty(), !has) << model;
    EXPECT_GT(times[Stage::symmetry], 0) << model;
  }
}

TEST(Models, SettingsAreCheckedByModel) {
  const cv::Size small(64, 48);
  EXPECT_THROW(check_model(settings_for("symmetry3d"), small), Error);
  EXPECT_THROW(check_model(settings_for("combined"), small), Error);
  EXPECT_NO_THROW(check_model(settings_for("itti"), small));
}

TEST(Levels, OnlyTheDefaultOnesAreCutToTheImage) {
  ModelSettings settings;
  EXPECT_EQ(last_level_for(settings, {640, 480}), settings.last_level);
  EXPECT_EQ(last_level_for(settings, {64, 48}), 2);
  EXPECT_EQ(last_level_for(settings, {4, 4}), settings.last_level) << "there is nothing to cut them to";
  settings.levels_chosen = true;
  EXPECT_EQ(last_level_for(settings, {64, 48}), settings.last_level);
}

TEST(Random, DependsOnTheFrameAloneAndIsUniform) {
  Frame frame = frame_of(noise_image({100, 100}));
  const cv::Mat1f first = map_of("random", frame);
  EXPECT_NEAR(cv::mean(first)[0], 0.5, 0.02);
  EXPECT_LT(*std::max_element(first.begin(), first.end()), 1);
  frame.colour = noise_image({100, 100}, 2);
  EXPECT_EQ(cv::norm(first, map_of("random", frame)), 0);
  frame.index = 1;
  const cv::Mat1f second = map_of("random", frame);
  EXPECT_GT(cv::norm(first, second), 1);
  EXPECT_NEAR(cv::mean(first.mul(second))[0], 0.25, 0.02);
}

TEST(Centre, FallsFromTheMiddle) {
  const cv::Mat1f map = map_of("centre", frame_of(noise_image({81, 41})));
  EXPECT_EQ(maximum_of(map), cv::Point(40, 20));
  EXPECT_EQ(map(20, 40), 1);
  EXPECT_NEAR(map(20, 80), std::exp(-0.5 * (40 / 20.25) * (40 / 20.25)), 1e-6);
  EXPECT_EQ(map(0, 0), map(40, 80));
}

}  // namespace
}  // namespace saccade
