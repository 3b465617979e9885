#pragma once

#include <span>
#include <vector>

#include "attention/surface_grid.hpp"

namespace saccade {

/// Which objects hang in the air above another one that holds them: the shade of a lamp above its pole, a
/// table top above a leg, the leaves of a plant above the pot. What is held so does not end where the holder
/// begins, however different the two look. "Above" is up in the image: the camera is taken to stand upright.
///
/// The holder is narrower than what it holds and under it; nothing of what it holds is beside it; and it is
/// not in front, as books are before the back of their shelf. Keeps its memory between frames. Thread safety:
/// one call at a time per object.
class HeldObjects {
 public:
  static constexpr double kNarrower = 0.8;  ///< at most: width of the holder, of that of what it holds
  static constexpr double kUnder = 0.6;     ///< at least: share of the holder's upper edge right under it
  static constexpr double kBeside = 0.1;    ///< at most: share of the holder's sides that touch it
  static constexpr double kStands = 0.7;    ///< at most: share of its lower edge that rests on others
  static constexpr int kEdge = 2;           ///< cells; how far down the holder's upper edge may go
  static constexpr int kGap = 2;  ///< cells in between at most, without depth or with something far behind

  /// Two objects, by number.
  struct Pair {
    int held, holder;
  };

  /// `object_of`: for each cell the number of its object, 0..objects-1, or -1. Cells without depth have none.
  /// Valid until the next call.
  const std::vector<Pair>& find(const SurfaceGrid& grid, std::span<const int> object_of, int objects);

 private:
  static constexpr int kNone = -1;

  // Cells of an object, all -1 without any.
  struct Box {
    int top = kNone, left = kNone, right = kNone;
    float nearest_mm = 0, farthest_mm = 0;
    bool empty() const { return top == kNone; }
    int width() const { return right - left + 1; }
  };

  void measure(int objects);
  void look_up(int holder);
  void look_beside(int holder);
  bool holds(int holder, int held) const;
  bool stands_on_others(int held, int holder) const;
  int object_at(int row, int col) const { return object_of_[at(row * grid_->cols() + col)]; }
  float depth_at(int row, int col) const { return grid_->depth_mm()[at(row * grid_->cols() + col)]; }

  const SurfaceGrid* grid_ = nullptr;      // of the present call
  std::span<const int> object_of_;         // of the present call
  std::vector<Box> boxes_;                 // by object
  std::vector<int> first_row_, last_row_;  // of each object in each column
  std::vector<int> first_col_, last_col_;  // of each object in each row
  std::vector<int> under_, beside_;        // columns and sides of one holder at which each object is
  int edge_ = 0, sides_ = 0;               // all of its columns and sides that count
  float edge_mm_ = 0;                      // depth of its upper edge, the farthest
  std::vector<Pair> pairs_;
};

}  // namespace saccade
