#include "samples.hpp"

#include <utility>

#include "core/file.hpp"
#include "eval/report.hpp"
#include "eval/result_reader.hpp"

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

Statistics summarise(const EvalPlan& plan, const std::vector<ImageResult>& images) {
  StatisticsBuilder builder(plan);
  for (const ImageResult& image : images) builder.add(image);
  return builder.result();
}

std::vector<Example> choose_examples(const EvalPlan& plan, const std::vector<ImageResult>& images) {
  ExampleChooser chooser(plan);
  for (const ImageResult& image : images) chooser.add(image);
  return chooser.choose();
}

std::string csv_text(const EvalPlan& plan, const std::vector<ImageResult>& images) {
  std::string text = csv_head();
  for (const ImageResult& image : images) text += csv_lines(plan, image);
  return text;
}

void write_results(const std::filesystem::path& folder, const EvalPlan& plan,
                   const std::vector<ImageResult>& images, bool complete) {
  std::string text = plan_line(plan) + "\n";
  for (const ImageResult& image : images) text += image_line(image) + "\n";
  write_file(folder / kResultFile, complete ? text + end_line() + "\n" : text);
}

std::vector<ImageResult> read_all(const std::vector<ResultFile>& files) {
  std::vector<ImageResult> images;
  ResultReader reader(files);
  while (auto image = reader.next()) images.push_back(std::move(*image));
  return images;
}

}  // namespace saccade
