#include "app/record_command.hpp"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <nlohmann/json.hpp>

#include "app/command.hpp"
#include "app/interrupt.hpp"
#include "app/manifest.hpp"
#include "app/options.hpp"
#include "app/source_option.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "oni/recorder.hpp"
#include "pipeline/source_state_notifier.hpp"
#include "sources/open_source.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kQueueFrames = 30;  // a second of a camera, for when the disk is busy
constexpr std::chrono::milliseconds kReadTimeout{500};
constexpr auto kLinePeriod = std::chrono::milliseconds(200);

// One `saccade record`, from open source to closed file.
class RecordRun {
 public:
  RecordRun(const RecordArguments& arguments, const Settings& settings)
      : arguments_(arguments), settings_(settings) {}

  void execute() {
    Interrupt interrupt([this] { stop(); });
    const auto source = open_source(arguments_.source, settings_.sensor);
    const SourceInfo& info = source->info();
    for (const std::string& note : info.notes) spdlog::warn("{}: {}", info.uri, note);
    live_ = info.live;
    OniWriterOptions options = arguments_.options;
    options.rate_hz = info.rate_hz;
    options.expect_colour = options.expect_colour || live_;
    OniWriter writer(arguments_.file, options);
    begin_ = Clock::now();
    {
      const Watched watched(*this, *source);
      OniRecorder recorder(writer, kQueueFrames);
      take_frames(*source, recorder);
      recorder.finish();
      counts_ = recorder.counts();
      if (live_) device_ = source->state();
    }
    interrupted_ = interrupt.happened();
    tell_summary(writer);
  }

 private:
  // A source that fails leaves a closed file of what came before.
  void take_frames(FrameSource& source, OniRecorder& recorder) {
    try {
      copy_frames(source, recorder);
    } catch (...) {
      const std::exception_ptr error = std::current_exception();
      clear_line();
      try {
        recorder.finish();
        const auto frames = recorder.counts().frames;
        spdlog::warn("{}: closed with the {} frame{} that came before", arguments_.file, frames,
                     frames == 1 ? "" : "s");
      } catch (const std::exception& second) {
        spdlog::debug("{}", second.what());  // the first error is the one that matters
      }
      std::rethrow_exception(error);
    }
    clear_line();
  }

  void copy_frames(FrameSource& source, OniRecorder& recorder) {
    SourceStateNotifier state_watch(source, [this](const SourceState& state) {
      clear_line();
      tell_state(state);
    });
    Frame frame;
    std::int64_t first_us = 0;
    while (!stopped_ && !(settings_.frames > 0 && taken_ >= settings_.frames)) {
      if (live_ && arguments_.duration_s > 0 && seconds() >= arguments_.duration_s) return;
      const ReadResult result = source.read(frame, kReadTimeout);
      show_line(recorder);
      if (result.status == ReadStatus::end) return;
      state_watch.after_read(result.status);
      if (result.status == ReadStatus::timeout) continue;
      if (result.status == ReadStatus::rejected) {
        if (rejected_++ == 0) first_rejected_ = fmt::format("frame {}: {}", frame.index, result.reason);
        continue;
      }
      if (taken_ == 0) first_us = frame.timestamp_us;
      const double recorded_s = static_cast<double>(frame.timestamp_us - first_us) / 1e6;
      if (arguments_.duration_s > 0 && recorded_s >= arguments_.duration_s) return;
      ++taken_;
      if (live_)
        recorder.offer(frame);
      else
        recorder.push(frame);
    }
  }

  double seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

  bool has_line() const { return !settings_.quiet && ::isatty(STDERR_FILENO) == 1; }

  void show_line(const OniRecorder& recorder) {
    const auto now = Clock::now();
    if (!has_line() || now - last_line_ < kLinePeriod) return;
    last_line_ = now;
    const OniWriterCounts counts = recorder.counts();
    std::error_code code;
    const auto space = fs::space(fs::path(arguments_.file).parent_path() / ".", code);
    fmt::print(stderr, "\r\033[K{} frames, {:.1f}/s, {}{}, {} dropped{}", counts.frames,
               static_cast<double>(counts.frames) / std::max(seconds(), 1e-3),
               megabytes(static_cast<double>(recorder.size_bytes())),
               code ? "" : fmt::format(" ({} free)", megabytes(static_cast<double>(space.available))),
               counts.dropped,
               counts.unsynced > 1 ? fmt::format(", slow disk: {} not on it yet", counts.unsynced) : "");
    std::fflush(stderr);
  }

  void clear_line() const {
    if (has_line()) fmt::print(stderr, "\r\033[K");
  }

  void tell_summary(const OniWriter& writer) const {
    const double wall_s = seconds();
    if (rejected_ > 0)
      spdlog::warn("{}: {} frame{} rejected, the first, {}", arguments_.source, rejected_,
                   rejected_ == 1 ? "" : "s", first_rejected_);
    if (counts_.rounded > 0)
      spdlog::warn("{}: depth of {} frames was rounded to the unit of the file, by at most {:.3g} mm",
                   arguments_.file, counts_.rounded, counts_.largest_rounding_mm);
    if (counts_.out_of_range_pixels > 0)
      spdlog::warn("{}: {} pixels were too far for the unit of the file and have no reading", arguments_.file,
                   counts_.out_of_range_pixels);
    if (settings_.json) {
      nlohmann::ordered_json json = {{"status", interrupted_ ? "interrupted" : "done"},
                                     {"file", arguments_.file},
                                     {"frames", counts_.frames},
                                     {"dropped", counts_.dropped},
                                     {"rejected", rejected_},
                                     {"rounded", counts_.rounded},
                                     {"most_unsynced", counts_.most_unsynced},
                                     {"bytes", writer.size_bytes()},
                                     {"wall_s", wall_s}};
      if (device_) json["device"] = device_json(*device_);
      fmt::print("{}\n", json.dump());
    } else if (!settings_.quiet) {
      fmt::print("{} frame{} in {:.2f} s, {}, {} dropped{}{}{}; see {}\n", counts_.frames,
                 counts_.frames == 1 ? "" : "s", wall_s, megabytes(static_cast<double>(writer.size_bytes())),
                 counts_.dropped, rejected_ > 0 ? fmt::format(", {} rejected", rejected_) : "",
                 counts_.most_unsynced > 1
                     ? fmt::format(", slow disk: up to {} frames at a time were not on it yet",
                                   counts_.most_unsynced)
                     : "",
                 interrupted_ ? ", interrupted" : "", arguments_.file);
    }
    std::fflush(stdout);
  }

  // Makes the source known to stop() for as long as it lives.
  struct Watched {
    Watched(RecordRun& r, FrameSource& source) : run(r) {
      const std::lock_guard lock(run.mutex_);
      run.source_ = &source;
    }
    ~Watched() {
      const std::lock_guard lock(run.mutex_);
      run.source_ = nullptr;
    }
    Watched(const Watched&) = delete;
    Watched& operator=(const Watched&) = delete;
    RecordRun& run;
  };

  void stop() {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    if (source_ != nullptr) source_->interrupt();
  }

  const RecordArguments& arguments_;
  const Settings& settings_;
  bool live_ = false, interrupted_ = false;
  std::int64_t taken_ = 0, rejected_ = 0;
  std::string first_rejected_;
  std::optional<SourceState> device_;  // at the end, of a live source
  OniWriterCounts counts_;
  Clock::time_point begin_, last_line_;
  std::atomic<bool> stopped_ = false;
  std::mutex mutex_;
  FrameSource* source_ = nullptr;  // guarded by mutex_
};

}  // namespace

void record(const RecordArguments& arguments, const Settings& settings) {
  cv::setNumThreads(1);
  RecordRun(arguments, settings).execute();
}

void add_record_command(CLI::App& app, std::function<void()>& action) {
  CLI::App& command = *app.add_subcommand("record", "record a source to an .oni file");
  const auto arguments = std::make_shared<RecordArguments>();
  RecordArguments& a = *arguments;
  add_source_option(command, "SOURCE", a.source, "what to record; see the end of this help")->required();
  command.add_option("FILE", a.file, "the .oni file to make")->required();
  command.add_option("--duration", a.duration_s, "stop after so many seconds; 0 = do not")
      ->type_name("S")
      ->check(CLI::Range(0.0, 1e9));
  const std::map<std::string, OniDepthCodec> depth = {
      {"16zT", OniDepthCodec::z16t}, {"16zP", OniDepthCodec::z16p}, {"none", OniDepthCodec::none}};
  const std::map<std::string, OniColourCodec> colour = {
      {"jpeg", OniColourCodec::jpeg}, {"none", OniColourCodec::none}, {"off", OniColourCodec::off}};
  const std::map<std::string, OniDepthUnit> unit = {
      {"auto", OniDepthUnit::automatic}, {"1mm", OniDepthUnit::mm1}, {"100um", OniDepthUnit::um100}};
  command.add_option("--depth-codec", a.options.depth_codec, "16zT (default, smallest), 16zP or none")
      ->type_name("CODEC")
      ->transform(CLI::CheckedTransformer(depth, CLI::ignore_case).description(""));
  command.add_option("--colour-codec", a.options.colour_codec, "jpeg (default, lossy), none (raw) or off")
      ->type_name("CODEC")
      ->transform(CLI::CheckedTransformer(colour, CLI::ignore_case).description(""));
  command
      .add_option(
          "--depth-unit", a.options.depth_unit,
          "step of stored depth: auto (default: 0.1 mm if the first frame has fractions), 1mm or 100um")
      ->type_name("UNIT")
      ->transform(CLI::CheckedTransformer(unit, CLI::ignore_case).description(""));
  command.add_flag("--force", a.options.overwrite, "replace FILE if it exists");
  const auto options = std::make_shared<SettingsOptions>(
      command, AcceptedSettings{{SettingScope::sensor}, {"frames", "json", "quiet"}});
  command.callback([arguments, options, &action] {
    action = [arguments, options] {
      const Settings settings = options->resolve();
      set_log_level(settings);
      record(*arguments, settings);
    };
  });
}

}  // namespace saccade
