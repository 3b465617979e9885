#include "app/eval_command.hpp"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <nlohmann/json.hpp>

#include "app/command.hpp"
#include "app/interrupt.hpp"
#include "app/options.hpp"
#include "app/progress.hpp"
#include "app/source_option.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/png.hpp"
#include "eval/contact_sheet.hpp"
#include "eval/figure.hpp"
#include "eval/page.hpp"
#include "eval/report.hpp"
#include "eval/result_file.hpp"
#include "pipeline/processor.hpp"
#include "sources/open_source.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

constexpr double kPictureScale = 2;  // pixels of hr.png per px of hr.svg

Error interrupted(const fs::path& folder) {
  return failed("interrupted", folder.string(), "the same command goes on from here");
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
  plan.points = arguments.points;
  plan.positions = count_frames(source, settings);
  parse_lists(plan, arguments.models, arguments.kernels, arguments.selectors);
  parse_shard(plan, arguments.shard);
  if (plan.shard > plan.positions)
    throw usage_error(fmt::format("shard {} holds no frame", plan.shard), source.uri,
                      fmt::format("{} frames are selected: use as many shards or fewer", plan.positions));
  for (Settings of_model = plan.settings; const std::string& model : plan.models) {
    of_model.model = model;
    check_model(of_model, source.size);
  }
  return plan;
}

void check_any_evaluated(const StoredResults& results) {
  for (const ImageResult& image : results.images)
    if (!image.left_out) return;
  throw unreadable(fmt::format("none of {} images could be evaluated; the first: {}", results.images.size(),
                               results.images.empty() ? "-" : results.images.front().left_out.value()),
                   results.plan.dataset, "each needs a label image of the size of its depth");
}

void warn_left_out(const ImageResult& image) {
  if (image.left_out)
    spdlog::warn("frame {}{} left out: {}", image.frame, image.name.empty() ? "" : " (" + image.name + ")",
                 *image.left_out);
}

// Evaluates what is missing of a plan, as many images at once as there are workers, each on one thread.
class Evaluation {
 public:
  Evaluation(const EvalPlan& plan, FrameSource& source, WorkerPool& pool)
      : plan_(plan), source_(source), pool_(pool), frames_(static_cast<std::size_t>(pool.workers())) {
    for (int i = 0; i < pool.workers(); ++i) {
      lane_pools_.push_back(std::make_unique<WorkerPool>(1));
      lanes_.push_back(std::make_unique<Evaluator>(plan, *lane_pools_.back()));
    }
  }

  // Appends to `results` and to the file. False if `stop` ended it early.
  bool run(StoredResults& results, LineFile& file, Progress& progress, const std::atomic<bool>& stop) {
    std::set<std::int64_t> known;
    for (const ImageResult& image : results.images) known.insert(image.frame);
    std::int64_t done = 0;
    for (std::int64_t p = plan_.shard - 1; p < plan_.positions;) {
      if (stop) return false;
      std::vector<ImageResult> batch;
      std::vector<std::size_t> readable;  // of the batch; its k-th is in frames_[k]
      for (; p < plan_.positions && readable.size() < lanes_.size(); p += plan_.shards) {
        if (known.contains(plan_.frame_at(p))) continue;
        batch.emplace_back();
        if (read(plan_.frame_at(p), frames_[readable.size()], batch.back()))
          readable.push_back(batch.size() - 1);
      }
      pool_.for_each(static_cast<int>(readable.size()), [&](int k, int lane) {
        const auto i = static_cast<std::size_t>(k);
        batch[readable[i]] = lanes_[static_cast<std::size_t>(lane)]->evaluate(frames_[i]);
      });
      for (ImageResult& image : batch) {
        warn_left_out(image);
        file.append(image_line(image));
        results.images.push_back(std::move(image));
        progress.update(++done);
      }
    }
    return true;
  }

 private:
  // False if the frame cannot be used; `result` then says why.
  bool read(std::int64_t index, Frame& frame, ImageResult& result) {
    result.frame = index;
    source_.seek(index);
    const ReadResult read = source_.read(frame, std::chrono::seconds(1));
    if (plan_.settings.intrinsics) frame.intrinsics = *plan_.settings.intrinsics;
    if (read.status == ReadStatus::frame) return true;
    result.name = read.status == ReadStatus::rejected ? frame.name : "";
    result.left_out = read.reason.empty() ? "the data set ends before it" : read.reason;
    return false;
  }

  const EvalPlan& plan_;
  FrameSource& source_;
  WorkerPool& pool_;
  std::vector<Frame> frames_;
  std::vector<std::unique_ptr<WorkerPool>> lane_pools_;
  std::vector<std::unique_ptr<Evaluator>> lanes_;
};

nlohmann::ordered_json summary_json(const StoredResults& results, const Statistics& statistics,
                                    const std::string& out) {
  auto json = report_json(results.plan, results.images, statistics);
  for (const char* key : {"parameters", "interval", "differences", "cross_validation"}) json.erase(key);
  json["out"] = out;
  return json;
}

// Writes all files of a complete evaluation. `source` may be null: then there are no examples.
void write_report(const StoredResults& results, FrameSource* source, const fs::path& out,
                  const Settings& settings, WorkerPool& pool, const std::atomic<bool>& stop) {
  check_any_evaluated(results);
  const EvalPlan& plan = results.plan;
  const Statistics statistics = summarise(plan, results.images);
  write_file(out / "hr.csv", csv_text(plan, results.images));
  const Drawing drawing = draw_hit_ratios(plan, statistics);
  const std::string svg = to_svg(drawing);
  write_file(out / "hr.svg", svg);
  write_file(out / "hr.png", encode_png(to_picture(drawing, kPictureScale)));
  std::vector<Example> examples;
  if (source != nullptr) examples = choose_examples(plan, results.images);
  if (source != nullptr) write_examples(examples, plan, *source, pool, out, [&] { return stop.load(); });
  if (stop) throw interrupted(out);
  write_file(out / "index.html", page_html(plan, results.images, statistics, svg, examples));
  write_file(out / "report.json", dump(report_json(plan, results.images, statistics), 2) + "\n");
  if (settings.json)
    fmt::print("{}\n", dump(summary_json(results, statistics, out.string())));
  else if (!settings.quiet)
    fmt::print("{}{} images; see {}\n", report_text(plan, statistics), statistics.images,
               (out / "index.html").string());
  if (std::fflush(stdout) != 0) throw failed("cannot write", "standard output", "is the disk full?");
}

}  // namespace

void eval(const EvalArguments& arguments, const Settings& settings) {
  cv::setNumThreads(1);  // the threads are ours to count
  std::atomic<bool> stop = false;
  const Interrupt interrupt([&] { stop = true; });
  const auto source = open_source(arguments.dataset);
  SourceInfo info = source->info();
  Settings fitting = settings;
  fit_default_levels(fitting, info);
  tell_notes(info, fitting);
  const EvalPlan plan = make_plan(arguments, fitting, info);
  WorkerPool pool(worker_count(settings));
  Evaluation evaluation(plan, *source, pool);
  const fs::path out = arguments.out;
  make_output_folder(out);
  StoredResults results = resume_results(out, plan);
  const auto before = static_cast<std::int64_t>(results.images.size());
  if (before > 0) spdlog::info("{}: {} images are there already", out.string(), before);
  if (!results.complete) {
    LineFile file(out / kResultFile, LineFile::Existing::keep);
    const std::int64_t of_shard = (plan.positions - plan.shard) / plan.shards + 1;
    Progress progress(!settings.quiet, of_shard - before);
    if (!evaluation.run(results, file, progress, stop)) throw interrupted(out);
    file.append(end_line());
    results.complete = true;
  }
  std::sort(results.images.begin(), results.images.end(),
            [](const auto& a, const auto& b) { return a.frame < b.frame; });
  write_report(results, source.get(), out, settings, pool, stop);
}

void eval_merge(const EvalArguments& arguments, const Settings& settings) {
  cv::setNumThreads(1);
  std::atomic<bool> stop = false;
  const Interrupt interrupt([&] { stop = true; });
  const StoredResults results = merge_results({arguments.merge.begin(), arguments.merge.end()});
  std::unique_ptr<FrameSource> source;
  try {
    source = open_source(results.plan.dataset);
  } catch (const Error& error) {
    spdlog::warn("no pictures of examples: {}", error.what());
  }
  const fs::path out = arguments.out;
  make_output_folder(out);
  write_results(out, results);
  WorkerPool pool(worker_count(settings));
  write_report(results, source.get(), out, settings, pool, stop);
}

void add_eval_command(CLI::App& app, std::function<void()>& action) {
  struct State {
    explicit State(CLI::App& command)
        : options(command, {{SettingScope::model, SettingScope::attention, SettingScope::frames,
                             SettingScope::program},
                            {"json"},
                            {kPlanKeys.begin(), kPlanKeys.end()}}) {}
    EvalArguments arguments;
    SettingsOptions options;
  };
  CLI::App& command =
      *app.add_subcommand("eval", "Hit Ratio of models, kernels and selectors on labelled images");
  const auto state = std::make_shared<State>(command);
  EvalArguments& a = state->arguments;
  auto* dataset = add_source_option(command, "DATASET", a.dataset,
                                    "a source whose images have labels; see the end of this help");
  command.add_option("--out", a.out, "folder to write to, made if it is not there")
      ->required()
      ->type_name("DIR");
  command.add_option("--models", a.models, "models to compare [that of the settings]")->type_name("LIST");
  command.add_option("--kernels", a.kernels, "kernel sizes in px [that of the settings]")->type_name("LIST");
  command.add_option("--selectors", a.selectors, "proto, wta [that of the settings]")->type_name("LIST");
  command.add_option("--points", a.points, "attention points per image, 1..1000 [30]")
      ->type_name("N")
      ->check(CLI::Range(1, kMostPoints));
  command.add_option("--shard", a.shard, "evaluate only each n-th image, from the i-th; merge afterwards")
      ->type_name("i/n");
  command.add_option("--merge", a.merge, "folders of all shards, instead of DATASET")
      ->type_name("DIR...")
      ->excludes(dataset);
  command.callback([state, &action] {
    action = [state] {
      const Settings settings = state->options.resolve();
      set_log_level(settings);
      if (!state->arguments.merge.empty())
        eval_merge(state->arguments, settings);
      else if (!state->arguments.dataset.empty())
        eval(state->arguments, settings);
      else
        throw usage_error("no data set", "eval", "name a DATASET, or the folders of shards with --merge");
    };
  });
}

}  // namespace saccade
