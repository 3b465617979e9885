#include "tracking/held_objects.hpp"

#include <algorithm>

namespace saccade {
namespace {

// Whether z is behind a surface at `from`.
bool is_behind(float z, float from) { return z > from + SurfaceGrid::jump_mm(from); }

}  // namespace

const std::vector<HeldObjects::Pair>& HeldObjects::find(const SurfaceGrid& grid,
                                                        std::span<const int> object_of, int objects) {
  grid_ = &grid;
  object_of_ = object_of;
  pairs_.clear();
  measure(objects);
  for (int holder = 0; holder < objects; ++holder) {
    if (boxes_[at(holder)].empty()) continue;
    look_up(holder);
    if (std::none_of(under_.begin(), under_.end(), [](int columns) { return columns > 0; })) continue;
    look_beside(holder);
    for (int held = 0; held < objects; ++held)
      if (holds(holder, held)) pairs_.push_back({held, holder});
  }
  return pairs_;
}

void HeldObjects::measure(int objects) {
  const int rows = grid_->rows(), cols = grid_->cols();
  boxes_.assign(at(objects), {});
  for (auto* const ends : {&first_row_, &last_row_}) ends->assign(at(objects * cols), kNone);
  for (auto* const ends : {&first_col_, &last_col_}) ends->assign(at(objects * rows), kNone);
  for (int row = 0; row < rows; ++row)
    for (int col = 0; col < cols; ++col) {
      const int object = object_at(row, col);
      if (object == kNone) continue;
      Box& box = boxes_[at(object)];
      const float z = depth_at(row, col);
      if (box.empty()) box = {row, col, col, z, z};
      box.left = std::min(box.left, col);
      box.right = std::max(box.right, col);
      box.nearest_mm = std::min(box.nearest_mm, z);
      box.farthest_mm = std::max(box.farthest_mm, z);
      const auto extend = [](int& first, int& last, int to) {
        if (first == kNone) first = to;
        last = to;
      };
      extend(first_row_[at(object * cols + col)], last_row_[at(object * cols + col)], row);
      extend(first_col_[at(object * rows + row)], last_col_[at(object * rows + row)], col);
    }
}

// What is right above the holder's upper edge, and not behind it.
void HeldObjects::look_up(int holder) {
  const Box& box = boxes_[at(holder)];
  under_.assign(boxes_.size(), 0);
  edge_ = 0;
  edge_mm_ = 0;
  for (int col = box.left; col <= box.right; ++col) {
    const int top = first_row_[at(holder * grid_->cols() + col)];
    if (top == kNone || top > box.top + kEdge) continue;
    const float z = depth_at(top, col);
    ++edge_;
    edge_mm_ = std::max(edge_mm_, z);
    for (int row = top - 1; row >= std::max(0, top - 1 - kGap); --row) {
      const int above = object_at(row, col);
      const float z_above = depth_at(row, col);
      if (above != kNone) {
        if (!is_behind(z_above, z)) ++under_[at(above)];
        break;
      }
      if (z_above > 0 && !is_behind(z_above, z)) break;
    }
  }
}

// What is beside the holder, left and right of each of its rows.
void HeldObjects::look_beside(int holder) {
  const int cols = grid_->cols();
  beside_.assign(boxes_.size(), 0);
  sides_ = 0;
  for (int row = boxes_[at(holder)].top; row < grid_->rows(); ++row) {
    const std::size_t in_row = at(holder * grid_->rows() + row);
    if (first_col_[in_row] == kNone) continue;
    sides_ += 2;
    for (const int step : {-1, 1}) {
      int col = step < 0 ? first_col_[in_row] : last_col_[in_row];
      for (int k = 0; k <= kGap; ++k) {
        col += step;
        if (col < 0 || col >= cols) break;
        if (const int other = object_at(row, col); other != kNone) {
          ++beside_[at(other)];
          break;
        }
      }
    }
  }
}

bool HeldObjects::holds(int holder, int held) const {
  if (held == holder || under_[at(held)] < kUnder * edge_) return false;
  const Box &below = boxes_[at(holder)], &above = boxes_[at(held)];
  const float jump = SurfaceGrid::jump_mm(edge_mm_);
  return below.width() <= kNarrower * above.width() && edge_mm_ >= above.nearest_mm - jump &&
         edge_mm_ <= above.farthest_mm + jump && beside_[at(held)] <= kBeside * sides_ &&
         !stands_on_others(held, holder);
}

bool HeldObjects::stands_on_others(int held, int holder) const {
  const int rows = grid_->rows();
  int standing = 0, hanging = 0;
  for (int col = boxes_[at(held)].left; col <= boxes_[at(held)].right; ++col) {
    const int bottom = last_row_[at(held * grid_->cols() + col)];
    if (bottom == kNone) continue;
    if (bottom + 1 == rows) {  // it may stand on something below the image
      ++standing;
      continue;
    }
    const float z = depth_at(bottom, col);
    for (int row = bottom + 1; row <= std::min(rows - 1, bottom + 1 + kGap); ++row) {
      const float z_below = depth_at(row, col);
      if (z_below == 0) continue;
      if (object_at(row, col) != holder) ++(is_behind(z_below, z) ? hanging : standing);
      break;
    }
  }
  return standing > kStands * (standing + hanging);
}

}  // namespace saccade
