#pragma once

#include <map>
#include <vector>

#include "attention/attention.hpp"

namespace saccade {

/// The numbers, from 1, that objects of a sequence have had.
class UsedNumbers {
 public:
  void add(int number);
  void add(const UsedNumbers& others);
  bool has(int number) const;
  /// Larger than all of them, >= 1.
  int next() const { return used_.empty() ? 1 : static_cast<int>(used_.size()); }

 private:
  std::vector<bool> used_;  // by number
};

/// One side of a comparison in one frame of a sequence. Each side remembers objects by itself and has its own
/// ids for them; `numbers` are what the window shows in their place, common to both sides.
struct NumberedSide {
  std::map<int, int>& numbers;  ///< the number of an object, by its id
  const std::vector<int>& ids;  ///< of the objects of its fixations, in their order
  const Attention& attention;   ///< only the proto-objects are used
};

/// Gives a number to each object of the frame that has none: its id or, if that was used, the next. What both
/// sides have found (more than half of the union of the two proto-objects is in both) has one number, the
/// one by which A knows it. No two objects of a side have the same number. `b`: null = A stands alone.
void assign_numbers(const NumberedSide& a, const NumberedSide* b, UsedNumbers& used);

}  // namespace saccade
