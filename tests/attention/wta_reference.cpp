#include "wta_reference.hpp"

#include <algorithm>
#include <cmath>

namespace saccade {
namespace {

// A leaky (integrate-and-fire) neuron; mV, nS, pA, pF, ms.
struct Neuron {
  double capacity = 1000, leak = 10, excitatory_reversal = 100, inhibitory_reversal = -20, threshold = 1;
  bool fires = true;
  double v = 0, current = 0, excitation = 0, inhibition = 0, inhibition_decay = 1;

  bool step() {
    const double rate = 0.1 / capacity;
    v += rate * (current - leak * v - excitation * (v - excitatory_reversal) -
                 inhibition * (v - inhibitory_reversal));
    v = std::max(v, inhibitory_reversal);
    inhibition *= inhibition_decay;
    if (!fires || !(v > threshold)) return false;
    v = 0;
    return true;
  }
};

}  // namespace

std::vector<ReferenceWinner> reference_winners(const cv::Mat1f& map, double foa_px, int steps) {
  cv::Mat_<int> fired(map.size());
  std::vector<std::vector<Neuron>> saliency, firing;
  for (int r = 0; r < map.rows; ++r) {
    saliency.emplace_back();
    firing.emplace_back();
    for (int c = 0; c < map.cols; ++c) {
      Neuron s;
      s.capacity = 5e4;
      s.leak = 100;
      s.excitatory_reversal = s.inhibitory_reversal = 0;
      s.fires = false;
      s.current = 1000 * static_cast<double>(map(r, c)) + 0.01;
      s.inhibition_decay = 0.9999;
      saliency.back().push_back(s);
      Neuron f;
      f.inhibition = 1e7;
      firing.back().push_back(f);
    }
  }
  Neuron interneuron;
  std::vector<ReferenceWinner> winners;
  for (int step = 1; step <= steps; ++step) {
    fired.setTo(0);
    for (int r = 0; r < map.rows; ++r)
      for (int c = 0; c < map.cols; ++c) {
        Neuron& s = saliency[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)];
        Neuron& f = firing[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)];
        s.step();
        f.current = 50 * s.v;
        fired(r, c) = f.step();
        f.inhibition = 0;
      }
    ReferenceWinner winner{-1, -1, step};
    for (int c = map.cols - 1; c >= 0; --c)
      for (int r = map.rows - 1; r >= 0; --r)
        if (fired(r, c)) winner.row = r, winner.col = c;
    if (winner.row >= 0) interneuron.excitation = 10 * interneuron.leak;
    if (interneuron.step()) {
      interneuron.excitation = 0;
      for (auto& line : firing)
        for (Neuron& f : line) f.inhibition = 1e7;
    }
    if (winner.row < 0) continue;
    const double v = saliency[static_cast<std::size_t>(winner.row)][static_cast<std::size_t>(winner.col)].v;
    const double sigma = 0.3 * foa_px / 32;
    for (int r = 0; r < map.rows; ++r)
      for (int c = 0; c < map.cols; ++c) {
        const double d2 = (r - winner.row) * (r - winner.row) + (c - winner.col) * (c - winner.col);
        saliency[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)].inhibition +=
            1e5 * v * (std::exp(-d2 / (2 * sigma * sigma)) - 1e-4 * std::exp(-d2 / (2 * 16 * sigma * sigma)));
      }
    winners.push_back(winner);
  }
  return winners;
}

}  // namespace saccade
