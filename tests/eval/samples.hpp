#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "eval/contact_sheet.hpp"
#include "eval/evaluator.hpp"
#include "eval/plan.hpp"
#include "eval/result_file.hpp"
#include "eval/statistics.hpp"

namespace saccade {

/// A plan of one model with kernels 10 and 15, both selectors and 3 points, on 3 frames.
EvalPlan sample_plan();

/// Hand-made results of it: frame 0 with two objects, frame 1 left out, frame 2, "a,\"b\"", with one.
std::vector<ImageResult> sample_images();

// The builders' results for images in a list.
Statistics summarise(const EvalPlan& plan, const std::vector<ImageResult>& images);
std::vector<Example> choose_examples(const EvalPlan& plan, const std::vector<ImageResult>& images);
std::string csv_text(const EvalPlan& plan, const std::vector<ImageResult>& images);

/// A results.jsonl of the images in this order, with an end if it is `complete`.
void write_results(const std::filesystem::path& folder, const EvalPlan& plan,
                   const std::vector<ImageResult>& images, bool complete = true);

/// All images of files.
std::vector<ImageResult> read_all(const std::vector<ResultFile>& files);

}  // namespace saccade
