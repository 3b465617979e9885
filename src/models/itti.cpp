#include "models/itti.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <opencv2/imgproc.hpp>

#include "models/image.hpp"
#include "models/local_maxima.hpp"
#include "saliency/params.hpp"

namespace saccade {
namespace {

// A Gabor pair of one orientation, exp(i (kx x + ky y)) times a Gaussian, as products of functions of x and
// of y: cos(a + b) = cos a cos b - sin a sin b, sin(a + b) = sin a cos b + cos a sin b.
struct Gabor {
  static constexpr int kReach = 7;  // 3 sigma
  cv::Mat1f cos_x, sin_x, cos_y, sin_y, gauss;
  double constant = 0;  // response of the even filter to an image of ones

  explicit Gabor(double angle) : cos_x(1, 2 * kReach + 1) {
    constexpr double kPeriod = 7, kSigma = kPeriod / 3;
    for (cv::Mat1f* m : {&sin_x, &cos_y, &sin_y, &gauss}) m->create(cos_x.size());
    double sum = 0;
    for (int i = -kReach; i <= kReach; ++i) sum += std::exp(-i * i / (2 * kSigma * kSigma));
    const double k = 2 * std::numbers::pi / kPeriod, kx = k * std::cos(angle), ky = k * std::sin(angle);
    for (int i = -kReach; i <= kReach; ++i) {
      const double g = std::exp(-i * i / (2 * kSigma * kSigma)) / sum;
      gauss(i + kReach) = static_cast<float>(g);
      cos_x(i + kReach) = static_cast<float>(g * std::cos(kx * i));
      sin_x(i + kReach) = static_cast<float>(g * std::sin(kx * i));
      cos_y(i + kReach) = static_cast<float>(g * std::cos(ky * i));
      sin_y(i + kReach) = static_cast<float>(g * std::sin(ky * i));
    }
    constant = cv::sum(cos_x)[0] * cv::sum(cos_y)[0] - cv::sum(sin_x)[0] * cv::sum(sin_y)[0];
  }

  // The magnitude of the pair's response.
  void filter(const cv::Mat1f& image, std::array<cv::Mat1f, 2>& parts, cv::Mat1f& energy) const {
    auto& [sum, part] = parts;
    const auto apply = [&](const cv::Mat1f& x, const cv::Mat1f& y, cv::Mat1f& out) {
      cv::sepFilter2D(image, out, CV_32F, x, y);
    };
    apply(cos_x, cos_y, sum);
    apply(sin_x, sin_y, part);
    sum -= part;
    apply(gauss, gauss, part);
    cv::scaleAdd(part, -constant, sum, sum);
    cv::multiply(sum, sum, energy);
    apply(sin_x, cos_y, sum);
    apply(cos_x, sin_y, part);
    sum += part;
    cv::multiply(sum, sum, sum);
    energy += sum;
    cv::sqrt(energy, energy);
  }
};

}  // namespace

IttiModel::IttiModel(const char* name, bool orientation_only, WorkerPool& pool)
    : name_(name), orientation_only_(orientation_only), pool_(pool) {}

void IttiModel::resize(cv::Size size) {
  if (size == size_) return;
  size_ = size;
  constexpr int kSmallestMap = 24, kMostFiner = 2;
  finer_ = 0;
  const auto map_side = [&] {
    const cv::Size map = level_size(size, kMapLevel - finer_);
    return std::min(map.width, map.height);
  };
  while (finer_ < kMostFiner && map_side() < kSmallestMap) ++finer_;
  for (ChannelState& channel : channels_)
    for (int l = 0; l < kLevels; ++l) channel.levels[static_cast<std::size_t>(l)].create(level_size(size, l));
}

// The article's equations for R, G, B and Y. Colours are divided by the intensity where that is above a tenth
// of its maximum, and are 0 elsewhere.
void IttiModel::split_colours(const cv::Mat3b& colour) {
  cv::Mat1f& intensity = channels_[kIntensity].levels[0];
  for_row_bands(pool_, size_.height, [&](int begin, int end) {
    for (int r = begin; r < end; ++r)
      for (int c = 0; c < size_.width; ++c) {
        const cv::Vec3b& p = colour(r, c);
        intensity(r, c) = static_cast<float>(p[0] + p[1] + p[2]) / (3 * 255);
      }
  });
  if (orientation_only_) return;
  const float least = *std::max_element(intensity.begin(), intensity.end()) / 10;
  cv::Mat1f &red_green = channels_[kRedGreen].levels[0], &blue_yellow = channels_[kBlueYellow].levels[0];
  for_row_bands(pool_, size_.height, [&](int first, int last) {
    for (int i = first; i < last; ++i)
      for (int c = 0; c < size_.width; ++c) {
        const cv::Vec3b& p = colour(i, c);
        const float scale = intensity(i, c) > least ? 1 / (255 * intensity(i, c)) : 0;
        const float b = p[0] * scale, g = p[1] * scale, r = p[2] * scale;
        const float red = std::max(0.0F, r - (g + b) / 2), green = std::max(0.0F, g - (r + b) / 2);
        const float blue = std::max(0.0F, b - (r + g) / 2);
        const float yellow = std::max(0.0F, (r + g) / 2 - std::abs(r - g) / 2 - b);
        red_green(i, c) = red - green;
        blue_yellow(i, c) = blue - yellow;
      }
  });
}

void IttiModel::build_pyramid(Pyramid& levels) const {
  for (std::size_t l = 1; l < kLevels; ++l) cv::pyrDown(levels[l - 1], levels[l]);
}

void IttiModel::find_orientation(int orientation, ChannelState& state) const {
  const Gabor gabor(orientation * std::numbers::pi / kOrientations);
  for (std::size_t l = static_cast<std::size_t>(kFirstCentre - finer_); l < kLevels; ++l)
    gabor.filter(channels_[kIntensity].levels[l], state.parts, state.levels[l]);
}

// The sum over c and s of N(|level c - level s|) at the map's level.
void IttiModel::compare_levels(ChannelState& state) const {
  const int map_level = kMapLevel - finer_;
  state.sum.create(level_size(size_, map_level));
  state.sum.setTo(0);
  for (int centre = kFirstCentre - finer_; centre < kFirstCentre - finer_ + kCentres; ++centre)
    for (int delta = kDelta; delta < kDelta + kSurrounds; ++delta) {
      const cv::Mat1f& fine = state.levels[static_cast<std::size_t>(centre)];
      const cv::Mat1f& coarse = state.levels[static_cast<std::size_t>(centre + delta)];
      auto& difference = state.difference;
      const std::size_t at = static_cast<std::size_t>(centre), end = static_cast<std::size_t>(map_level);
      difference[at].create(fine.size());
      upsample_rows(coarse, delta, difference[at], false, 0, fine.rows);
      cv::absdiff(fine, difference[at], difference[at]);
      attenuate_border(difference[at]);
      promote_few_peaks(difference[at]);
      for (std::size_t l = at; l < end; ++l) cv::pyrDown(difference[l], difference[l + 1]);
      state.sum += difference[end];
    }
}

void IttiModel::add_channels() {
  cv::Mat1f& orientation = channels_[kOrientation].sum;
  for (int o = kOrientation; o < kChannels; ++o) {
    cv::Mat1f& sum = channels_[static_cast<std::size_t>(o)].sum;
    promote_few_peaks(sum);
    if (o > kOrientation) orientation += sum;
  }
  if (orientation_only_) {
    orientation.copyTo(conspicuity_);
    return;
  }
  cv::Mat1f& colour = channels_[kRedGreen].sum;
  colour += channels_[kBlueYellow].sum;
  conspicuity_.create(orientation.size());
  conspicuity_.setTo(0);
  for (cv::Mat1f* map : {&channels_[kIntensity].sum, &colour, &orientation}) {
    promote_few_peaks(*map);
    cv::scaleAdd(*map, 1.0 / 3, conspicuity_, conspicuity_);
  }
}

void IttiModel::compute(const Frame& frame, RequestedOutputs, SaliencyMaps& maps, StageTimes& times) {
  const StageTimer timer(times, Stage::symmetry);
  const cv::Mat3b& colour = colour_of(frame, name_);
  resize(colour.size());
  split_colours(colour);
  const auto pyramid = [&](int i, int) { build_pyramid(channels_[static_cast<std::size_t>(i)].levels); };
  pool_.for_each(orientation_only_ ? 1 : static_cast<int>(kOrientation), std::ref(pyramid));
  const auto compare = [&](int i, int) {  // orientations first, since they take longest
    ChannelState& channel = channels_[static_cast<std::size_t>(kChannels - 1 - i)];
    if (i < kOrientations) find_orientation(kOrientations - 1 - i, channel);
    compare_levels(channel);
  };
  pool_.for_each(orientation_only_ ? kOrientations : static_cast<int>(kChannels), std::ref(compare));
  add_channels();
  maps.levels.clear();
  maps.normals.release();
  maps.master.create(size_);
  for_row_bands(pool_, size_.height, [&](int begin, int end) {
    upsample_rows(conspicuity_, kMapLevel - finer_, maps.master, false, begin, end);
  });
}

}  // namespace saccade
