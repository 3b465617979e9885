#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/frame_source.hpp"
#include "eval/evaluator.hpp"
#include "eval/plan.hpp"

namespace saccade {

/// An image that a model did well or badly on.
struct Example {
  std::size_t condition = 0;  ///< of EvalPlan::conditions()
  std::int64_t frame = 0;
  std::string name{};
  int objects = 0;
  ConditionResult result{};  ///< of this condition
  double share = 0;          ///< share_of_bound() of the image
  bool best = false;
  std::string file{};  ///< of its picture, within the output folder
};

/// Chooses examples among images that come one by one.
class ExampleChooser {
 public:
  explicit ExampleChooser(const EvalPlan& plan);

  /// In the order of the images.
  void add(const ImageResult& image);

  /// For each model, under the kernel and selector that suit it best, the four best and four worst images
  /// with objects (fewer if there are fewer images), best first; ties by the order of the images.
  [[nodiscard]] std::vector<Example> choose() const;

 private:
  struct Ranking {
    std::size_t images = 0;
    double shares = 0;                 // sum
    std::vector<Example> best, worst;  // the first and the last ones of all images, in the order of ranks
  };

  EvalPlan plan_;
  std::vector<Condition> conditions_;
  std::vector<Ranking> rankings_;  // of each condition
};

/// The frame's colour image with the map, the first ten points with their numbers, and the outlines of the
/// labelled objects: white where one of these points hit, red where none did. At most 480 pixels wide. BGR.
cv::Mat3b draw_example(const Frame& frame, const SaliencyMaps& maps, const std::vector<EvalPoint>& points);

/// Computes the examples' maps again and writes their pictures as JPEG below `folder`. Ends before the next
/// picture once `stop` returns true. Throws Error.
void write_examples(const std::vector<Example>& examples, const EvalPlan& plan, FrameSource& source,
                    WorkerPool& pool, const std::filesystem::path& folder, const std::function<bool()>& stop);

}  // namespace saccade
