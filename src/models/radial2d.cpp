#include "models/radial2d.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "models/image.hpp"

namespace saccade {

void Radial2dModel::find_gradient(const cv::Mat3b& colour) {
  cv::cvtColor(colour, grey_, cv::COLOR_BGR2GRAY);
  gx_.create(grey_.size());
  gy_.create(grey_.size());
  length_.create(grey_.size());
  for_row_bands(pool_, grey_.rows, [&](int begin, int end) {
    const cv::Mat grey = grey_.rowRange(begin, end);
    cv::Mat gx = gx_.rowRange(begin, end), gy = gy_.rowRange(begin, end);
    cv::Sobel(grey, gx, CV_16S, 1, 0);
    cv::Sobel(grey, gy, CV_16S, 0, 1);
    for (int r = begin; r < end; ++r)
      for (int c = 0; c < grey_.cols; ++c)
        length_(r, c) = std::sqrt(static_cast<float>(gx_(r, c) * gx_(r, c) + gy_(r, c) * gy_(r, c))) / 255;
  });
}

// One worker does all of one radius: votes of different rows fall on the same pixels, and the order of a sum
// of floats changes its bits.
void Radial2dModel::vote(int radius, Votes& votes) const {
  const cv::Size size = grey_.size();
  votes.orientation.create(size);
  votes.orientation.setTo(0);
  votes.magnitude.create(size);
  votes.magnitude.setTo(0);
  const auto add = [&](int r, int c, int sign, float length) {
    if (r < 0 || c < 0 || r >= size.height || c >= size.width) return;
    votes.orientation(r, c) += sign;
    votes.magnitude(r, c) += static_cast<float>(sign) * length;
  };
  for (int r = 0; r < size.height; ++r)
    for (int c = 0; c < size.width; ++c) {
      const float length = length_(r, c);
      if (length == 0) continue;
      const float scale = static_cast<float>(radius) / (255 * length);
      const int dx = static_cast<int>(std::lrint(static_cast<float>(gx_(r, c)) * scale));
      const int dy = static_cast<int>(std::lrint(static_cast<float>(gy_(r, c)) * scale));
      add(r + dy, c + dx, 1, length);
      add(r - dy, c - dx, -1, length);
    }
  const float k = radius == 1 ? 8.0F : 9.9F;
  for (int r = 0; r < size.height; ++r)
    for (int c = 0; c < size.width; ++c) {
      const float share = std::min(static_cast<float>(std::abs(votes.orientation(r, c))), k) / k;
      votes.magnitude(r, c) *= share * share / k;
    }
  constexpr double kSigmaOfRadius = 0.25;
  const double sigma = kSigmaOfRadius * radius;
  const int reach = static_cast<int>(std::ceil(3 * sigma));
  cv::GaussianBlur(votes.magnitude, votes.magnitude, {2 * reach + 1, 2 * reach + 1}, sigma, sigma,
                   cv::BORDER_CONSTANT);
}

void Radial2dModel::compute(const Frame& frame, RequestedOutputs, SaliencyMaps& maps, StageTimes& times) {
  const StageTimer timer(times, Stage::symmetry);
  find_gradient(colour_of(frame, "radial2d"));
  const auto job = [&](int i, int) {  // the widest blur first
    const std::size_t n = votes_.size() - 1 - static_cast<std::size_t>(i);
    vote(kRadii[n], votes_[n]);
  };
  pool_.for_each(static_cast<int>(votes_.size()), std::ref(job));
  maps.levels.clear();
  maps.normals.release();
  maps.master.create(grey_.size());
  for_row_bands(pool_, grey_.rows, [&](int begin, int end) {
    for (int r = begin; r < end; ++r)
      for (int c = 0; c < grey_.cols; ++c)
        maps.master(r, c) =
            std::abs((votes_[0].magnitude(r, c) + votes_[1].magnitude(r, c)) + votes_[2].magnitude(r, c)) / 3;
  });
}

}  // namespace saccade
