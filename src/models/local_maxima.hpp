#pragma once

#include <opencv2/core.hpp>

namespace saccade {

/// Maps that span less are flat to promote_few_peaks(): a quarter of a grey level of an image in 0..1.
constexpr float kSameValue = 0.001F;

/// Lowers a map towards its border, where filters respond to the end of the image: in the outermost b =
/// (larger side)/20 rows and columns, rounded, the i-th from the border (0..) has the factor (i + 1)/(b + 1).
void attenuate_border(cv::Mat1f& map);

/// Itti's N(.), in place: scales a map so that its values span 0..1, then multiplies it by (1 - m)^2, with m
/// the mean of all local maxima but the highest. A map with one peak stays; a map with many equal peaks
/// vanishes. Maxima below a tenth of the highest do not count: they are noise, and there may be any number of
/// them. A map that spans less than kSameValue becomes 0.
void promote_few_peaks(cv::Mat1f& map);

}  // namespace saccade
