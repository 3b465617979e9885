#pragma once

#include <array>
#include <vector>

#include "models/gabor.hpp"
#include "models/model.hpp"

namespace saccade {

/// `itti` and `itti_orientation`: Itti, Koch, Niebur, "A model of saliency-based visual attention for rapid
/// scene analysis", PAMI 1998: intensity, red/green and blue/yellow opponency and 4 orientations, each
/// compared between a fine level c = 2, 3, 4 of a pyramid and a coarse one c + 3, c + 4; each map of
/// differences normalised by N(.) and added at level 4. itti_orientation is the orientation channel alone.
///
/// README.md in this folder has the points in which it departs from the article. Needs colour.
class IttiModel : public SaliencyModel {
 public:
  /// `halvings`, 0 or 1: how often the image that find_conspicuity() is given was halved before. Its levels
  /// are compared as those of the whole image would be.
  IttiModel(const char* name, bool orientation_only, WorkerPool& pool, int halvings = 0);
  void compute(const Frame& frame, RequestedOutputs outputs, SaliencyMaps& maps, StageTimes& times) override;

  /// The map before it is brought to the size of `colour`: of its level map_level(), until the next call.
  const cv::Mat1f& find_conspicuity(const cv::Mat3b& colour);
  int map_level() const { return kMapLevel - finer_; }  ///< 2..4

 private:
  static constexpr int kOrientations = GaborFilters::kOrientations, kCentres = 3, kSurrounds = 2, kLevels = 9;
  static constexpr int kFirstCentre = 2, kDelta = 3, kMapLevel = 4;
  using Pyramid = std::array<cv::Mat1f, kLevels>;
  enum Channel { kIntensity, kRedGreen, kBlueYellow, kOrientation, kChannels = kOrientation + kOrientations };

  struct ChannelState {
    Pyramid levels;
    cv::Mat1f sum;                                    ///< of the normalised differences, at the map's level
    std::array<cv::Mat1f, kMapLevel + 1> difference;  ///< |c - s|, at its level and at those up to the map's
    std::array<cv::Mat1f, 2> scratch;                 ///< of the Gabor filters
  };

  void resize(cv::Size size);
  void split_colours(const cv::Mat3b& colour);
  void build_pyramid(Pyramid& levels) const;
  void find_part(GaborFilters::Part part);
  void find_orientation(int orientation, ChannelState& state) const;
  void compare_levels(ChannelState& state) const;
  void add_channels();

  const char* name_;
  bool orientation_only_;
  int halvings_;
  WorkerPool& pool_;
  cv::Size size_;
  int finer_ = 0;  ///< subtracted from all level numbers: halvings_ or, for small images, more
  std::array<cv::Mat1b, 3> bgr_;
  std::vector<float> row_maximum_;  ///< of the intensity
  std::array<ChannelState, kChannels> channels_;
  GaborFilters gabor_;
  std::array<GaborFilters::Parts, kLevels> gabor_parts_;
  cv::Mat1f conspicuity_;
};

}  // namespace saccade
