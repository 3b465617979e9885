#include "models/mirror_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <opencv2/imgproc.hpp>

#include "models/image.hpp"
#include "saliency/params.hpp"

namespace saccade {
namespace {

constexpr int kOuter = 5, kInner = 2;  // half-widths
constexpr int kUnitsPerGrey = 256;     // of the 16-bit levels
constexpr int kRowsOfBand = 8;

}  // namespace

std::vector<MirrorPair> mirror_pairs() {
  constexpr double kSigma = 16;
  std::vector<MirrorPair> pairs;
  for (int dy = 0; dy <= kOuter; ++dy)
    for (int dx = -kOuter; dx <= kOuter; ++dx) {
      if (dy == 0 && dx <= 0) continue;  // the other end of a pair already listed
      if (dy <= kInner && std::abs(dx) <= kInner) continue;
      const double radius2 = dx * dx + dy * dy, distance2 = 4 * radius2;
      const double weight =
          std::exp(-distance2 / (2 * kSigma * kSigma)) / (kSigma * std::sqrt(2 * std::numbers::pi));
      pairs.push_back({dx, dy, static_cast<float>((dx * dx - dy * dy) / radius2),
                       static_cast<float>(2 * dx * dy / radius2), static_cast<float>(weight)});
    }
  return pairs;
}

MomentPlanes::MomentPlanes(cv::Size size, int planes) {
  for (int p = 0; p < planes; ++p)
    planes_.emplace_back(cv::Mat1f::zeros(size.height + 2 * kMargin, size.width + 2 * kMargin));
}

MirrorPairModel::Level::Level(cv::Size size, const PairMeasure& measure)
    : image(size, CV_MAKETYPE(CV_16U, measure.channels())),
      gx(size, CV_MAKETYPE(CV_32F, measure.channels())),
      gy(gx.clone()),
      moments(size, measure.planes()),
      score(size) {}

MirrorPairModel::MirrorPairModel(const char* name, std::unique_ptr<PairMeasure> measure, WorkerPool& pool,
                                 int last_level)
    : name_(name), measure_(std::move(measure)), pool_(pool), last_level_(last_level) {}

void MirrorPairModel::resize(cv::Size size) {
  if (size == size_) return;
  size_ = size;
  levels_.clear();
  for (int l = kFirstLevel; l <= last_level_; ++l) levels_.emplace_back(level_size(size, l), *measure_);
}

void MirrorPairModel::load(const cv::Mat3b& colour) {
  if (measure_->channels() == 1)
    cv::cvtColor(colour, full_8bit_, cv::COLOR_BGR2GRAY);
  else
    full_8bit_ = colour;
  full_8bit_.convertTo(full_, CV_16U, kUnitsPerGrey);
  cv::pyrDown(full_, levels_[0].image);
  for (std::size_t i = 1; i < levels_.size(); ++i) cv::pyrDown(levels_[i - 1].image, levels_[i].image);
}

// Divides the rows of all levels among the workers: job(level, begin, end).
template <typename Job>
void MirrorPairModel::for_bands(Job job) {
  const auto bands_of = [](const Level& level) { return (level.score.rows + kRowsOfBand - 1) / kRowsOfBand; };
  int bands = 0;
  for (const Level& level : levels_) bands += bands_of(level);
  const auto band = [&](int b, int) {
    std::size_t l = 0;
    for (; b >= bands_of(levels_[l]); ++l) b -= bands_of(levels_[l]);
    job(levels_[l], b * kRowsOfBand, std::min((b + 1) * kRowsOfBand, levels_[l].score.rows));
  };
  pool_.for_each(bands, std::ref(band));
}

const cv::Mat1f& MirrorPairModel::find_symmetry(const cv::Mat3b& colour) {
  resize(colour.size());
  load(colour);
  for_bands([&](Level& level, int begin, int end) {
    // OpenCV reads the rows around a range from the image that the range belongs to.
    const cv::Mat image = level.image.rowRange(begin, end);
    cv::Mat gx = level.gx.rowRange(begin, end), gy = level.gy.rowRange(begin, end);
    cv::Sobel(image, gx, CV_32F, 1, 0);
    cv::Sobel(image, gy, CV_32F, 0, 1);
    // Division comes after the sums, which are exact in integers: flat parts have the gradient 0.
    gx *= 1.0 / (255 * kUnitsPerGrey);
    gy *= 1.0 / (255 * kUnitsPerGrey);
    for (int r = begin; r < end; ++r)
      measure_->set_moments(level.gx.ptr<float>(r), level.gy.ptr<float>(r), level.gx.cols, level.moments, r);
  });
  for_bands([&](Level& level, int begin, int end) {
    for (int r = begin; r < end; ++r) {
      std::fill_n(level.score[r], level.score.cols, 0.0F);
      measure_->add_pairs(level.moments, r, pairs_, level.score[r], level.score.cols);
    }
  });
  for (std::size_t i = levels_.size() - 1; i > 0; --i)
    upsample_rows(levels_[i].score, 1, levels_[i - 1].score, true, 0, levels_[i - 1].score.rows);
  return levels_[0].score;
}

void MirrorPairModel::compute(const Frame& frame, RequestedOutputs, SaliencyMaps& maps, StageTimes& times) {
  const StageTimer timer(times, Stage::symmetry);
  const cv::Mat1f& score = find_symmetry(colour_of(frame, name_));
  maps.levels.clear();
  maps.normals.release();
  maps.master.create(size_);
  for_row_bands(pool_, size_.height, [&](int begin, int end) {
    upsample_rows(score, kFirstLevel, maps.master, false, begin, end);
  });
}

}  // namespace saccade
