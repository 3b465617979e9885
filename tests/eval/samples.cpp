#include "samples.hpp"

namespace saccade {

EvalPlan sample_plan() {
  EvalPlan plan;
  plan.dataset = "some/folder";
  plan.positions = 3;
  plan.points = 3;
  parse_lists(plan, "symmetry3d", "10,15", "proto,wta");
  return plan;
}

std::vector<ImageResult> sample_images() {
  ImageResult first{0, "0000", {}, 2, false, {0.1, 0.1, 0.1}, {0.2, 0.2, 0.2}, {}};
  first.conditions = {{{{1, 2, 4}, {3, 4, 5}, {5, 6, 0}}, 10, 1},
                      {{{1, 2, 4}, {3, 4, 4}, {5, 6, 5}}, 10, 3},
                      {{{1, 2, 0}, {3, 4, 4}, {5, 6, 5}}, 20, 1},
                      {{{1, 2, 4}}, 20, 3}};
  ImageResult second{1, "0001", "0001_label.png: 80x80, but the depth is 160x160", 0, false, {}, {}, {}};
  ImageResult third{2, "a,\"b\"", {}, 1, false, {0.3, 0.3, 0.3}, {0.4, 0.4, 0.4}, {}};
  third.conditions = {{{{7, 8, 9}}, 30, 1}, {{}, 30, 3}, {{{7, 8, 9}}, 40, 1}, {{{7, 8, 0}}, 40, 5}};
  return {first, second, third};
}

}  // namespace saccade
