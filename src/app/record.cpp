#include "app/record.hpp"

#include <chrono>
#include <exception>
#include <filesystem>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "app/command.hpp"
#include "app/interrupt.hpp"
#include "app/progress.hpp"
#include "app/record_report.hpp"
#include "app/standard_output.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/text.hpp"
#include "oni/recorder.hpp"
#include "pipeline/source_state_notifier.hpp"
#include "sources/open_source.hpp"
#include "sources/source_kind.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kQueueFrames = 30;  // a second of a camera, for when the disk is busy
constexpr std::chrono::milliseconds kReadTimeout{500};

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

// What the progress line says besides the number of frames.
std::string disk_text(const OniRecorder& recorder, const fs::path& file) {
  const OniWriterCounts counts = recorder.counts();
  std::error_code code;
  const auto space = fs::space(file.parent_path() / ".", code);
  return fmt::format("{}{}, {} dropped{}", megabytes(static_cast<double>(recorder.size_bytes())),
                     code ? "" : fmt::format(" ({} free)", megabytes(static_cast<double>(space.available))),
                     counts.dropped,
                     counts.unsynced > 1 ? fmt::format(", slow disk: {} unsynced", counts.unsynced) : "");
}

// One `saccade record`, from open source to closed file.
class RecordRun {
 public:
  RecordRun(const RecordArguments& arguments, const Settings& settings)
      : arguments_(arguments), settings_(settings) {
    report_.source = arguments.source;
    report_.file = arguments.file;
  }

  void execute() {
    check_file();
    const auto source = open_source(arguments_.source, {settings_.sensor, settings_});
    const SourceInfo& info = source->info();
    check_start(info, settings_.start);
    live_ = info.live;
    const Interrupt::Handler handler(interrupt_, [&] { source->interrupt(); });
    OniWriter writer(arguments_.file, writer_options(info));
    begin_ = Clock::now();
    {
      OniRecorder recorder(writer, kQueueFrames);
      Progress progress(!settings_.quiet, std::nullopt);
      take_frames(*source, recorder, progress);
      check_any_taken();
      recorder.finish();
      report_.counts = recorder.counts();
      if (live_) report_.device = source->state();
    }
    report_.interrupted = interrupt_.happened();
    report_.bytes = writer.size_bytes();
    report_.wall_s = seconds_since(begin_);
    report_losses(report_);
    print_summary();
  }

 private:
  // Another ending would not be found by what reads recordings.
  void check_file() const {
    if (ending_of(arguments_.file) != ".oni")
      throw usage_error("recordings are .oni files", arguments_.file, "name a file that ends in .oni");
    std::error_code code;
    if (fs::equivalent(arguments_.source, arguments_.file, code))
      throw usage_error("a recording cannot replace its own source", arguments_.file, "choose another name");
  }

  OniWriterOptions writer_options(const SourceInfo& info) const {
    OniWriterOptions options = arguments_.options;
    options.rate_hz = info.rate_hz;
    options.expect_colour = options.expect_colour || info.live;
    return options;
  }

  // If the source fails, the file is closed with the frames that came before.
  void take_frames(FrameSource& source, OniRecorder& recorder, Progress& progress) {
    try {
      copy_frames(source, recorder, progress);
    } catch (...) {
      const std::exception_ptr error = std::current_exception();
      progress.clear();
      try {
        recorder.finish();
        const auto frames = recorder.counts().frames;
        spdlog::warn("{}: closed with the {} that came before", arguments_.file, counted(frames, "frame"));
      } catch (const std::exception& second) {
        spdlog::debug("{}", second.what());  // the first error is the one that matters
      }
      std::rethrow_exception(error);
    }
    progress.clear();
  }

  void copy_frames(FrameSource& source, OniRecorder& recorder, Progress& progress) {
    SourceStateNotifier notifier(source, [&](const SourceState& state) {
      progress.clear();
      report_state(state);
    });
    Frame frame;
    if (!live_ && settings_.start > 0) source.seek(settings_.start);
    std::int64_t wanted = settings_.start;
    while (!interrupt_.happened() && !reached_limit()) {
      const ReadResult result = source.read(frame, kReadTimeout);
      progress.update(static_cast<std::int64_t>(recorder.counts().frames),
                      [&] { return disk_text(recorder, arguments_.file); });
      if (result.status == ReadStatus::end) return;
      notifier.after_read(result.status);
      if (result.status == ReadStatus::timeout || frame.index < wanted) continue;
      wanted = (live_ ? frame.index : wanted) + settings_.every;
      if (!live_ && settings_.every > 1) source.seek(wanted);
      if (result.status == ReadStatus::rejected && report_.rejected++ == 0)
        report_.first_rejected = fmt::format("frame {}: {}", frame.index, result.reason);
      if (result.status != ReadStatus::frame) continue;
      if (!result.reason.empty() && !live_) report_.incomplete.add(frame.index, result.reason);
      if (taken_ == 0) begin_frames(source.info(), frame);
      if (arguments_.duration_s > 0 && recorded_s(frame) >= arguments_.duration_s) return;
      ++taken_;
      if (live_)
        recorder.offer(frame);
      else
        recorder.push(frame);
    }
  }

  // Notes come with the first frame, since a recording without any reports one line, the reason, and nothing
  // else.
  void begin_frames(const SourceInfo& info, const Frame& first) {
    first_us_ = first.timestamp_us;
    for (const std::string& note : info.notes) spdlog::warn("{}: {}", info.uri, note);
  }

  // Without a frame the recorder removes the file.
  void check_any_taken() const {
    if (taken_ == 0 && report_.rejected > 0)
      throw unreadable(fmt::format("none of {} could be used; the first, {}",
                                   counted(report_.rejected, "frame"), report_.first_rejected),
                       report_.source, "is it the right file?");
  }

  // The duration limits the time on the wall too, since the frames of a live source may stay away.
  bool reached_limit() const {
    if (settings_.frames > 0 && taken_ >= settings_.frames) return true;
    return live_ && arguments_.duration_s > 0 && seconds_since(begin_) >= arguments_.duration_s;
  }

  double recorded_s(const Frame& frame) const {
    return static_cast<double>(frame.timestamp_us - first_us_) / 1e6;
  }

  void print_summary() const {
    if (settings_.json)
      print_json(record_json(report_));
    else if (!settings_.quiet)
      print_text(record_text(report_) + "\n");
  }

  Interrupt interrupt_;  // before any thread is started
  const RecordArguments& arguments_;
  const Settings& settings_;
  RecordReport report_;
  bool live_ = false;
  Clock::time_point begin_;
  std::int64_t taken_ = 0, first_us_ = 0;  // frames given to the recorder; timestamp of the first
};

}  // namespace

void record(const RecordArguments& arguments, const Settings& settings) {
  cv::setNumThreads(1);  // OpenCV must not start threads besides ours
  RecordRun(arguments, settings).execute();
}

}  // namespace saccade
