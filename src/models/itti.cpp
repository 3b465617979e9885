#include "models/itti.hpp"

#include <algorithm>
#include <functional>

#include <opencv2/imgproc.hpp>

#include "models/colour_opponency.hpp"
#include "models/image.hpp"
#include "models/local_maxima.hpp"
#include "saliency/params.hpp"

namespace saccade {

IttiModel::IttiModel(const char* name, bool orientation_only, WorkerPool& pool, int halvings)
    : name_(name), orientation_only_(orientation_only), halvings_(halvings), pool_(pool) {}

void IttiModel::resize(cv::Size size) {
  if (size == size_) return;
  size_ = size;
  constexpr int kSmallestMap = 24, kMostFiner = 2;
  finer_ = halvings_;
  const auto map_side = [&] {
    const cv::Size map = level_size(size, map_level());
    return std::min(map.width, map.height);
  };
  while (finer_ < kMostFiner && map_side() < kSmallestMap) ++finer_;
  for (ChannelState& channel : channels_)
    for (int l = 0; l < kLevels; ++l) channel.levels[static_cast<std::size_t>(l)].create(level_size(size, l));
}

// Opponency is 0 where the intensity is at most a tenth of its maximum.
void IttiModel::split_colours(const cv::Mat3b& colour) {
  for (cv::Mat1b& channel : bgr_) channel.create(size_);
  row_maximum_.resize(static_cast<std::size_t>(size_.height));
  cv::Mat1f& intensity = channels_[kIntensity].levels[0];
  const auto rows_of = [&](int r) { return ColourRows{bgr_[0][r], bgr_[1][r], bgr_[2][r]}; };
  const auto width = static_cast<std::size_t>(size_.width);
  for_row_bands(pool_, size_.height, [&](int begin, int end) {
    cv::Mat1b band[] = {bgr_[0].rowRange(begin, end), bgr_[1].rowRange(begin, end),
                        bgr_[2].rowRange(begin, end)};
    cv::split(colour.rowRange(begin, end), band);
    for (int r = begin; r < end; ++r)
      row_maximum_[static_cast<std::size_t>(r)] = find_intensity(rows_of(r), intensity[r], width);
  });
  if (orientation_only_) return;
  const float least = *std::max_element(row_maximum_.begin(), row_maximum_.end()) / 10;
  cv::Mat1f &red_green = channels_[kRedGreen].levels[0], &blue_yellow = channels_[kBlueYellow].levels[0];
  for_row_bands(pool_, size_.height, [&](int begin, int end) {
    for (int r = begin; r < end; ++r)
      find_opponency(rows_of(r), intensity[r], least, red_green[r], blue_yellow[r], width);
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
  state.sum.create(level_size(size_, map_level()));
  state.sum.setTo(0);
  for (int centre = kFirstCentre - finer_; centre < kFirstCentre - finer_ + kCentres; ++centre)
    for (int delta = kDelta; delta < kDelta + kSurrounds; ++delta) {
      const cv::Mat1f& fine = state.levels[static_cast<std::size_t>(centre)];
      const cv::Mat1f& coarse = state.levels[static_cast<std::size_t>(centre + delta)];
      auto& difference = state.difference;
      const std::size_t at = static_cast<std::size_t>(centre), end = static_cast<std::size_t>(map_level());
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

const cv::Mat1f& IttiModel::find_conspicuity(const cv::Mat3b& colour) {
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
  return conspicuity_;
}

void IttiModel::compute(const Frame& frame, RequestedOutputs, SaliencyMaps& maps, StageTimes& times) {
  const StageTimer timer(times, Stage::symmetry);
  find_conspicuity(colour_of(frame, name_));
  maps.levels.clear();
  maps.normals.release();
  maps.master.create(size_);
  for_row_bands(pool_, size_.height, [&](int begin, int end) {
    upsample_rows(conspicuity_, map_level(), maps.master, false, begin, end);
  });
}

}  // namespace saccade
