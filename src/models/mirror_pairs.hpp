#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "models/model.hpp"

namespace saccade {

/// Two pixels mirrored about a centre: centre + (dx, dy) and centre - (dx, dy), px of a level.
struct MirrorPair {
  int dx, dy;
  float cos2a, sin2a;  ///< of 2 alpha, where alpha is the angle of the line between the two
  float weight;        ///< exp(-d^2/(2 sigma^2))/(sigma sqrt(2 pi)), d = their distance in px, sigma = 16
};

/// Each pair once, within the outer kernel (half-width 5) and outside the inner one (half-width 2).
std::vector<MirrorPair> mirror_pairs();

/// Numbers made from the gradients of one pyramid level: some planes of the level's size with a margin of 0,
/// so that pairs with a pixel outside the image contribute nothing.
class MomentPlanes {
 public:
  static constexpr int kMargin = 5;  ///< the half-width of the outer kernel

  MomentPlanes(cv::Size size, int planes);
  float* row(int plane, int r) { return planes_[static_cast<std::size_t>(plane)][r + kMargin] + kMargin; }
  const float* row(int plane, int r) const {
    return planes_[static_cast<std::size_t>(plane)][r + kMargin] + kMargin;
  }

 private:
  std::vector<cv::Mat1f> planes_;
};

/// How a model computes moments from gradients, and a pair's contribution from moments.
class PairMeasure {
 public:
  virtual ~PairMeasure() = default;
  virtual int channels() const = 0;  ///< of the image: 1 = grey, 3 = B, G, R
  virtual int planes() const = 0;

  /// Row r of the moments. gx, gy: Sobel gradient (sum of weights 8, image in 0..1), channels interleaved.
  virtual void set_moments(const float* gx, const float* gy, int width, MomentPlanes& moments,
                           int r) const = 0;

  /// Adds the contributions of the pairs about each pixel of row r to score[0..width).
  virtual void add_pairs(const MomentPlanes& moments, int r, const std::vector<MirrorPair>& pairs,
                         float* score, int width) const = 0;
};

/// Symmetry of gradients at pixel pairs on pyramid levels 1..5 of the colour image, interpolated to full size
/// and added: the common part of symmetry2d and colour_symmetry2d. Levels are smoothed by the binomial [1 4 6
/// 4 1]/16 with reflected borders and rounded to 1/256 of a grey level, so that a flat image has no gradient
/// at all. A level has at least one pixel a side, so images may have any size.
class MirrorPairModel : public SaliencyModel {
 public:
  MirrorPairModel(const char* name, std::unique_ptr<PairMeasure> measure, WorkerPool& pool,
                  int last_level = 5);
  void compute(const Frame& frame, RequestedOutputs outputs, SaliencyMaps& maps, StageTimes& times) override;

  /// The sum of the levels kFirstLevel..last_level of `colour` at kFirstLevel, before it is brought to full
  /// size; until the next call.
  const cv::Mat1f& find_symmetry(const cv::Mat3b& colour);
  static constexpr int kFirstLevel = 1;

 private:
  struct Level {
    Level(cv::Size size, const PairMeasure& measure);
    cv::Mat image;   // 16 bits, 256 = one grey level
    cv::Mat gx, gy;  // float
    MomentPlanes moments;
    cv::Mat1f score;
  };

  void resize(cv::Size size);
  void load(const cv::Mat3b& colour);
  template <typename Job>
  void for_bands(Job job);

  const char* name_;
  std::unique_ptr<PairMeasure> measure_;
  WorkerPool& pool_;
  int last_level_;
  std::vector<MirrorPair> pairs_ = mirror_pairs();
  cv::Size size_;
  cv::Mat full_8bit_, full_;
  std::vector<Level> levels_;  // from kFirstLevel
};

}  // namespace saccade
