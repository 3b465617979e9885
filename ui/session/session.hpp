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

#include "pipeline/pipeline.hpp"
#include "pipeline/playback_controls.hpp"
#include "ui/session/interactive_processor.hpp"
#include "ui/session/view_result.hpp"

namespace saccade {

/// What to open and which of its frames to play.
struct OpenRequest {
  std::string uri;
  PlayRange range{};
  SensorSettings sensor{};  ///< of live sensors
};

/// How a session is doing.
struct SessionState {
  enum class Phase {
    idle,     ///< nothing was asked for
    opening,  ///< the source is being opened
    open,     ///< frames come, or could
    ended,    ///< there are no more, or an error ended it
  };
  Phase phase = Phase::idle;
  std::string uri;         ///< of the newest request
  SourceInfo source;       ///< if it could be opened
  SourceState connection;  ///< of the source, while it is open
  bool computing = false;  ///< a frame is being computed
  Ledger ledger;
  DurationHistogram latency;         ///< from capture to result, of this source
  std::string error;                 ///< what ended it; one line
  std::int64_t rejected_index = -1;  ///< the frame rejected last, and why
  std::string rejected_reason;
};

/// Of each computed frame, for plots over time.
struct FrameRecord {
  std::int64_t index = 0;
  std::int64_t generation = 0;
  float strength = 0;  ///< saliency of the first fixation; 0 = there is none
  StageTimes times;
  double latency_ms = 0;
  std::chrono::steady_clock::time_point at;
};

/// Everything of the viewer that computes or waits, on threads of its own: opens sources, plays them,
/// computes what is wished for, and keeps the newest result. All functions may be called by any thread and
/// return at once, the destructor excepted, which waits for what is being opened or computed.
class Session {
 public:
  using Open = std::function<std::unique_ptr<FrameSource>(const std::string& uri, const SensorSettings&)>;

  /// `wake` is called on any thread whenever there is something new to see.
  Session(Open open, std::function<void()> wake, ComputeRequest request);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Closes what is open and opens this. Of several requests in a row only the newest counts.
  void open(OpenRequest request);

  /// What is to be computed from now on; the frame that is shown is computed once more. Of several changes in
  /// a row only the newest is computed. Returns the generation, which the results of it carry.
  std::int64_t set_compute_request(const ComputeRequest& request);

  PlaybackControls& playback() { return *playback_; }
  const PlaybackControls& playback() const { return *playback_; }

  SessionState state() const;

  /// The controls of the sensor that is open: see SensorControls. All empty, and without effect, where there
  /// is none.
  SensorValues sensor_values() const;
  std::vector<SensorMode> sensor_modes() const;
  void request_sensor(const SensorValues& wanted);

  /// The newest result of the source that is open; null = none yet.
  ViewResultPtr latest() const;

  /// The records of the frames computed, drafts excepted, since the last call, at most kMostRecords.
  std::vector<FrameRecord> take_records();
  static constexpr std::size_t kMostRecords = 4096;

 private:
  void work(const std::stop_token& token);
  void run(const OpenRequest& request);
  void consume(Pipeline& pipeline);
  void stop_pipeline();
  void set_computing(bool computing);
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
  Pipeline* pipeline_ = nullptr;
  InteractiveProcessor* processor_ = nullptr;
  SensorControls* controls_ = nullptr;  // of the open source; null = it has none
  bool stopping_ = false;
  SessionState state_;
  ViewResultPtr latest_;
  std::vector<FrameRecord> records_;
  std::jthread thread_;
};

}  // namespace saccade
