#include "python/source.hpp"

#include <pybind11/pybind11.h>

#include "sources/open_source.hpp"

namespace saccade::python {
namespace py = pybind11;
namespace {

constexpr std::chrono::milliseconds kReadTimeout{100};  // after which Ctrl-C is looked for

void check_signals() {
  const py::gil_scoped_acquire acquire;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

// A source may share pixels among its frames, and the user may write to these.
template <typename Image>
void own(Image& image) {
  if (image.u != nullptr && image.u->refcount > 1) image = image.clone();
}

}  // namespace

Source::Source(const std::string& uri, const FrameSettings& frames, const SourceOptions& options)
    : source_(open_source(uri, options)), info_(source_->info()), frames_(frames), wanted_(frames.start) {
  check_start(info_, frames_.start);
}

std::optional<std::int64_t> Source::frame_count() const {
  const auto& count = info_.frame_count;
  return count ? std::optional(selected_frames(frames_, *count)) : std::nullopt;
}

std::optional<SourceFrame> Source::next() {
  const py::gil_scoped_release release;
  const std::lock_guard lock(mutex_);
  return next_without_gil();
}

std::optional<SourceFrame> Source::next_without_gil() {
  if (!source_) throw py::value_error("the source is closed");
  const bool seekable = !info_.live;
  while (frames_.frames == 0 || taken_ < frames_.frames) {
    if (seekable && position_ != wanted_) source_->seek(wanted_);
    SourceFrame given;
    const ReadResult result = source_->read(given.frame, kReadTimeout);
    if (result.status == ReadStatus::end) return std::nullopt;
    check_signals();
    if (result.status == ReadStatus::timeout) continue;
    const std::int64_t index = seekable ? wanted_ : given.frame.index;
    if (index < wanted_) continue;
    position_ = index + 1;
    wanted_ = index + frames_.every;
    ++taken_;
    if (result.status == ReadStatus::rejected) {
      rejected_.emplace_back(index, result.reason);
      continue;
    }
    own(given.frame.depth_mm);
    own(given.frame.colour);
    own(given.frame.truth.labels);
    given.problem = result.reason;
    if (frames_.intrinsics) given.frame.intrinsics = *frames_.intrinsics;
    return given;
  }
  return std::nullopt;
}

std::vector<std::pair<std::int64_t, std::string>> Source::rejected() const {
  const py::gil_scoped_release release;
  const std::lock_guard lock(mutex_);
  return rejected_;
}

void Source::close() {
  const py::gil_scoped_release release;
  const std::lock_guard lock(mutex_);
  source_.reset();
}

}  // namespace saccade::python
