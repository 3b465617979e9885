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
#include "app/run_report.hpp"
#include "app/standard_output.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/folder_lock.hpp"
#include "core/text.hpp"
#include "models/model.hpp"
#include "output/dataset_writer.hpp"
#include "output/fixations_json.hpp"
#include "output/frame_writer.hpp"
#include "output/json_text.hpp"
#include "output/line_stream.hpp"
#include "output/writer_pool.hpp"
#include "pipeline/pipeline.hpp"
#include "sources/open_source.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kSlotsInFlight = 4;  // one captured, one computed, one waiting at either side
constexpr int kWriterThreads = 2;
constexpr std::size_t kRejectedListed = 10'000;  // so that hours with a bad sensor do not fill the memory

// One `saccade run`, from open source to manifest.
class Run {
 public:
  Run(const RunArguments& arguments, const Settings& settings) : folder_(arguments.out) {
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
    std::error_code code;
    has_earlier_run_ = fs::exists(folder_ / "manifest.json", code);
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
    return source;
  }

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
    if (tracks(settings, settings.selector, report_.source.sequence, report_.source.uri))
      options.tracking = settings;
    return options;
  }

  void process(std::unique_ptr<FrameSource> source, std::unique_ptr<FrameProcessor> processor) {
    const Settings& settings = report_.settings;
    const auto begin = Clock::now();
    const int writers = settings.dump.empty() ? 0 : kWriterThreads;
    LineFile fixations(folder_ / "fixations.jsonl");
    Progress progress(!settings.quiet, expected_frames(report_.source, settings));
    Pipeline pipeline(std::move(source), std::move(processor), pipeline_options(writers));
    const Interrupt::Handler handler(interrupt_, [&] {
      if (stream_) stream_->interrupt();
      pipeline.stop();
    });
    DatasetWriter dataset(folder_, report_.source);
    WriterPool writer(writers, [&](const Result& result) {
      write_frame(folder_, result, settings.dump, settings.first_level, dataset, settings.overlay);
    });
    try {
      write_results(pipeline, writer, fixations, dataset, progress);
    } catch (...) {
      end(pipeline, begin);
      throw;
    }
    end(pipeline, begin);
    report_depth_losses(dataset.losses(), report_.out);
  }

  PipelineOptions pipeline_options(int writers) {
    PipelineOptions options;
    options.frames = report_.settings;
    options.slots = kSlotsInFlight + writers;
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

  void write_results(Pipeline& pipeline, WriterPool& writer, LineFile& fixations, DatasetWriter& dataset,
                     Progress& progress) {
    const bool live = report_.source.live;
    const bool dumps_dataset = report_.settings.dump.contains("depth");
    std::function<std::string()> more;
    if (live) more = [&] { return live_text(pipeline.ledger(), pipeline.latency()); };
    bool first = true;
    while (ResultHandle result = pipeline.next()) {
      // With the first result, since a run without any reports one line, the reason, and nothing else.
      if (std::exchange(first, false)) {
        if (has_earlier_run_) remove_frame_files(folder_);  // it may have had more frames
        // The camera of a sensor that was connected late is known from its frames only.
        if (live) report_.source.intrinsics = result->frame.intrinsics;
        report_notes(report_.source, report_.settings);
      }
      const std::string line = fixations_json(*result);
      fixations.append(line);
      if (stream_) stream_->send(streamed_json(*result, line));
      report_.stages.add(result->times);
      report_.tracks.add(result->frame.index, result->attention);
      if (dumps_dataset) dataset.add(result->frame);
      writer.submit(std::move(result));
      progress.update(pipeline.ledger().processed, more);
      if (stream_ && stream_->counts().closed) pipeline.stop();  // nobody follows any more
    }
    if (stream_) stream_->finish();
    writer.finish();
    dataset.finish();
    fixations.check_in_place();
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
    report_.latency = pipeline.latency();
    std::ranges::sort(report_.rejected);
    if (report_.source.live) report_.device = pipeline.source_state();
    report_.wall_s = std::chrono::duration<double>(Clock::now() - begin).count();
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
  bool has_earlier_run_ = false;  // left its manifest in the folder
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
