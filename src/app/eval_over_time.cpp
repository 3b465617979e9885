#include "app/eval_over_time.hpp"

#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/command.hpp"
#include "app/interrupt.hpp"
#include "app/progress.hpp"
#include "app/standard_output.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/folder_lock.hpp"
#include "core/png.hpp"
#include "core/text.hpp"
#include "eval/plan.hpp"
#include "eval/sequence_evaluation.hpp"
#include "models/model.hpp"
#include "output/json_text.hpp"
#include "sources/open_source.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

std::vector<std::string> models_of(const EvalArguments& arguments, const Settings& settings,
                                   const SourceInfo& source) {
  EvalPlan plan;
  plan.settings = settings;
  parse_lists(plan, arguments.models, "", "");
  for (Settings of_model = settings; const std::string& model : plan.models) {
    of_model.model = model;
    check_model(of_model, source.size);
  }
  return plan.models;
}

void write_results(const fs::path& out, const EvalArguments& arguments, const Settings& settings,
                   const std::vector<SequenceResult>& results) {
  const nlohmann::ordered_json json = {{"dataset", arguments.dataset}, {"models", over_time_json(results)}};
  write_file(out / "over_time.json", dump(json, 2) + "\n");
  const Drawing drawing = draw_over_time(results);
  write_file(out / "over_time.svg", to_svg(drawing));
  write_file(out / "over_time.png", encode_png(to_picture(drawing, kPictureScale)));
  if (settings.json)
    print_json(json);
  else if (!settings.quiet)
    print_text(fmt::format("{}{}; see {}\n", over_time_text(results),
                           counted(results.front().frames, "frame"), out.string()));
}

}  // namespace

void eval_over_time(const EvalArguments& arguments, const Settings& settings) {
  cv::setNumThreads(1);  // the threads are ours to count
  Interrupt interrupt;
  const auto source = open_source(arguments.dataset, {settings.sensor, settings});
  SourceInfo info = source->info();
  if (info.live || !info.frame_count)
    throw usage_error("not a data set", info.uri,
                      "a recorded or synthetic sequence is needed; saccade export makes a folder of a video");
  check_start(info, settings.start);
  Settings of_model = settings;
  constexpr int kUsualPoints = 10;
  of_model.min_confidence = 0;  // as for the Hit Ratio, every point counts
  of_model.fixations = arguments.points.value_or(kUsualPoints);
  fit_default_levels(of_model, info);
  report_notes(info, of_model);
  const std::vector<std::string> models = models_of(arguments, of_model, info);
  const fs::path out = arguments.out;
  make_output_folder(out);
  const FolderLock lock(out, "saccade eval --over-time");
  const Interrupt::Handler handler(interrupt, {});
  WorkerPool pool(worker_count(settings));
  const std::int64_t frames = selected_frames(settings, *info.frame_count);
  Progress progress(!settings.quiet, frames * static_cast<std::int64_t>(models.size()));
  std::vector<SequenceResult> results;
  for (const std::string& model : models) {
    of_model.model = model;
    const std::int64_t before = frames * static_cast<std::int64_t>(results.size());
    results.push_back(watch_sequence(*source, of_model, pool, [&](std::int64_t done) {
      progress.update(before + done);
      return !interrupt.happened();
    }));
    if (interrupt.happened())
      throw failed("interrupted", out.string(), "an evaluation over time begins again from the first frame");
  }
  write_results(out, arguments, settings, results);
}

}  // namespace saccade
