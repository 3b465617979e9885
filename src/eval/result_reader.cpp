#include "eval/result_reader.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"

namespace saccade {
namespace {

constexpr std::size_t kAllPieces = 16u << 20, kLeastPiece = 16u << 10, kMostPiece = 1u << 20;

}  // namespace

bool ResultReader::Later::operator()(std::size_t a, std::size_t b) const {
  return (*runs)[a].image.frame > (*runs)[b].image.frame;
}

ResultReader::ResultReader(const std::vector<ResultFile>& files) : queue_(Later{&runs_}) {
  std::size_t count = 1;
  for (const ResultFile& file : files) count += file.runs.size();
  const std::size_t piece = std::clamp(kAllPieces / count, kLeastPiece, kMostPiece);
  if (!files.empty()) plan_ = files.front().plan;
  for (const ResultFile& file : files)
    for (const FileRun& run : file.runs)
      runs_.push_back({file.path, LineReader(file.path, run.begin, run.end, piece), {}});
  for (std::size_t i = 0; i < runs_.size(); ++i)
    if (read(runs_[i])) queue_.push(i);
}

bool ResultReader::read(Run& run) const {
  std::string_view line;
  if (!run.reader.next(line)) return false;
  try {
    run.image = parse_image(line, plan_);
  } catch (const std::exception&) {
    throw unreadable("the file was changed while it was read", run.path.string(), "try again");
  }
  return true;
}

std::optional<ImageResult> ResultReader::next() {
  if (queue_.empty()) return std::nullopt;
  const std::size_t first = queue_.top();
  queue_.pop();
  Run& run = runs_[first];
  ImageResult image = std::move(run.image);
  if (last_ && image.frame <= *last_)
    throw unreadable(fmt::format("frame {} is there twice", image.frame), run.path.string(),
                     "evaluate again");
  last_ = image.frame;
  if (read(run)) queue_.push(first);
  return image;
}

}  // namespace saccade
