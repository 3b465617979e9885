#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

#include "core/frame.hpp"
#include "output/overlay.hpp"

namespace saccade {

/// A point in the layout of the graphics card: 20 bytes without gaps.
struct CloudVertex {
  std::array<float, 3> position_mm;    ///< camera frame
  std::array<std::uint8_t, 4> colour;  ///< red, green, blue, opaque
  std::array<std::int8_t, 4> normal;   ///< unit vector * 127; (0,0,0) = none; the last is unused
};

/// Source of the points' colours.
enum class CloudColour { image, depth, saliency };

/// The user's choices for the cloud.
struct CloudStyle {
  CloudColour colour = CloudColour::saliency;
  bool lit = true;          ///< shaded, which needs normals
  bool needles = false;     ///< short lines along the normals
  bool fixations = true;    ///< numbered markers with their positions
  float point_size = 1.3F;  ///< 1 = a point covers what its pixel covers
  bool operator==(const CloudStyle&) const = default;
};
constexpr float kSmallestPoint = 0.5F, kLargestPoint = 4;

/// The colour of each pixel's point, BGR: the frame's image (its depth where it has none), its depth, or the
/// map (smooth_for_looking(); an empty one counts as 0) over the image, all as in the overlay.
[[nodiscard]] cv::Mat3b cloud_colours(CloudColour by, const Frame& frame, const cv::Mat1f& smooth,
                                      const OverlayStyle& style);

/// Normals by central differences of the points left, right, above and below, towards the camera; (0,0,0)
/// where one of them has no reading or is more than 2 % of the depth nearer or farther. Quick and rough: for
/// display, where the operator's normals were not requested.
[[nodiscard]] cv::Mat3f rough_normals(const cv::Mat1f& depth_mm, const Intrinsics& camera);

/// The points of all pixels with a reading, row by row. colours: H x W. normals: H x W, (0,0,0) = none, or
/// empty. Overwrites `vertices`, reusing its memory. Throws std::invalid_argument if sizes differ.
void build_cloud(const Frame& frame, const cv::Mat3b& colours, const cv::Mat3f& normals,
                 std::vector<CloudVertex>& vertices);

/// Lines of `length_mm` along the normals of every `every`-th row and column: two vertices each. Overwrites
/// `vertices`. Throws as build_cloud().
void build_normal_lines(const Frame& frame, const cv::Mat3f& normals, int every, float length_mm,
                        std::vector<CloudVertex>& vertices);

}  // namespace saccade
