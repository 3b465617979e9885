#include "app/evaluation.hpp"

#include <chrono>

#include <spdlog/spdlog.h>

#include "app/frame_problems.hpp"
#include "core/text.hpp"

namespace saccade {
namespace {

std::string why_left_out(const ImageResult& image) {
  return image.name.empty() ? *image.left_out : image.name + ": " + *image.left_out;
}

}  // namespace

Evaluation::Evaluation(const EvalPlan& plan, FrameSource& source, WorkerPool& pool)
    : plan_(plan), source_(source), pool_(pool), frames_(static_cast<std::size_t>(pool.workers())) {
  for (int i = 0; i < pool.workers(); ++i) {
    lane_pools_.push_back(std::make_unique<WorkerPool>(1));
    lanes_.push_back(std::make_unique<Evaluator>(plan, *lane_pools_.back()));
  }
}

bool Evaluation::run(const std::vector<bool>& known, LineFile& file, Progress& progress,
                     const Interrupt& interrupt, const std::function<void()>& begin) {
  std::int64_t done = 0, used = 0;
  FrameProblems left_out;
  const auto finish = [&](bool complete) {
    if (used > 0 && left_out.count() > 0)  // without any used, the reason is the error that follows
      spdlog::warn("{}: {} left out (see report.json), the first, {}", plan_.dataset,
                   counted(left_out.count(), "image"), left_out.first());
    return complete;
  };
  for (std::int64_t position = plan_.shard - 1; position < plan_.positions;) {
    if (interrupt.happened()) return finish(false);
    Batch batch;
    for (; position < plan_.positions && batch.readable.size() < lanes_.size(); position += plan_.shards)
      if (!known[static_cast<std::size_t>(position)]) read(plan_.frame_at(position), batch);
    evaluate(batch);
    for (const ImageResult& image : batch.images) {
      if (image.left_out)
        left_out.add(image.frame, why_left_out(image));
      else if (used++ == 0)
        begin();
      file.append(image_line(image));
      progress.update(++done);
    }
  }
  return finish(true);
}

// Adds the frame to the batch; if it cannot be used, its result says why.
void Evaluation::read(std::int64_t index, Batch& batch) {
  Frame& frame = frames_[batch.readable.size()];
  ImageResult& result = batch.images.emplace_back();
  result.frame = index;
  source_.seek(index);
  const ReadResult read = source_.read(frame, std::chrono::seconds(1));
  if (plan_.settings.intrinsics) frame.intrinsics = *plan_.settings.intrinsics;
  const bool labels_are_lost = frame.truth.labels.empty() && !read.reason.empty();
  if (read.status == ReadStatus::frame && !labels_are_lost) {
    batch.readable.push_back(batch.images.size() - 1);
    return;
  }
  result.name = read.status == ReadStatus::end ? "" : frame.name;
  result.left_out = read.reason.empty() ? "the data set ends before it" : read.reason;
}

void Evaluation::evaluate(Batch& batch) {
  pool_.for_each(static_cast<int>(batch.readable.size()), [&](int k, int lane) {
    const auto i = static_cast<std::size_t>(k);
    batch.images[batch.readable[i]] = lanes_[static_cast<std::size_t>(lane)]->evaluate(frames_[i]);
  });
}

}  // namespace saccade
