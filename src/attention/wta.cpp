#include "attention/wta.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "attention/selector.hpp"

namespace saccade {
namespace {

// Units: mV, nS, pA, pF, ms; nS * mV = pA and pA * ms / pF = mV. SPEC's numbers are in SI units.
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

// A cell's state in one step of the two layers; true if some cell is above the threshold.
struct Layers {
  const double* input;
  double* saliency_v;
  double* inhibition;
  double* firing_v;
};

bool step_layers(const Layers& layers, std::size_t cells) {
  double highest = kInhibitoryReversal;
  for (std::size_t i = 0; i < cells; ++i) {
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

}  // namespace

void WtaNetwork::reset(const cv::Mat1f& map, double foa_px) {
  if (map.empty()) throw std::invalid_argument("WtaNetwork: the map is empty");
  rows_ = map.rows;
  cols_ = map.cols;
  step_ = last_new_ = 0;
  ended_.clear();
  const std::size_t cells = map.total();
  input_.resize(cells);
  std::size_t i = 0;
  float highest = 0;
  for (int r = 0; r < rows_; ++r)
    for (int c = 0; c < cols_; ++c, ++i) {
      input_[i] = kInputGain * static_cast<double>(map(r, c)) + kInputBase;
      highest = std::max(highest, map(r, c));
    }
  if (!(highest > 0)) ended_ = "the saliency map is empty";
  saliency_v_.assign(cells, 0);
  inhibition_.assign(cells, 0);
  firing_v_.assign(cells, 0);
  won_.assign(cells, 0);
  global_ = kGlobalInhibition;
  inter_v_ = inter_excitation_ = 0;
  const double sigma = kFoaToSigma * foa_px / kFoaCellPx;
  if (foa_cells_ != sigma || narrow_.size() != static_cast<std::size_t>(std::max(rows_, cols_))) {
    foa_cells_ = sigma;
    narrow_.resize(static_cast<std::size_t>(std::max(rows_, cols_)));
    wide_.resize(narrow_.size());
    for (std::size_t d = 0; d < narrow_.size(); ++d) {
      const double square = static_cast<double>(d * d);
      narrow_[d] = std::exp(-square / (2 * sigma * sigma));
      wide_[d] = std::exp(-square / (2 * 16 * sigma * sigma));
    }
  }
}

bool WtaNetwork::advance() {
  ++step_;
  const std::size_t cells = input_.size();
  const bool fired =
      step_layers({input_.data(), saliency_v_.data(), inhibition_.data(), firing_v_.data()}, cells);
  // 1e-2 S against 1e-9 F is far beyond the stability of Euler's step: one step with the global inhibition
  // takes any cell above E_inh past it, where it is held. So nothing fires in it.
  if (global_ == 0) return fired;
  std::fill(firing_v_.begin(), firing_v_.end(), kInhibitoryReversal);
  global_ = 0;
  return false;
}

std::optional<WtaNetwork::Winner> WtaNetwork::take_winner() {
  std::optional<Winner> winner;
  for (int c = 0; c < cols_; ++c)
    for (int r = 0; r < rows_; ++r) {
      double& v = firing_v_[static_cast<std::size_t>(r * cols_ + c)];
      if (!(v > kThreshold)) continue;
      v = 0;
      if (!winner) winner = Winner{r, c, step_};
    }
  return winner;
}

void WtaNetwork::inhibit_return(int row, int col) {
  const double peak = kReturnGain * saliency_v_[static_cast<std::size_t>(row * cols_ + col)];
  std::size_t i = 0;
  for (int r = 0; r < rows_; ++r)
    for (int c = 0; c < cols_; ++c, ++i) {
      const auto y = static_cast<std::size_t>(std::abs(r - row)),
                 x = static_cast<std::size_t>(std::abs(c - col));
      inhibition_[i] += peak * (narrow_[y] * narrow_[x] - kReturnSurround * (wide_[y] * wide_[x]));
    }
}

// False only if it is certain that no cell reaches the threshold in so many steps. With a conductance of at
// least g, V_saliency stays below the larger of what it is and I/g (a step so stiff that it overshoots comes
// back to 0, then to at most dt/C * I), and V below the larger of what it is and its input's equilibrium.
bool WtaNetwork::can_fire_within(int steps) const {
  constexpr double kRounding = 1 + 1e-9;
  const double decay = std::pow(kInhibitionDecay, steps);
  for (std::size_t i = 0; i < input_.size(); ++i) {
    const double inhibition = inhibition_[i];
    const double conductance = kSaliencyLeak + (inhibition > 0 ? inhibition * decay : inhibition);
    if (conductance <= 0) return true;
    const double v = std::max({saliency_v_[i], input_[i] / conductance, kSaliencyRate * input_[i]});
    if (kFiringInput / kFiringLeak * v * kRounding > kThreshold) return true;
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
