#include "models/itti.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <opencv2/imgproc.hpp>

#include "models/image.hpp"
#include "models/local_maxima.hpp"
#include "saliency/params.hpp"

namespace saccade {
namespace {

// Red/green and blue/yellow of one row. `bgr`: the channels of the image.
void split_row(const std::array<const std::uint8_t*, 3>& bgr, const float* intensity, float least, int width,
               float* red_green, float* blue_yellow) {
  const auto [blue_of, green_of, red_of] = bgr;
  for (int c = 0; c < width; ++c) {
    const float inverse = 1 / (255 * intensity[c]), scale = intensity[c] > least ? inverse : 0;
    const float b = blue_of[c] * scale, g = green_of[c] * scale, r = red_of[c] * scale;
    const float red = std::max(0.0F, r - (g + b) / 2), green = std::max(0.0F, g - (r + b) / 2);
    const float blue = std::max(0.0F, b - (r + g) / 2);
    const float yellow = std::max(0.0F, (r + g) / 2 - std::abs(r - g) / 2 - b);
    red_green[c] = red - green;
    blue_yellow[c] = blue - yellow;
  }
}

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
  // With the channels in arrays of their own, the compiler vectorises the loops.
  using Planes = std::array<cv::Mat1b, 3>;
  for_row_bands(pool_, size_.height, [&](int begin, int end) {
    Planes bgr;
    cv::split(colour.rowRange(begin, end), bgr.data());
    for (int r = begin; r < end; ++r) {
      const std::uint8_t *blue = bgr[0][r - begin], *green = bgr[1][r - begin], *red = bgr[2][r - begin];
      float* out = intensity[r];
      for (int c = 0; c < size_.width; ++c)
        out[c] = static_cast<float>(blue[c] + green[c] + red[c]) / (3 * 255);
    }
  });
  if (orientation_only_) return;
  double largest = 0;
  cv::minMaxLoc(intensity, nullptr, &largest);
  const float least = static_cast<float>(largest) / 10;
  cv::Mat1f &red_green = channels_[kRedGreen].levels[0], &blue_yellow = channels_[kBlueYellow].levels[0];
  for_row_bands(pool_, size_.height, [&](int begin, int end) {
    Planes bgr;
    cv::split(colour.rowRange(begin, end), bgr.data());
    for (int i = begin; i < end; ++i)
      split_row({bgr[0][i - begin], bgr[1][i - begin], bgr[2][i - begin]}, intensity[i], least, size_.width,
                red_green[i], blue_yellow[i]);
  });
}

void IttiModel::build_pyramid(Pyramid& levels) const {
  for (std::size_t l = 1; l < kLevels; ++l) cv::pyrDown(levels[l - 1], levels[l]);
}

// The parts of the Gabor filters and, from them, one orientation, on the levels that are compared.
void IttiModel::find_part(GaborFilters::Part part) {
  for (auto l = static_cast<std::size_t>(kFirstCentre - finer_); l < kLevels; ++l)
    gabor_.find_part(channels_[kIntensity].levels[l], part, gabor_parts_[l]);
}

void IttiModel::find_orientation(int orientation, ChannelState& state) const {
  for (auto l = static_cast<std::size_t>(kFirstCentre - finer_); l < kLevels; ++l)
    gabor_.find_energy(orientation, gabor_parts_[l], state.scratch, state.levels[l]);
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
  const auto gabor_part = [&](int i, int) { find_part(static_cast<GaborFilters::Part>(i)); };
  pool_.for_each(GaborFilters::kParts, std::ref(gabor_part));
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
