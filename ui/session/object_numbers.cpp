#include "ui/session/object_numbers.hpp"

#include <algorithm>

namespace saccade {
namespace {

constexpr int kNone = -1;

std::optional<int> number_of(const NumberedSide& side, int id) {
  const auto found = side.numbers.find(id);
  return found == side.numbers.end() ? std::nullopt : std::optional(found->second);
}

int new_number(int id, UsedNumbers& used) {
  const int number = used.has(id) ? used.next() : id;
  used.add(number);
  return number;
}

// Another object that had the number gets a new one.
void set_number(const NumberedSide& side, int id, int number, UsedNumbers& used) {
  for (auto& [other, its_number] : side.numbers)
    if (other != id && its_number == number) its_number = new_number(other, used);
  side.numbers[id] = number;
}

void number_the_rest(const NumberedSide& side, UsedNumbers& used) {
  for (const int id : side.ids)
    if (!number_of(side, id)) side.numbers[id] = new_number(id, used);
}

// For each fixation of `a`, that of `b` whose proto-object is the same: more than half of their union is in
// both, so there is at most one. kNone = none.
std::vector<int> same_objects(const Attention& a, const Attention& b) {
  constexpr int kEvery = 2;  // rows and columns
  std::vector<int> same(a.fixations.size(), kNone);
  if (a.masks.size() != b.masks.size()) return same;
  const std::size_t columns = b.fixations.size() + 1;
  std::vector<int> both((a.fixations.size() + 1) * columns), in_a(a.fixations.size() + 1), in_b(columns);
  for (int r = 0; r < a.masks.rows; r += kEvery)
    for (int c = 0; c < a.masks.cols; c += kEvery) {
      const std::size_t i = a.masks(r, c), j = b.masks(r, c);
      ++both[i * columns + j];
      ++in_a[i];
      ++in_b[j];
    }
  for (std::size_t i = 1; i < in_a.size(); ++i)
    for (std::size_t j = 1; j < columns; ++j)
      if (const int common = both[i * columns + j]; 2 * common > in_a[i] + in_b[j] - common)
        same[i - 1] = static_cast<int>(j) - 1;
  return same;
}

void number_pair(const NumberedSide& a, int a_id, const NumberedSide& b, int b_id, UsedNumbers& used) {
  const std::optional<int> known_to_a = number_of(a, a_id), known_to_b = number_of(b, b_id);
  if (!known_to_a) set_number(a, a_id, known_to_b ? *known_to_b : new_number(a_id, used), used);
  const int number = a.numbers.at(a_id);
  if (known_to_b != number) set_number(b, b_id, number, used);
}

}  // namespace

void UsedNumbers::add(int number) {
  const auto place = static_cast<std::size_t>(number);
  if (place >= used_.size()) used_.resize(place + 1);
  used_[place] = true;
}

void UsedNumbers::add(const UsedNumbers& others) {
  for (int number = 1; number < others.next(); ++number)
    if (others.has(number)) add(number);
}

bool UsedNumbers::has(int number) const {
  const auto place = static_cast<std::size_t>(number);
  return place < used_.size() && used_[place];
}

void assign_numbers(const NumberedSide& a, const NumberedSide* b, UsedNumbers& used) {
  if (b != nullptr) {
    const std::vector<int> same = same_objects(a.attention, b->attention);
    for (std::size_t i = 0; i < same.size(); ++i)
      if (same[i] != kNone) number_pair(a, a.ids[i], *b, b->ids[static_cast<std::size_t>(same[i])], used);
  }
  number_the_rest(a, used);
  if (b != nullptr) number_the_rest(*b, used);
}

}  // namespace saccade
