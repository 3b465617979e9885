#include "app/run.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "app/command.hpp"
#include "app/export_report.hpp"
#include "app/interrupt.hpp"
#include "app/progress.hpp"
#include "app/run_output.hpp"
#include "app/run_report.hpp"
#include "app/run_resume.hpp"
#include "app/standard_output.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/folder_lock.hpp"
#include "core/text.hpp"
#include "models/model.hpp"
#include "output/frame_writer.hpp"
#include "output/json_text.hpp"
#include "output/line_stream.hpp"
#include "pipeline/pipeline.hpp"
#include "pipeline/shard.hpp"
#include "sources/open_source.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kRejectedListed = 10'000;  // so that hours with a bad sensor do not fill the memory

// One `saccade run`, from open source to manifest.
class Run {
 public:
  Run(const RunArguments& arguments, const Settings& settings)
      : folder_(arguments.out), shard_(parse_shard(arguments.shard)), resume_(arguments.resume) {
    report_.command_line = arguments.command_line;
    report_.settings = settings;
    report_.workers = worker_count(settings);
    report_.out = arguments.out;
  }

  void execute(const std::string& uri) {
    auto source = open(uri);
    open_stream();
    auto processor = make_processor(processor_options());
    make_output_folder(folder_);
    const FolderLock lock(folder_, "saccade run");
    const Interrupt::Handler until_processing(interrupt_, {});
    if (resume_ && !go_on()) return;
    std::error_code code;
    has_earlier_run_ = !earlier_ && fs::exists(folder_ / "manifest.json", code);
    write_manifest();
    try {
      process(std::move(source), std::move(processor));
      check_any_processed();
      if (stream_) report_.stream = stream_->counts();
      const bool ended_early = interrupt_.happened() || (report_.stream && report_.stream->closed);
      report_.status = ended_early ? "interrupted" : "done";
    } catch (const std::exception& error) {
      report_.status = "failed";
      report_.error = error.what();
      write_manifest_if_possible();
      throw;
    }
    write_manifest();
    report_rejected(report_);
    print_summary();
    if (resume_ && report_.status == "interrupted")
      throw Error(ExitStatus::unfinished, "interrupted", report_.out, "the same command continues it");
  }

 private:
  // Opens the source and adapts the settings to what it gives.
  std::unique_ptr<FrameSource> open(const std::string& uri) {
    Settings& settings = report_.settings;
    auto source = open_source(uri, {settings.sensor, settings});
    report_.source = source->info();
    fit_to_depth(settings, report_.source);
    fit_default_levels(settings, report_.source);
    check_model(settings, report_.source.size);
    check_dump(settings, settings.model);
    check_start(report_.source, settings.start);
    if (shard_.count > 1) choose_part();
    if (resume_) check_can_resume(report_, tracks_objects());
    return source;
  }

  bool tracks_objects() const {
    return tracks(report_.settings, report_.settings.selector, report_.source.sequence, report_.source.uri);
  }

  void choose_part() {
    const SourceInfo& source = report_.source;
    if (source.live || !source.frame_count)
      throw usage_error("the number of its frames is not known", source.uri, "process it without --shard");
    if (tracks_objects())
      throw usage_error("attention over time needs all frames in order", "--shard",
                        "take frames one by one with --tracking off, or process each sequence as a whole");
    static_cast<FrameSettings&>(report_.settings) = part_of(report_.settings, *source.frame_count, shard_);
    report_.shard = fmt::format("{}/{}", shard_.index, shard_.count);
  }

  // Continues an earlier run, if there is one; false if it is complete.
  bool go_on() {
    earlier_ = find_resume_point(folder_, report_, slots());
    if (!earlier_) return true;
    if (earlier_->complete) {
      spdlog::info("{}: the run is complete already", report_.out);
      return false;
    }
    if (earlier_->frames > 0)
      spdlog::info("{}: {} processed already", report_.out, counted(earlier_->frames, "frame"));
    report_.resumed = earlier_->frames;
    report_.rejected = earlier_->rejected;
    return true;
  }

  int slots() const { return kSlotsInFlight + RunOutput::writers(report_.settings); }

  void open_stream() {
    const Settings& settings = report_.settings;
    if (settings.stream.empty()) return;
    if (settings.stream == "-" && settings.json)
      throw usage_error("--json and --stream - both write to standard output", "--json",
                        "leave one out; manifest.json has the summary too");
    stream_ = open_line_stream(settings.stream, report_.source.live ? SlowReader::drop : SlowReader::wait);
  }

  ProcessorOptions processor_options() const {
    const Settings& settings = report_.settings;
    ProcessorOptions options{settings, settings, {}, requested_outputs(settings), report_.workers};
    if (tracks_objects()) options.tracking = settings;
    return options;
  }

  void process(std::unique_ptr<FrameSource> source, std::unique_ptr<FrameProcessor> processor) {
    const Settings& settings = report_.settings;
    const auto begin = Clock::now();
    const auto frames = frames_left(report_, earlier_);
    if (!frames) return add_earlier();
    Progress progress(!settings.quiet, expected_frames(report_.source, *frames));
    Pipeline pipeline(std::move(source), std::move(processor), pipeline_options(*frames));
    const Interrupt::Handler handler(interrupt_, [&] {
      if (stream_) stream_->interrupt();
      pipeline.stop();
    });
    RunOutput output(folder_, settings, report_.source,
                     earlier_ ? LineFile::Existing::keep : LineFile::Existing::replace, stream_.get());
    try {
      write_results(pipeline, output, progress);
    } catch (...) {
      end(pipeline, begin);
      throw;
    }
    end(pipeline, begin);
    report_depth_losses(output.losses(), report_.out);
  }

  PipelineOptions pipeline_options(const FrameSettings& frames) {
    PipelineOptions options;
    options.frames = frames;
    options.slots = slots();
    if (report_.source.live) {
      options.policy = FramePolicy::newest;
      options.on_state = report_state;
    }
    options.on_rejected = [this](std::int64_t index, const std::string& reason) { reject(index, reason); };
    options.on_incomplete = [this](std::int64_t index, const std::string& reason) {
      report_.incomplete.add(index, reason);
    };
    return options;
  }

  void write_results(Pipeline& pipeline, RunOutput& output, Progress& progress) {
    std::function<std::string()> more;
    if (report_.source.live) more = [&] { return live_text(pipeline.ledger(), pipeline.latency()); };
    bool first = true;
    while (ResultHandle result = pipeline.next()) {
      if (std::exchange(first, false)) begin_results(result->frame);
      report_.stages.add(result->times);
      report_.tracks.add(result->frame.index, result->attention);
      output.add(std::move(result));
      progress.update(pipeline.ledger().processed, more);
      if (stream_ && stream_->counts().closed) pipeline.stop();  // nobody follows any more
    }
    output.finish();
  }

  // With the first result, since a run without any reports one line, the reason, and nothing else.
  void begin_results(const Frame& frame) {
    if (has_earlier_run_) remove_frame_files(folder_);  // it may have had more frames
    // The camera of a sensor that was connected late is known from its frames only.
    if (report_.source.live) report_.source.intrinsics = frame.intrinsics;
    report_notes(report_.source, report_.settings);
  }

  // Stops and discards the last results, so that the ledger is final.
  void end(Pipeline& pipeline, Clock::time_point begin) {
    pipeline.stop();
    try {
      while (pipeline.next()) {
      }
    } catch (const std::exception&) {
      // The first error is on its way to the user already.
    }
    report_.ledger = pipeline.ledger();
    add_earlier();
    report_.latency = pipeline.latency();
    std::ranges::sort(report_.rejected);
    if (report_.source.live) report_.device = pipeline.source_state();
    report_.wall_s = std::chrono::duration<double>(Clock::now() - begin).count();
  }

  // Counts the frames of the earlier run, too.
  void add_earlier() {
    if (!earlier_) return;
    report_.ledger.captured += earlier_->positions;
    report_.ledger.processed += earlier_->frames;
    report_.ledger.rejected += earlier_->positions - earlier_->frames;
  }

  // On the threads of the pipeline; read by the others after these have ended.
  void reject(std::int64_t index, const std::string& reason) {
    const std::lock_guard lock(rejected_mutex_);
    if (report_.rejected.size() < kRejectedListed) report_.rejected.emplace_back(index, reason);
  }

  void check_any_processed() const {
    if (report_.ledger.processed == 0 && !report_.rejected.empty())
      throw unreadable(
          fmt::format("none of {} could be used; the first: {}", counted(report_.ledger.rejected, "frame"),
                      report_.rejected.front().second),
          report_.source.uri, "manifest.json lists them with their reasons");
  }

  void write_manifest() const {
    write_file(folder_ / "manifest.json", dump(manifest_json(report_), 2) + "\n");
  }

  void write_manifest_if_possible() const {
    try {
      write_manifest();
    } catch (const Error& error) {
      spdlog::debug("{}", error.what());  // most likely the disk is full, which is the error being reported
    }
  }

  void print_summary() const {
    if (report_.settings.json)
      print_json(summary_json(report_));
    else if (report_.settings.stream == "-")
      spdlog::info("{}", summary_text(report_));
    else if (!report_.settings.quiet)
      print_text(summary_text(report_) + "\n");
  }

  Interrupt interrupt_;  // before any thread is started
  fs::path folder_;
  Shard shard_;
  bool resume_;
  std::optional<ResumePoint> earlier_;  // of the run that this one continues
  bool has_earlier_run_ = false;        // another run left its manifest in the folder
  RunReport report_;
  std::unique_ptr<LineStream> stream_;  // nullptr = none
  std::mutex rejected_mutex_;           // guards report_.rejected while the pipeline runs
};

}  // namespace

void run(const RunArguments& arguments, const Settings& settings) {
  cv::setNumThreads(1);  // OpenCV must not start threads besides ours
  Run(arguments, settings).execute(arguments.source);
}

}  // namespace saccade
