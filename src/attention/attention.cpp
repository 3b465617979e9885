#include "attention/attention.hpp"

#include <algorithm>
#include <cstdint>
#include <stdexcept>

#include "attention/proto.hpp"
#include "attention/selector.hpp"
#include "attention/wta.hpp"

namespace saccade {

void begin_attention(const cv::Mat1f& saliency, const cv::Mat1f& depth_mm, const Intrinsics& camera,
                     Attention& attention) {
  if (saliency.empty() || saliency.size() != depth_mm.size())
    throw std::invalid_argument("AttentionSelector: saliency and depth must have one size, and pixels");
  if (!camera.valid()) throw std::invalid_argument("AttentionSelector: the camera is not valid");
  attention.fixations.clear();
  attention.ended_early.clear();
  attention.sequence.reset();
  attention.masks.create(saliency.size());
  // setTo() takes memory, and the iterators of cv::Mat take ten times as long.
  for (int r = 0; r < attention.masks.rows; ++r)
    std::fill_n(attention.masks[r], attention.masks.cols, std::uint16_t{0});
}

Fixation fixation_at(const cv::Mat1f& saliency, const cv::Mat1f& depth_mm, const Intrinsics& camera, int row,
                     int col) {
  Fixation fixation;
  fixation.row = row;
  fixation.col = col;
  fixation.saliency = saliency(row, col);
  fixation.position_mm = camera.point_mm(row, col, static_cast<double>(depth_mm(row, col)));
  return fixation;
}

std::unique_ptr<AttentionSelector> make_selector(const AttentionSettings& settings) {
  if (settings.selector == Selector::wta)
    return std::make_unique<WtaSelector>(settings.fixations, settings.foa);
  return std::make_unique<ProtoSelector>(settings.fixations, settings.min_confidence);
}

}  // namespace saccade
