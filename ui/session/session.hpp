#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/error.hpp"
#include "pipeline/pipeline.hpp"
#include "pipeline/playback_controls.hpp"
#include "ui/session/interactive_processor.hpp"
#include "ui/session/view_result.hpp"

namespace saccade {

/// A source to open and the frames of it to play.
struct OpenRequest {
  std::string uri;
  PlayRange range{};
  SensorSettings sensor{};  ///< of live sensors
};

/// The state of a session.
struct SessionState {
  enum class Phase {
    idle,   ///< no source has been opened yet
    open,   ///< frames come, or may come
    ended,  ///< no more frames, or an error
  };
  Phase phase = Phase::idle;
  std::string opening;                           ///< the source that is being opened; empty = none
  std::int64_t opened = 0;                       ///< sources opened so far
  std::int64_t failed = 0;                       ///< sources that could not be opened so far
  std::string failure;                           ///< why the last of those could not be opened, one line
  ExitStatus failure_status = ExitStatus::done;  ///< of a program that ends for this reason

  // Of the source opened last:
  std::string uri;
  SourceInfo source;
  SourceState connection;  ///< while it is open
  Ledger ledger;
  DurationHistogram latency;                   ///< from capture to result, of this source
  std::string error;                           ///< what ended it, one line; empty = no error
  ExitStatus error_status = ExitStatus::done;  ///< of a program that ends for this reason
  std::int64_t rejected_index = -1;            ///< the last rejected frame, and why
  std::string rejected_reason;
};

/// A computed frame, for plots over time.
struct FrameRecord {
  std::int64_t index = 0;
  std::int64_t generation = 0;
  float strength = 0;  ///< largest saliency of its map
  StageTimes times;
  double latency_ms = 0;
  std::chrono::steady_clock::time_point at;
};

/// What a session has to show, all as of one moment.
struct SessionUpdate {
  SessionState state;
  ViewResultPtr latest;              ///< the newest result of the source; null = none yet
  std::vector<FrameRecord> records;  ///< of the frames computed since the last poll(), without drafts
};

/// The part of the viewer that computes or waits, on threads of its own: opens sources, plays them, computes
/// the newest request, and keeps the newest result. Any thread may call any function, and all return at once,
/// except for the destructor, which waits for opening and computing to end.
class Session {
 public:
  using Open = std::function<std::unique_ptr<FrameSource>(const std::string& uri, const SensorSettings&)>;

  /// Calls `wake` on any thread whenever there is something new to show.
  Session(Open open, std::function<void()> wake, ComputeRequest request);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Opens this source in place of the present one, which goes on until then, and stays if this one cannot be
  /// opened. Only a sensor that may be the same device is closed first, and opened again after a failure. Of
  /// several requests in a row only the newest counts.
  void open(OpenRequest request);

  /// Holds from now on; the frame on screen is computed again. Of several requests in a row only the newest
  /// is computed. Returns the generation that its results carry.
  std::int64_t set_compute_request(const ComputeRequest& request);

  PlaybackControls& playback() { return *playback_; }
  const PlaybackControls& playback() const { return *playback_; }

  [[nodiscard]] SessionState state() const;

  /// The controls of the open sensor: see SensorControls. Empty, and without effect, where there is none.
  [[nodiscard]] SensorValues sensor_values() const;
  [[nodiscard]] std::vector<SensorMode> sensor_modes() const;
  void request_sensor(const SensorValues& wanted);

  /// The newest result of the source; null = none yet.
  [[nodiscard]] ViewResultPtr latest() const;

  /// Everything at once; at most kMostRecords records.
  [[nodiscard]] SessionUpdate poll();
  static constexpr std::size_t kMostRecords = 4096;

 private:
  void work(const std::stop_token& token);
  void replace_source(const OpenRequest& request);
  std::optional<OpenRequest> close_if_same_device(const OpenRequest& request);
  void start(std::unique_ptr<FrameSource> source, const OpenRequest& request);
  void stop_running();
  void run(Pipeline& pipeline);
  void consume(Pipeline& pipeline);
  void stop_pipeline();
  SessionState state_now() const;
  void publish(std::shared_ptr<ViewResult> result);
  void change(const std::function<void(SessionState&)>& how);

  const Open open_;
  const std::function<void()> wake_;
  const std::shared_ptr<PlaybackControls> playback_ = std::make_shared<PlaybackControls>();
  mutable std::mutex mutex_;
  std::condition_variable_any asked_;
  // All guarded by mutex_:
  std::optional<OpenRequest> to_open_;
  ComputeRequest compute_request_;
  std::int64_t generation_ = 0, serial_ = 0, computed_ = 0;
  std::unique_ptr<Pipeline> pipeline_;  // of the open source
  InteractiveProcessor* processor_ = nullptr;
  SensorControls* controls_ = nullptr;  // of the open source; null = it has none
  bool replacing_ = false;              // the end of the pipeline is not the end of the source
  bool stopping_ = false;
  SessionState state_;
  ViewResultPtr latest_;
  std::vector<FrameRecord> records_;
  // Of the opening thread only:
  OpenRequest present_;  // of the source opened last
  std::jthread runner_;  // of the open source
  std::jthread opener_;
};

}  // namespace saccade
