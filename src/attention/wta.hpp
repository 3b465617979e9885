#pragma once

#include <optional>
#include <string>
#include <vector>

#include "attention/attention.hpp"

namespace saccade {

/// The Winner-Take-All network with inhibition of return of Koch and Ullman, in the form of Itti and Koch,
/// with the constants of README.md, section 8. A network cell covers kCellPx x kCellPx image pixels.
///
/// One step of dt = 0.1 ms, explicit Euler, does in this order:
///  1. saliency layer: V += dt/C * (I - (g_leak + G_inh) * V), not below its reversal potential 0;
///     then G_inh *= 0.9999;
///  2. firing layer, with the new V of 1. as its input: V += dt/C * (5e-8 S * V_saliency - g_leak * V -
///     G_global * (V - E_inh)), not below E_inh; cells above the threshold fire and go to 0;
///  3. the global inhibition ends;
///  4. the winner is the cell that fired in the lowest column, there the lowest row; it excites the
///     interneuron;
///  5. the interneuron; if it fires it loses its excitation and sets the global inhibition of the next step;
///  6. inhibition of return around the winner is added to G_inh of the saliency layer.
/// "Above" is strict. At the start every V is 0 and the global inhibition is set, as after a winner.
///
/// Most cells are never near the threshold, and one that cannot fire touches no other cell. So a cell sleeps
/// until a bound says that it may fire soon; then the steps that it slept through are made up for. The
/// winners and their steps are those of the full simulation.
class WtaNetwork {
 public:
  /// m = 5 counted from one: the map is 1/16 of the image.
  static constexpr int kCellPx = 16;

  /// Steps without a new winner after which the network is given up: 1 s of its time. The inhibition of
  /// return wears off after 5 s, so what could still come are cells that have won already.
  static constexpr int kPatienceSteps = 10000;

  /// One cell that fired.
  struct Winner {
    int row = 0, col = 0;  ///< of the cell
    int step = 0;          ///< number of the step in which it fired, from 1
  };

  /// Starts afresh. `map`: the input S of each cell, finite, 0..1. foa_px: diameter of the focus of
  /// attention in image pixels, above 0. Throws std::invalid_argument if `map` is empty.
  void reset(const cv::Mat1f& map, double foa_px);

  /// Runs to the next cell that has not won before; std::nullopt if there will be none, see ended().
  /// A cell may win again once its inhibition has worn off: it then acts on the network as any winner, but
  /// is not given out twice.
  std::optional<Winner> next();

  /// Why next() gave none; empty before.
  const std::string& ended() const { return ended_; }

 private:
  bool advance();
  void wake_cells(int until);
  std::optional<Winner> take_winner();
  void inhibit_return(int row, int col);
  void add_inhibition(std::size_t begin, std::size_t k);
  bool can_fire_within(int steps) const;

  // Inhibition of return around one winner.
  struct Inhibition {
    int step, row, col;
    double peak;  // nS
  };

  int rows_ = 0, cols_ = 0, step_ = 0, last_new_ = 0;
  int last_reset_ = 0;  // step of the last global inhibition
  int safe_until_ = 0;  // no sleeping cell can fire up to this step
  double sigma_cells_ = 0, global_ = 0;
  double inter_v_ = 0, inter_excitation_ = 0;
  std::vector<Inhibition> inhibitions_;
  std::vector<double> narrow_, wide_;  // Gaussians by distance along one axis
  // One per cell, row by row
  std::vector<double> current_, surround_;  // pA; nS, all that inhibition of return ever took off
  std::vector<unsigned char> awake_, won_;
  // One per cell that is simulated, in the order in which they woke
  std::vector<int> cell_;
  std::vector<double> input_, saliency_v_, inhibition_, firing_v_;
  std::string ended_;
};

/// The map that the network gets: mean of `saliency` over each cell (the last ones may be cut by the image's
/// border), divided by the largest of them; all 0 if that is 0. `cells` is reused.
void reduce_to_cells(const cv::Mat1f& saliency, cv::Mat1f& cells);

/// Selector `wta`: fixations are the centres of the winners' cells, (16 row + 8, 16 col + 8) clamped into the
/// image, whether there is depth or not. Leaves Attention::masks all 0.
class WtaSelector : public AttentionSelector {
 public:
  /// Throws std::invalid_argument unless fixations >= 1 and foa_px is finite and above 0.
  WtaSelector(int fixations, double foa_px);
  void select(const cv::Mat1f& saliency, const cv::Mat1f& depth_mm, const Intrinsics& camera,
              Attention& attention) override;

 private:
  int fixations_;
  double foa_px_;
  cv::Mat1f cells_;
  WtaNetwork network_;
};

}  // namespace saccade
