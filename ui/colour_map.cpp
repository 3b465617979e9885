#include "ui/colour_map.hpp"

#include <algorithm>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace saccade {

cv::Mat1b to_gray(const cv::Mat1f& map) {
  double largest = 0;
  cv::minMaxLoc(map, nullptr, &largest);
  if (largest <= 0) return cv::Mat1b(map.size(), std::uint8_t{0});
  cv::Mat1f root;
  cv::sqrt(map / largest, root);
  cv::Mat1b gray;
  root.convertTo(gray, CV_8U, 255);
  return gray;
}

cv::Mat3b depth_picture(const cv::Mat1f& depth_mm) {
  constexpr int kSampleStep = 7;  // enough pixels for two percentiles
  std::vector<float> sample;
  for (int r = 0; r < depth_mm.rows; ++r)
    for (int c = r % kSampleStep; c < depth_mm.cols; c += kSampleStep)
      if (depth_mm(r, c) > 0) sample.push_back(depth_mm(r, c));
  cv::Mat3b picture(depth_mm.size(), cv::Vec3b());
  if (sample.empty()) return picture;
  std::sort(sample.begin(), sample.end());
  const float near_mm = sample[sample.size() / 100], far_mm = sample[sample.size() - 1 - sample.size() / 100];
  const float span_mm = std::max(far_mm - near_mm, 1.0F);

  cv::Mat1b shade;
  depth_mm.convertTo(shade, CV_8U, -190 / span_mm, 45 + 190 * far_mm / span_mm);
  shade.setTo(0, depth_mm == 0);
  cv::cvtColor(shade, picture, cv::COLOR_GRAY2BGR);
  return picture;
}

}  // namespace saccade
