#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "core/frame_source.hpp"
#include "core/worker_pool.hpp"
#include "eval/drawing.hpp"
#include "eval/over_time.hpp"
#include "settings/settings.hpp"

namespace saccade {

/// How attention with one model holds over a sequence, and what its points hit.
struct SequenceResult {
  std::string model;
  std::int64_t frames = 0, cuts = 0;
  OverTime over_time;
  /// HR_n, n = 1..settings.fixations, mean over the frames: with memory, and each frame alone; empty without
  /// labels.
  std::vector<double> hit_ratio, hit_ratio_alone;
  /// best_identity_f1() of the points of each frame alone; none without labels.
  std::optional<double> best_identity_f1_alone;
};

/// Watches the frames that `settings` select of a source that is not live, with the model, kernel and number
/// of fixations of `settings`. `go_on` gets the number of frames done and is false to end early. Throws
/// Error: the source has neither labels nor camera poses, or no frame that can be used.
[[nodiscard]] SequenceResult watch_sequence(FrameSource& source, const Settings& settings, WorkerPool& pool,
                                            const std::function<bool(std::int64_t)>& go_on);

/// The results of several models: as JSON, as a table, and as bars.
[[nodiscard]] nlohmann::ordered_json over_time_json(const std::vector<SequenceResult>& results);
[[nodiscard]] std::string over_time_text(const std::vector<SequenceResult>& results);
[[nodiscard]] Drawing draw_over_time(const std::vector<SequenceResult>& results);

}  // namespace saccade
