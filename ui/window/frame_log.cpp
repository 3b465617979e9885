// The line of --ui-log for each frame of the window.
#include <nlohmann/json.hpp>

#include "ui/window/viewer.hpp"

namespace saccade {

void Viewer::log_frame(double busy_ms) {
  if (!log_) return;
  const Settings& a = state_.settings.a;
  const cv::Size window = window_.size();
  nlohmann::ordered_json line = {
      {"t_ms", std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch())
                   .count()},
      {"busy_ms", busy_ms},
      {"longest_ms", view_.longest_ms},
      {"frames", frames_},
      {"source", view_.source.uri},
      {"phase", static_cast<int>(view_.source.phase)},
      {"errors", view_.errors},
      {"notes", view_.notes},
      {"paused", view_.playback.paused},
      {"position", view_.playback.position},
      {"speed", view_.playback.speed},
      {"model", a.model},
      {"kernel", a.kernel},
      {"comparison", static_cast<int>(state_.comparison)},
      {"divider", state_.divider},
      {"generation", generation_},
      {"window", {window.width, window.height}},
      {"processed", view_.source.ledger.processed},
      {"connection", static_cast<int>(view_.source.connection.connection)},
      {"losses", view_.source.connection.losses},
      {"recording", view_.recording.phase != RecordingStatus::Phase::idle},
      {"recorded", {{"file", view_.recording.file.string()}, {"frames", view_.recording.frames}}},
      {"snapshot", view_.snapshot},
      {"locked", view_.locked},
      {"pinned", view_.pinned ? nlohmann::json{view_.pinned->x, view_.pinned->y} : nlohmann::json()},
      {"places", view_.places}};
  const SensorValues sensor = session_->sensor_values();
  if (sensor.mirror) line["mirror"] = *sensor.mirror;
  if (sensor.registration) line["registration"] = *sensor.registration;
  if (view_.result) {
    const Computed& shown = view_.result->a;
    const cv::Size size = view_.result->frame().size();
    line["shown"] = {{"index", view_.result->frame().index},
                     {"size", {size.width, size.height}},
                     {"serial", view_.result->serial},
                     {"generation", view_.result->generation},
                     {"model", shown.settings.model},
                     {"kernel", shown.settings.kernel},
                     {"fixations", shown.result.attention.fixations.size()},
                     {"compared", view_.result->compared},
                     {"error", shown.error},
                     {"draft", view_.result->draft}};
  }
  log_->append(line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace saccade
