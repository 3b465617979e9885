#include "app/run_command.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
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
#include "app/interrupt.hpp"
#include "app/manifest.hpp"
#include "app/options.hpp"
#include "app/progress.hpp"
#include "app/source_option.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "models/model.hpp"
#include "output/fixations_json.hpp"
#include "output/frame_writer.hpp"
#include "output/writer_pool.hpp"
#include "pipeline/pipeline.hpp"
#include "sources/open_source.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

constexpr int kSlotsInFlight = 4;  // one captured, one computed, one waiting at either side
constexpr int kWriterThreads = 2;
constexpr std::size_t kRejectedListed = 10'000;  // so that hours with a bad sensor do not fill the memory

// The number of frames to come, if that can be known.
std::optional<std::int64_t> expected_frames(const SourceInfo& source, const FrameSettings& settings) {
  if (source.frame_count) return selected_frames(settings, *source.frame_count);
  return settings.frames > 0 ? std::optional(settings.frames) : std::nullopt;
}

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
    Interrupt interrupt([this] { stop(); });
    auto source = open_source(uri, report_.settings.sensor);
    report_.source = source->info();
    fit_to_depth(report_.settings, report_.source);
    fit_default_levels(report_.settings, report_.source);
    check_model(report_.settings, report_.source.size);
    check_dump(report_.settings, report_.settings.model);
    check_start(report_.source, report_.settings.start);
    auto processor = make_processor(
        {report_.settings, report_.settings, requested_outputs(report_.settings), report_.workers});
    make_output_folder(folder_);
    write_manifest();
    try {
      process(std::move(source), std::move(processor));
      check_any_processed();
      report_.status = interrupt.happened() ? "interrupted" : "done";
    } catch (const std::exception& error) {
      report_.status = "failed";
      report_.error = error.what();
      write_manifest_if_possible();
      throw;
    }
    write_manifest();
    tell_rejected();
    tell_summary();
  }

 private:
  void process(std::unique_ptr<FrameSource> source, std::unique_ptr<FrameProcessor> processor) {
    const Settings& settings = report_.settings;
    const auto begin = std::chrono::steady_clock::now();
    const int writers = settings.dump.empty() ? 0 : kWriterThreads;
    PipelineOptions options;
    options.frames = settings;
    options.slots = kSlotsInFlight + writers;
    const bool live = report_.source.live;
    if (live) {
      options.policy = FramePolicy::newest;
      options.on_state = tell_state;
    }
    options.on_rejected = [this](std::int64_t index, const std::string& reason) { reject(index, reason); };

    LineFile fixations(folder_ / "fixations.jsonl");
    Progress progress(!settings.quiet, expected_frames(source->info(), settings));
    Pipeline pipeline(std::move(source), std::move(processor), std::move(options));
    const Watched watched(*this, pipeline);
    WriterPool writer(writers, [&](const Result& result) {
      write_frame(folder_, result, settings.dump, settings.first_level);
    });
    std::function<std::string()> more;
    if (live) more = [&] { return live_text(pipeline.ledger(), pipeline.latency()); };
    try {
      while (ResultHandle result = pipeline.next()) {
        if (!std::exchange(notes_told_, true)) {
          // Of a sensor that came late only the frames know.
          if (live) report_.source.intrinsics = result->frame.intrinsics;
          tell_notes(report_.source, report_.settings);
        }
        fixations.append(fixations_json(*result));
        report_.stages.add(result->times);
        writer.submit(std::move(result));
        progress.update(pipeline.ledger().processed, more);
      }
      writer.finish();
    } catch (...) {
      end(pipeline, begin);
      throw;
    }
    end(pipeline, begin);
  }

  // Stops and lets the last results go, so that the ledger is final.
  void end(Pipeline& pipeline, std::chrono::steady_clock::time_point begin) {
    pipeline.stop();
    try {
      while (pipeline.next()) {
      }
    } catch (const std::exception&) {
      // The first error is on its way to the user already.
    }
    report_.ledger = pipeline.ledger();
    report_.latency = pipeline.latency();
    if (report_.source.live) report_.device = pipeline.source_state();
    report_.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }

  void tell_rejected() const {
    if (report_.rejected.empty()) return;
    const auto& [index, reason] = report_.rejected.front();
    spdlog::warn("{}: {} frame{} rejected (manifest.json lists them), the first, frame {}: {}",
                 report_.source.uri, report_.ledger.rejected, report_.ledger.rejected == 1 ? "" : "s", index,
                 reason);
  }

  void check_any_processed() const {
    if (report_.ledger.processed == 0 && !report_.rejected.empty())
      throw unreadable(fmt::format("none of {} frames could be used; the first: {}", report_.ledger.rejected,
                                   report_.rejected.front().second),
                       report_.source.uri, "manifest.json lists them with their reasons");
  }

  // On the capture thread; read by the others after it has ended.
  void reject(std::int64_t index, const std::string& reason) {
    if (report_.rejected.size() < kRejectedListed) report_.rejected.emplace_back(index, reason);
  }

  void write_manifest() const {
    write_file(folder_ / "manifest.json", manifest_json(report_).dump(2) + "\n");
  }

  void write_manifest_if_possible() const {
    try {
      write_manifest();
    } catch (const Error& error) {
      spdlog::debug("{}", error.what());  // the disk is full, most likely: the error that is told already
    }
  }

  void tell_summary() const {
    if (report_.settings.json) {
      fmt::print("{}\n", summary_json(report_).dump());
    } else if (!report_.settings.quiet) {
      const Ledger& ledger = report_.ledger;
      fmt::print("{} frame{} in {:.2f} s ({:.1f}/s){}{}{}; see {}\n", ledger.processed,
                 ledger.processed == 1 ? "" : "s", report_.wall_s,
                 static_cast<double>(ledger.processed) / std::max(report_.wall_s, 1e-9),
                 report_.source.live ? ", " + live_text(ledger, report_.latency) : "",
                 ledger.rejected ? fmt::format(", {} rejected", ledger.rejected) : "",
                 report_.status == "interrupted" ? ", interrupted" : "", folder_.string());
    }
    std::fflush(stdout);
  }

  // Makes the pipeline known to stop() for as long as both live.
  struct Watched {
    Watched(Run& r, Pipeline& pipeline) : run(r) {
      const std::lock_guard lock(run.mutex_);
      run.pipeline_ = &pipeline;
      if (run.stopped_) pipeline.stop();
    }
    ~Watched() {
      const std::lock_guard lock(run.mutex_);
      run.pipeline_ = nullptr;
    }
    Watched(const Watched&) = delete;
    Watched& operator=(const Watched&) = delete;
    Run& run;
  };

  void stop() {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    if (pipeline_ != nullptr) pipeline_->stop();
  }

  fs::path folder_;
  RunReport report_;
  bool notes_told_ =
      false;  // with the first result: a run that gives none says in one line why, and nothing else
  std::mutex mutex_;
  Pipeline* pipeline_ = nullptr;  // guarded by mutex_
  bool stopped_ = false;          // guarded by mutex_
};

}  // namespace

void run(const RunArguments& arguments, const Settings& settings) {
  cv::setNumThreads(1);  // the threads are ours to count
  Run(arguments, settings).execute(arguments.source);
}

void add_run_command(CLI::App& app, std::function<void()>& action, std::vector<std::string> command_line) {
  CLI::App& command =
      *app.add_subcommand("run", "process a source without a window; write maps, overlays, fixations");
  const auto arguments = std::make_shared<RunArguments>();
  arguments->command_line = std::move(command_line);
  add_source_option(command, "SOURCE", arguments->source, "what to process; see the end of this help")
      ->required();
  command.add_option("--out", arguments->out, "folder to write to, made if it is not there")
      ->required()
      ->type_name("DIR");
  const auto options = std::make_shared<SettingsOptions>(
      command, AcceptedSettings{{SettingScope::model, SettingScope::attention, SettingScope::frames,
                                 SettingScope::sensor, SettingScope::output, SettingScope::program}});
  command.callback([arguments, options, &action] {
    action = [arguments, options] {
      const Settings settings = options->resolve();
      set_log_level(settings);
      run(*arguments, settings);
    };
  });
}

}  // namespace saccade
