#include "attention/proto.hpp"

#include <iterator>
#include <stdexcept>

#include <fmt/format.h>

#include "attention/selector.hpp"

namespace saccade {

void add_doubtful(int fixations, double min_confidence, std::string& ended_early) {
  fmt::format_to(std::back_inserter(ended_early), "{}{} point{} with a confidence below {}",
                 ended_early.empty() ? "" : "; ", fixations, fixations == 1 ? "" : "s", min_confidence);
}

ProtoSelector::ProtoSelector(int fixations, double min_confidence)
    : fixations_(fixations), min_confidence_(min_confidence) {
  if (fixations < 1) throw std::invalid_argument("ProtoSelector: at least one fixation");
}

void ProtoSelector::select(const cv::Mat1f& saliency, const cv::Mat1f& depth_mm, const Intrinsics& camera,
                           Attention& attention) {
  begin_attention(saliency, depth_mm, camera, attention);
  surfaces_.build(depth_mm, camera);
  smooth_cells(saliency, scratch_, smooth_);
  values_ = smooth_;
  surfaces_.weigh(values_);
  competition_.begin(values_, surfaces_.grid().rows(), surfaces_.grid().cols());
  objects_.begin(surfaces_.grid(), surfaces_.segments(), depth_mm, camera);
  float strongest = 0;  // smoothed saliency of the first winner
  int doubtful = 0;
  for (int k = 0; k < fixations_; ++k) {
    const auto winner = competition_.winner();
    if (!winner) {
      attention.ended_early = k == 0 ? kNothingSalient : kNothingLeft;
      break;
    }
    const float saliency_there = smooth_[static_cast<std::size_t>(*winner)];
    if (k == 0) strongest = saliency_there;
    const std::vector<int>& cells = objects_.around(*winner);
    competition_.inhibit(cells);
    competition_.discount_around(*winner);
    const float sure = surfaces_.confidence_at(*winner, saliency_there / strongest);
    if (static_cast<double>(sure) < min_confidence_) {
      ++doubtful;
      continue;
    }
    const cv::Point pixel = objects_.fixated_pixel(saliency, *winner);
    Fixation fixation = fixation_at(saliency, depth_mm, camera, pixel.y, pixel.x);
    const int rank = static_cast<int>(attention.fixations.size()) + 1;
    fixation.proto_object = objects_.paint(cells, attention.masks, rank);
    fixation.confidence = sure;
    attention.fixations.push_back(fixation);
  }
  if (doubtful > 0) add_doubtful(doubtful, min_confidence_, attention.ended_early);
}

}  // namespace saccade
