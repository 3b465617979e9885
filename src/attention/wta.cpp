#include "attention/wta.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "attention/selector.hpp"

namespace saccade {
namespace {

// Units: mV, nS, pA, pF, ms; nS * mV = pA and pA * ms / pF = mV. README.md, section 8, has SI units.
constexpr double kStepMs = 0.1;
constexpr double kSaliencyLeak = 100;                   // 1e-7 S
constexpr double kSaliencyRate = kStepMs / 5e4;         // dt/C, C = 5e-8 F
constexpr double kInputGain = 1000, kInputBase = 0.01;  // 1e-9 * S + 1e-14 A
constexpr double kInhibitionDecay = 0.9999;
constexpr double kFiringLeak = 10;                // 1e-8 S
constexpr double kFiringRate = kStepMs / 1000;    // dt/C, C = 1e-9 F
constexpr double kFiringInput = 50;               // 5e-8 S
constexpr double kThreshold = 1;                  // 1 mV
constexpr double kInhibitoryReversal = -20;       // -20 mV
constexpr double kGlobalInhibition = 1e7;         // 1e-2 S
constexpr double kExcitation = 10 * kFiringLeak;  // on the interneuron
constexpr double kExcitatoryReversal = 100;       // 100 mV
constexpr double kReturnGain = 1e5;               // 0.1 S per V
constexpr double kReturnSurround = 1e-4;
constexpr double kFoaToSigma = 0.3;  // s = 0.3 * foa / 2^5 map pixels
constexpr double kFoaCellPx = 32;

// For the proofs: more than what the rounding of some thousand steps can add up to.
constexpr double kRounding = 1 + 1e-9;

struct Layers {
  const double* input;
  double* saliency_v;
  double* inhibition;
  double* firing_v;
};

// One step of cells [begin, end) without the global inhibition; true if one is above the threshold.
bool step_layers(const Layers& layers, std::size_t begin, std::size_t end) {
  double highest = kInhibitoryReversal;
  for (std::size_t i = begin; i < end; ++i) {
    const double s = layers.saliency_v[i], inhibition = layers.inhibition[i], f = layers.firing_v[i];
    const double moved = s + kSaliencyRate * (layers.input[i] - (kSaliencyLeak + inhibition) * s);
    const double next_s = moved > 0 ? moved : 0;
    layers.saliency_v[i] = next_s;
    layers.inhibition[i] = inhibition * kInhibitionDecay;
    const double next_f = f + kFiringRate * (kFiringInput * next_s - kFiringLeak * f);
    layers.firing_v[i] = next_f;
    highest = next_f > highest ? next_f : highest;
  }
  return highest > kThreshold;
}

// The V_saliency that a cell must at least have to come from E_inh above the threshold in so many steps: with
// the constant input 50 nS * v it is at u - (u - E_inh) q^n then, u = 5 v, q = 1 - dt/C * g_leak.
double least_saliency_v(int steps) {
  const double q = std::pow(1 - kFiringRate * kFiringLeak, steps);
  return kFiringLeak / kFiringInput * (kThreshold - kInhibitoryReversal * q) / (1 - q);
}

}  // namespace

void WtaNetwork::reset(const cv::Mat1f& map, double foa_px) {
  if (map.empty()) throw std::invalid_argument("WtaNetwork: the map is empty");
  rows_ = map.rows;
  cols_ = map.cols;
  step_ = last_new_ = last_reset_ = safe_until_ = 0;
  const std::size_t cells = map.total();
  current_.resize(cells);
  std::size_t i = 0;
  float highest = 0;
  for (int r = 0; r < rows_; ++r)
    for (int c = 0; c < cols_; ++c, ++i) {
      current_[i] = kInputGain * static_cast<double>(map(r, c)) + kInputBase;
      highest = std::max(highest, map(r, c));
    }
  ended_ = highest > 0 ? "" : "the saliency map is empty";
  surround_.assign(cells, 0);
  awake_.assign(cells, 0);
  won_.assign(cells, 0);
  for (auto* array : {&input_, &saliency_v_, &inhibition_, &firing_v_}) {
    array->clear();
    array->reserve(cells);
  }
  cell_.clear();
  cell_.reserve(cells);
  inhibitions_.clear();
  global_ = kGlobalInhibition;
  inter_v_ = inter_excitation_ = 0;
  const double sigma = kFoaToSigma * foa_px / kFoaCellPx;
  const auto side = static_cast<std::size_t>(std::max(rows_, cols_));
  if (sigma_cells_ == sigma && narrow_.size() == side) return;
  sigma_cells_ = sigma;
  narrow_.resize(side);
  wide_.resize(side);
  for (std::size_t d = 0; d < side; ++d) {
    const double square = static_cast<double>(d * d);
    narrow_[d] = std::exp(-square / (2 * sigma * sigma));
    wide_[d] = std::exp(-square / (2 * 16 * sigma * sigma));
  }
}

bool WtaNetwork::advance() {
  constexpr int kStepsAhead = 64;
  if (step_ >= safe_until_) {
    wake_cells(step_ + kStepsAhead);
    safe_until_ = step_ + kStepsAhead;
  }
  ++step_;
  const bool fired =
      step_layers({input_.data(), saliency_v_.data(), inhibition_.data(), firing_v_.data()}, 0, cell_.size());
  // 1e-2 S against 1e-9 F is far beyond the stability of Euler's step: one step with the global inhibition
  // takes any cell above E_inh past it, where it is held. So nothing fires in it.
  if (global_ == 0) return fired;
  std::fill(firing_v_.begin(), firing_v_.end(), kInhibitoryReversal);
  global_ = 0;
  last_reset_ = step_;
  return false;
}

// Wakes every cell that is not certain to stay below the threshold up to step `until`, and brings it to
// step_. V_saliency is at most I/g with the least conductance g there has been, and grows by at most dt/C * I
// a step while that is not negative.
void WtaNetwork::wake_cells(int until) {
  const std::size_t first = cell_.size();
  const double least = least_saliency_v(until - last_reset_);
  const double most_steps = kSaliencyRate * until * kRounding;
  for (std::size_t i = 0; i < current_.size(); ++i) {
    if (awake_[i]) continue;
    const double conductance = kSaliencyLeak - surround_[i];
    if (conductance > 0 && std::min(most_steps, kRounding / conductance) * current_[i] <= least) continue;
    awake_[i] = 1;
    cell_.push_back(static_cast<int>(i));
    input_.push_back(current_[i]);
    for (auto* array : {&saliency_v_, &inhibition_, &firing_v_}) array->push_back(0);
  }
  if (cell_.size() == first) return;
  const Layers layers{input_.data(), saliency_v_.data(), inhibition_.data(), firing_v_.data()};
  std::size_t next = 0;
  for (int step = 1; step <= step_; ++step) {
    step_layers(layers, first, cell_.size());
    if (step == last_reset_)
      std::fill(firing_v_.begin() + static_cast<std::ptrdiff_t>(first), firing_v_.end(), kInhibitoryReversal);
    for (; next < inhibitions_.size() && inhibitions_[next].step == step; ++next) add_inhibition(first, next);
  }
}

std::optional<WtaNetwork::Winner> WtaNetwork::take_winner() {
  std::optional<Winner> winner;
  for (std::size_t i = 0; i < cell_.size(); ++i) {
    if (!(firing_v_[i] > kThreshold)) continue;
    firing_v_[i] = 0;
    const int row = cell_[i] / cols_, col = cell_[i] % cols_;
    if (!winner || col < winner->col || (col == winner->col && row < winner->row))
      winner = Winner{row, col, step_};
  }
  return winner;
}

void WtaNetwork::inhibit_return(int row, int col) {
  const auto winner = std::find(cell_.begin(), cell_.end(), row * cols_ + col) - cell_.begin();
  const double peak = kReturnGain * saliency_v_[static_cast<std::size_t>(winner)];
  inhibitions_.push_back({step_, row, col, peak});
  add_inhibition(0, inhibitions_.size() - 1);
  std::size_t i = 0;
  for (int r = 0; r < rows_; ++r)
    for (int c = 0; c < cols_; ++c, ++i)
      surround_[i] += peak * kReturnSurround * wide_[static_cast<std::size_t>(std::abs(r - row))] *
                      wide_[static_cast<std::size_t>(std::abs(c - col))];
  safe_until_ = step_;
}

// Adds inhibition number k to the cells awake from `begin` on.
void WtaNetwork::add_inhibition(std::size_t begin, std::size_t k) {
  const Inhibition& around = inhibitions_[k];
  for (std::size_t i = begin; i < cell_.size(); ++i) {
    const auto y = static_cast<std::size_t>(std::abs(cell_[i] / cols_ - around.row));
    const auto x = static_cast<std::size_t>(std::abs(cell_[i] % cols_ - around.col));
    inhibition_[i] += around.peak * (narrow_[y] * narrow_[x] - kReturnSurround * (wide_[y] * wide_[x]));
  }
}

// False only if it is certain that no cell reaches the threshold in so many steps. With a conductance of at
// least g, V_saliency stays below the larger of what it is and I/g (a step so stiff that it overshoots comes
// back to 0, then to at most dt/C * I), and V below the larger of what it is and its input's equilibrium.
bool WtaNetwork::can_fire_within(int steps) const {
  constexpr double kLeast = kThreshold * kFiringLeak / kFiringInput / kRounding;
  for (std::size_t i = 0; i < current_.size(); ++i)
    if (!awake_[i] &&
        !(kSaliencyLeak > surround_[i] && current_[i] / (kSaliencyLeak - surround_[i]) <= kLeast))
      return true;
  const double decay = std::pow(kInhibitionDecay, steps);
  for (std::size_t i = 0; i < cell_.size(); ++i) {
    const double inhibition = inhibition_[i];
    const double conductance = kSaliencyLeak + (inhibition > 0 ? inhibition * decay : inhibition);
    if (conductance <= 0) return true;
    if (std::max({saliency_v_[i], input_[i] / conductance, kSaliencyRate * input_[i]}) > kLeast) return true;
  }
  return false;
}

std::optional<WtaNetwork::Winner> WtaNetwork::next() {
  constexpr int kProofEverySteps = 500;
  while (ended_.empty()) {
    const int left = last_new_ + kPatienceSteps - step_;
    if (left <= 0) {
      ended_ = "no new cell of the network fired within 1 s";
      break;
    }
    if ((step_ - last_new_) % kProofEverySteps == 0 && !can_fire_within(left)) {
      ended_ = "no further cell of the network can reach the threshold";
      break;
    }
    const bool fired = advance();
    const std::optional<Winner> winner = fired ? take_winner() : std::nullopt;
    if (winner) inter_excitation_ = kExcitation;
    inter_v_ +=
        kFiringRate * (-kFiringLeak * inter_v_ - inter_excitation_ * (inter_v_ - kExcitatoryReversal));
    if (inter_v_ > kThreshold) {
      inter_v_ = inter_excitation_ = 0;
      global_ = kGlobalInhibition;
    }
    if (!winner) continue;
    inhibit_return(winner->row, winner->col);
    unsigned char& won = won_[static_cast<std::size_t>(winner->row * cols_ + winner->col)];
    if (won) continue;
    won = 1;
    last_new_ = step_;
    return winner;
  }
  return std::nullopt;
}

void reduce_to_cells(const cv::Mat1f& saliency, cv::Mat1f& cells) {
  constexpr int kCell = WtaNetwork::kCellPx;
  cells.create((saliency.rows + kCell - 1) / kCell, (saliency.cols + kCell - 1) / kCell);
  float highest = 0;
  for (int r = 0; r < cells.rows; ++r)
    for (int c = 0; c < cells.cols; ++c) {
      const int bottom = std::min(saliency.rows, (r + 1) * kCell),
                right = std::min(saliency.cols, (c + 1) * kCell);
      float sum = 0;
      for (int y = r * kCell; y < bottom; ++y) {
        const float* line = saliency[y];
        for (int x = c * kCell; x < right; ++x) sum += line[x];
      }
      cells(r, c) = sum / static_cast<float>((bottom - r * kCell) * (right - c * kCell));
      highest = std::max(highest, cells(r, c));
    }
  if (highest > 0)
    for (float& value : cells) value /= highest;
}

WtaSelector::WtaSelector(int fixations, double foa_px) : fixations_(fixations), foa_px_(foa_px) {
  if (fixations < 1) throw std::invalid_argument("WtaSelector: at least one fixation");
  if (!std::isfinite(foa_px) || foa_px <= 0) throw std::invalid_argument("WtaSelector: foa above 0");
}

void WtaSelector::select(const cv::Mat1f& saliency, const cv::Mat1f& depth_mm, const Intrinsics& camera,
                         Attention& attention) {
  begin_attention(saliency, depth_mm, camera, attention);
  reduce_to_cells(saliency, cells_);
  network_.reset(cells_, foa_px_);
  constexpr int kCell = WtaNetwork::kCellPx;
  while (static_cast<int>(attention.fixations.size()) < fixations_) {
    const auto winner = network_.next();
    if (!winner) {
      attention.ended_early = network_.ended();
      return;
    }
    const int row = std::min(winner->row * kCell + kCell / 2, saliency.rows - 1);
    const int col = std::min(winner->col * kCell + kCell / 2, saliency.cols - 1);
    attention.fixations.push_back(fixation_at(saliency, depth_mm, camera, row, col));
  }
}

}  // namespace saccade
