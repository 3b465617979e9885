#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <queue>
#include <string>
#include <vector>

#include "core/line_reader.hpp"
#include "eval/result_file.hpp"

namespace saccade {

/// Gives the images of one or several files in the order of their frames, with the memory of one image and
/// one piece of text for each file.
class ResultReader {
 public:
  /// The files must stay as they are.
  explicit ResultReader(const std::vector<ResultFile>& files);

  /// The next image; none at the end. Throws Error (unreadable) if it cannot be read, or if a frame is there
  /// twice.
  [[nodiscard]] std::optional<ImageResult> next();

 private:
  struct Run {
    std::filesystem::path path;
    LineReader reader;
    ImageResult image;  // its next one
  };
  struct Later {  // for a queue whose top is the first frame
    const std::vector<Run>* runs;
    bool operator()(std::size_t a, std::size_t b) const;
  };

  bool read(Run& run) const;

  EvalPlan plan_;
  std::vector<Run> runs_;
  std::priority_queue<std::size_t, std::vector<std::size_t>, Later> queue_;
  std::optional<std::int64_t> last_;
};

}  // namespace saccade
