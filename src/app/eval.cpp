#include "app/eval.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <nlohmann/json.hpp>

#include "app/command.hpp"
#include "app/evaluation.hpp"
#include "app/interrupt.hpp"
#include "app/progress.hpp"
#include "app/standard_output.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/folder_lock.hpp"
#include "core/png.hpp"
#include "core/text.hpp"
#include "eval/contact_sheet.hpp"
#include "eval/figure.hpp"
#include "eval/page.hpp"
#include "eval/reliability_figure.hpp"
#include "eval/report.hpp"
#include "eval/result_file.hpp"
#include "output/json_text.hpp"
#include "pipeline/processor.hpp"
#include "sources/open_source.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

constexpr double kPictureScale = 2;  // pixels of hr.png per px of hr.svg

Error interrupted(const fs::path& folder) {
  return failed("interrupted", folder.string(), "the same command continues it");
}

// The number of frames to evaluate.
std::int64_t count_frames(const SourceInfo& source, const FrameSettings& settings) {
  if (source.live || !source.frame_count)
    throw usage_error("not a data set", source.uri, "images with labels are needed, not a live sensor");
  check_start(source, settings.start);
  return selected_frames(settings, *source.frame_count);
}

EvalPlan make_plan(const EvalArguments& arguments, const Settings& settings, const SourceInfo& source) {
  EvalPlan plan;
  plan.dataset = arguments.dataset;
  plan.settings = settings;
  constexpr int kUsualPoints = 30;
  plan.points = arguments.points.value_or(kUsualPoints);
  plan.positions = count_frames(source, settings);
  parse_lists(plan, arguments.models, arguments.kernels, arguments.selectors);
  parse_shard(plan, arguments.shard);
  if (plan.shard > plan.positions)
    throw usage_error(
        fmt::format("shard {} holds no frame", plan.shard), source.uri,
        fmt::format("{} selected: use as many shards or fewer", counted(plan.positions, "frame")));
  for (Settings of_model = plan.settings; const std::string& model : plan.models) {
    of_model.model = model;
    check_model(of_model, source.size);
  }
  return plan;
}

void check_any_evaluated(const StoredResults& results) {
  for (const ImageResult& image : results.images)
    if (!image.left_out) return;
  throw unreadable(
      fmt::format("none of {} could be evaluated; the first: {}", counted(results.images.size(), "image"),
                  results.images.empty() ? "-" : results.images.front().left_out.value()),
      results.plan.dataset, "each needs a label image of the size of its depth");
}

nlohmann::ordered_json summary_json(const StoredResults& results, const Statistics& statistics,
                                    const std::string& out) {
  auto json = report_json(results.plan, results.images, statistics);
  for (const char* key : {"parameters", "interval", "differences", "cross_validation"}) json.erase(key);
  json["out"] = out;
  return json;
}

// Writes all files of a complete evaluation. `source` may be null: then there are no examples.
void write_report(const StoredResults& results, FrameSource* source, const fs::path& out,
                  const Settings& settings, WorkerPool& pool, const Interrupt& interrupt) {
  check_any_evaluated(results);
  const EvalPlan& plan = results.plan;
  const Statistics statistics = summarise(plan, results.images);
  write_file(out / "hr.csv", csv_text(plan, results.images));
  const Drawing drawing = draw_hit_ratios(plan, statistics);
  const std::string svg = to_svg(drawing);
  write_file(out / "hr.svg", svg);
  write_file(out / "hr.png", encode_png(to_picture(drawing, kPictureScale)));
  std::string reliability_svg;
  if (const auto reliability = draw_reliability(plan, statistics)) {
    reliability_svg = to_svg(*reliability);
    write_file(out / "reliability.svg", reliability_svg);
    write_file(out / "reliability.png", encode_png(to_picture(*reliability, kPictureScale)));
  }
  std::vector<Example> examples;
  if (source != nullptr) examples = choose_examples(plan, results.images);
  if (source != nullptr)
    write_examples(examples, plan, *source, pool, out, [&] { return interrupt.happened(); });
  if (interrupt.happened()) throw interrupted(out);
  write_file(out / "index.html",
             page_html(plan, results.images, statistics, {svg, reliability_svg}, examples));
  write_file(out / "report.json", dump(report_json(plan, results.images, statistics), 2) + "\n");
  if (settings.json)
    print_json(summary_json(results, statistics, out.string()));
  else if (!settings.quiet)
    print_text(fmt::format("{}{}; see {}\n", report_text(plan, statistics),
                           counted(statistics.images, "image"), (out / "index.html").string()));
}

// The data set that results name, for the examples; nullptr, with a warning, if it cannot be opened. The
// results may be those of somebody else: no device is opened.
std::unique_ptr<FrameSource> open_data_set(const std::string& uri, const InputSettings& settings) {
  try {
    if (names_device(uri)) throw unreadable("it is a device", uri, "");
    return open_source(uri, {{}, settings});
  } catch (const Error& error) {
    spdlog::warn("no pictures of examples: {}", error.what());
    return nullptr;
  }
}

}  // namespace

void eval(const EvalArguments& arguments, const Settings& settings) {
  cv::setNumThreads(1);  // OpenCV must not start threads besides ours
  Interrupt interrupt;
  const auto source = open_source(arguments.dataset, {settings.sensor, settings});
  SourceInfo info = source->info();
  Settings fitting = settings;
  fit_default_levels(fitting, info);
  report_notes(info, fitting);
  const EvalPlan plan = make_plan(arguments, fitting, info);
  WorkerPool pool(worker_count(settings));
  Evaluation evaluation(plan, *source, pool);
  const fs::path out = arguments.out;
  make_output_folder(out);
  const FolderLock lock(out, "saccade eval");
  const Interrupt::Handler handler(interrupt, {});
  StoredResults results = resume_results(out, plan);
  const auto before = static_cast<std::int64_t>(results.images.size());
  if (before > 0) spdlog::info("{}: {} evaluated already", out.string(), counted(before, "image"));
  if (!results.complete) {
    LineFile file(out / kResultFile, LineFile::Existing::keep);
    const std::int64_t of_shard = (plan.positions - plan.shard) / plan.shards + 1;
    Progress progress(!settings.quiet, of_shard - before);
    if (!evaluation.run(results, file, progress, interrupt)) throw interrupted(out);
    file.append(end_line());
    results.complete = true;
  }
  std::sort(results.images.begin(), results.images.end(),
            [](const auto& a, const auto& b) { return a.frame < b.frame; });
  write_report(results, source.get(), out, settings, pool, interrupt);
}

void eval_merge(const EvalArguments& arguments, const Settings& settings) {
  cv::setNumThreads(1);
  Interrupt interrupt;
  const StoredResults results = merge_results({arguments.merge.begin(), arguments.merge.end()});
  const auto source = open_data_set(results.plan.dataset, results.plan.settings);
  const fs::path out = arguments.out;
  make_output_folder(out);
  const FolderLock lock(out, "saccade eval --merge");
  const Interrupt::Handler handler(interrupt, {});
  write_results(out, results);
  WorkerPool pool(worker_count(settings));
  write_report(results, source.get(), out, settings, pool, interrupt);
}

}  // namespace saccade
