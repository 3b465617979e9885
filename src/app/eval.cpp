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
#include "core/file_writer.hpp"
#include "core/folder_lock.hpp"
#include "core/png.hpp"
#include "core/text.hpp"
#include "eval/contact_sheet.hpp"
#include "eval/data_set_content.hpp"
#include "eval/figure.hpp"
#include "eval/merge.hpp"
#include "eval/page.hpp"
#include "eval/reliability_figure.hpp"
#include "eval/report.hpp"
#include "eval/result_file.hpp"
#include "eval/result_reader.hpp"
#include "output/json_text.hpp"
#include "pipeline/processor.hpp"
#include "sources/open_source.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

Error interrupted(const fs::path& folder) {
  return Error(ExitStatus::unfinished, "interrupted", folder.string(), "the same command continues it");
}

// The number of frames to evaluate.
std::int64_t count_frames(const SourceInfo& source, const FrameSettings& settings) {
  if (source.live || !source.frame_count)
    throw usage_error("not a data set", source.uri,
                      "images with labels are needed; saccade export makes a folder of a video");
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

// The results of all images; the images themselves are not kept.
struct Findings {
  Statistics statistics;
  std::vector<Example> examples;
};

Error none_evaluated(const EvalPlan& plan, std::size_t images, const std::string& reason) {
  return unreadable(fmt::format("none of {} could be evaluated; the first: {}", counted(images, "image"),
                                images == 0 ? "-" : reason),
                    plan.dataset, "each needs a label image of the size of its depth");
}

// Also writes hr.csv.
Findings summarise(const EvalPlan& plan, const std::vector<ResultFile>& files, const fs::path& out,
                   const Interrupt& interrupt) {
  StatisticsBuilder statistics(plan);
  ExampleChooser examples(plan);
  FileWriter csv(out / "hr.csv");
  csv.write(csv_head());
  std::size_t evaluated = 0, images = 0;
  std::string reason;  // of the first image that is left out
  ResultReader reader(files);
  while (const auto image = reader.next()) {
    if (interrupt.happened()) throw interrupted(out);
    ++images;
    evaluated += !image->left_out;
    if (image->left_out && reason.empty()) reason = *image->left_out;
    statistics.add(*image);
    examples.add(*image);
    csv.write(csv_lines(plan, *image));
  }
  if (evaluated == 0) throw none_evaluated(plan, images, reason);
  csv.finish();
  return {statistics.result(), examples.choose()};
}

nlohmann::ordered_json summary_json(const EvalPlan& plan, const Statistics& statistics,
                                    const std::string& out) {
  auto json = report_json(plan, statistics);
  for (const char* key : {"parameters", "interval", "differences", "cross_validation"}) json.erase(key);
  json["out"] = out;
  return json;
}

// Writes all files of an evaluation whose results are in `files`. `source` may be null: then there are no
// examples.
void write_report(const EvalPlan& plan, const std::vector<ResultFile>& files, FrameSource* source,
                  const fs::path& out, const Settings& settings, WorkerPool& pool,
                  const Interrupt& interrupt) {
  const auto [statistics, chosen] = summarise(plan, files, out, interrupt);
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
  const std::vector<Example> examples = source != nullptr ? chosen : std::vector<Example>{};
  if (source != nullptr)
    write_examples(examples, plan, *source, pool, out, [&] { return interrupt.happened(); });
  if (interrupt.happened()) throw interrupted(out);
  write_file(out / "index.html", page_html(plan, statistics, {svg, reliability_svg}, examples));
  write_file(out / "report.json", dump(report_json(plan, statistics), 2) + "\n");
  if (settings.json)
    print_json(summary_json(plan, statistics, out.string()));
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
  EvalPlan plan = make_plan(arguments, fitting, info);
  WorkerPool pool(worker_count(settings));
  Evaluation evaluation(plan, *source, pool);
  plan.content = data_set_content(*source, plan);
  const fs::path out = arguments.out;
  make_output_folder(out);
  const FolderLock lock(out, "saccade eval");
  const Interrupt::Handler handler(interrupt, {});
  const ResumedResults before = resume_results(out, plan);
  if (before.images > 0)
    spdlog::info("{}: {} evaluated already", out.string(), counted(before.images, "image"));
  if (!before.complete) {
    LineFile file(out / kResultFile, LineFile::Existing::keep);
    Progress progress(!settings.quiet, plan.positions_of_shard() - before.images);
    // Notes come with the first image, since an evaluation without any reports one line, the reason.
    const auto begin = [&] { report_notes(info, fitting); };
    if (!evaluation.run(before.known, file, progress, interrupt, begin)) throw interrupted(out);
    file.append(end_line());
  }
  write_report(plan, {scan_results(out)}, source.get(), out, settings, pool, interrupt);
}

void eval_merge(const EvalArguments& arguments, const Settings& settings) {
  cv::setNumThreads(1);
  Interrupt interrupt;
  const ShardedResults results =
      find_shards({arguments.merge.begin(), arguments.merge.end()}, arguments.partial);
  const auto source = open_data_set(results.plan.dataset, results.plan.settings);
  const fs::path out = arguments.out;
  make_output_folder(out);
  const FolderLock lock(out, "saccade eval --merge");
  const Interrupt::Handler handler(interrupt, {});
  const ResultFile merged = write_merged(out, results);
  WorkerPool pool(worker_count(settings));
  write_report(results.plan, {merged}, source.get(), out, settings, pool, interrupt);
}

}  // namespace saccade
