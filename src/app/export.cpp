#include "app/export.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
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
#include "app/standard_output.hpp"
#include "core/error.hpp"
#include "core/folder_lock.hpp"
#include "core/text.hpp"
#include "output/frame_exporter.hpp"
#include "output/writer_pool.hpp"
#include "pipeline/pipeline.hpp"
#include "sources/open_source.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kWriterThreads = 2;

const ExportFormat& find_format(const std::string& name) {
  const auto formats = export_formats();
  const auto format = std::ranges::find(formats, name, &ExportFormat::name);
  if (format != formats.end()) return *format;
  std::string known;
  for (const ExportFormat& each : formats) known += fmt::format("{}{}", known.empty() ? "" : ", ", each.name);
  throw usage_error("unknown format", "--format " + name, "choose one of " + known);
}

// Frames pass as they are.
class NoProcessing final : public FrameProcessor {
 public:
  void process(Result&) override {}
};

// Frames of another export would mix with the new ones.
void check_empty(const fs::path& folder, bool force) {
  std::error_code code;
  if (!force && fs::exists(folder, code) && fs::is_directory(folder, code) && !fs::is_empty(folder, code))
    throw usage_error("the folder is not empty", folder.string(), "choose another --out, or add --force");
}

// One `saccade export`, from open source to complete files.
class Export {
 public:
  Export(const ExportArguments& arguments, const Settings& settings)
      : arguments_(arguments), settings_(settings) {}

  void execute() {
    const ExportFormat& format = find_format(arguments_.format);
    auto source = open_source(arguments_.source, {settings_.sensor, settings_});
    report_.source = source->info();
    const SourceInfo& info = report_.source;
    check_start(info, settings_.start);
    if (!info.has_depth)
      throw usage_error("there is no depth to export", info.uri, "ffmpeg converts videos of colour");
    check_empty(arguments_.out, arguments_.force);
    make_output_folder(arguments_.out);
    const FolderLock lock(arguments_.out, "saccade export");
    report_.out = arguments_.out;
    report_.format = format.name;
    const auto exporter = format.make(arguments_.out, info);
    copy(std::move(source), *exporter);
    report_.interrupted = interrupt_.happened();
    report_.losses = exporter->losses();
    check_any_written();
    report_losses(report_);
    if (settings_.json)
      print_json(export_json(report_));
    else if (!settings_.quiet)
      print_text(export_text(report_) + "\n");
  }

 private:
  void copy(std::unique_ptr<FrameSource> source, FrameExporter& exporter) {
    const auto begin = Clock::now();
    Progress progress(!settings_.quiet, expected_frames(report_.source, settings_));
    Pipeline pipeline(std::move(source), std::make_unique<NoProcessing>(), pipeline_options());
    const Interrupt::Handler handler(interrupt_, [&] { pipeline.stop(); });
    std::exception_ptr error;
    const auto attempt = [&](auto work) {
      try {
        work();
      } catch (...) {
        if (!error) error = std::current_exception();
      }
    };
    {
      WriterPool writer(kWriterThreads, [&](const Result& result) { exporter.write(result.frame); });
      attempt([&] { take_frames(pipeline, writer, exporter, progress); });
    }
    attempt([&] { exporter.finish(); });  // also after an error: the frames before it are complete
    if (error) std::rethrow_exception(error);
    report_.ledger = pipeline.ledger();
    report_.wall_s = std::chrono::duration<double>(Clock::now() - begin).count();
  }

  void take_frames(Pipeline& pipeline, WriterPool& writer, FrameExporter& exporter, Progress& progress) {
    bool first = true;
    while (ResultHandle result = pipeline.next()) {
      // With the first frame, since an export without any reports one line, the reason, and nothing else.
      if (std::exchange(first, false)) report_notes(report_.source, settings_);
      exporter.add(result->frame);
      writer.submit(std::move(result));
      progress.update(pipeline.ledger().processed);
    }
    writer.finish();
  }

  PipelineOptions pipeline_options() {
    PipelineOptions options;
    options.frames = settings_;
    options.slots = kSlotsInFlight + kWriterThreads;
    if (report_.source.live) {
      options.policy = FramePolicy::newest;
      options.on_state = report_state;
    }
    options.on_rejected = [this](std::int64_t index, const std::string& reason) {
      report_.rejected.add(index, reason);
    };
    options.on_incomplete = [this](std::int64_t index, const std::string& reason) {
      report_.incomplete.add(index, reason);
    };
    return options;
  }

  void check_any_written() const {
    if (report_.ledger.processed == 0 && report_.ledger.rejected > 0)
      throw unreadable(fmt::format("none of {} could be used; the first, {}",
                                   counted(report_.ledger.rejected, "frame"), report_.rejected.first()),
                       report_.source.uri, "is it the right file?");
  }

  Interrupt interrupt_;  // before any thread is started
  const ExportArguments& arguments_;
  const Settings& settings_;
  ExportReport report_;
};

}  // namespace

void export_frames(const ExportArguments& arguments, const Settings& settings) {
  cv::setNumThreads(1);  // OpenCV must not start threads besides ours
  Export(arguments, settings).execute();
}

}  // namespace saccade
