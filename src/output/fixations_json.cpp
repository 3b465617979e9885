#include "output/fixations_json.hpp"

#include <chrono>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace saccade {
namespace {

std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string list_mm(const cv::Point3f& p) { return fmt::format("[{},{},{}]", p.x, p.y, p.z); }

std::string sequence_json(const SequenceState& sequence) {
  std::string numbers;
  for (const double number : sequence.camera_to_world.matrix.val)
    numbers += fmt::format("{}{:.9g}", numbers.empty() ? "" : ",", number);
  return fmt::format(R"("gaze":{},"cut":{},"camera_to_world":[{}],)",
                     sequence.gaze ? std::to_string(*sequence.gaze) : "null", sequence.cut, numbers);
}

}  // namespace

// Formatted here, for the shortest text of a float ("0.1"): a JSON library prints it as a double.
std::string fixations_json(const Result& result) {
  const Attention& attention = result.attention;
  std::string line = fmt::format(R"({{"frame":{},"name":{},"timestamp_us":{},)", result.frame.index,
                                 quoted(result.frame.name), result.frame.timestamp_us);
  if (attention.sequence) line += sequence_json(*attention.sequence);
  line += R"("fixations":[)";
  int rank = 0;
  for (const Fixation& f : attention.fixations) {
    line += fmt::format(R"({}{{"rank":{},"row":{},"col":{},"saliency":{},"x_mm":{},"y_mm":{},"z_mm":{})",
                        rank > 0 ? "," : "", rank + 1, f.row, f.col, f.saliency, f.position_mm.x,
                        f.position_mm.y, f.position_mm.z);
    if (f.confidence) line += fmt::format(R"(,"confidence":{})", *f.confidence);
    if (attention.sequence)
      line +=
          fmt::format(R"(,"id":{},"age_frames":{},"world_mm":{})", f.id, f.age_frames, list_mm(f.world_mm));
    const ProtoObject& object = f.proto_object;
    if (object.pixels > 0)
      line += fmt::format(R"(,"pixels":{},"centroid_mm":{},"extent_mm":{})", object.pixels,
                          list_mm(object.centroid_mm), list_mm(object.extent_mm));
    line += '}';
    ++rank;
  }
  line += ']';
  if (!attention.ended_early.empty())
    line += fmt::format(R"(,"ended_early":{})", quoted(attention.ended_early));
  return line + '}';
}

std::string streamed_json(const Result& result, const std::string& fixations) {
  using std::chrono::duration_cast, std::chrono::microseconds;
  const auto ago = std::chrono::steady_clock::now() - result.captured_at;
  const auto captured = std::chrono::system_clock::now().time_since_epoch() - ago;
  return fmt::format(R"({{"captured_us":{},{})", duration_cast<microseconds>(captured).count(),
                     fixations.substr(1));
}

}  // namespace saccade
