#include "python/source.hpp"

#include <pybind11/pybind11.h>

#include "sources/open_source.hpp"

namespace saccade::python {

namespace {

constexpr std::chrono::milliseconds kReadTimeout{100};  // after which Ctrl-C is looked for

}  // namespace

Source::Source(const std::string& uri, const FrameSettings& frames, const SensorSettings& sensor)
    : source_(open_source(uri, sensor)), frames_(frames), wanted_(frames.start) {
  check_start(source_->info(), frames_.start);
}

std::optional<std::int64_t> Source::frame_count() const {
  const auto& count = info().frame_count;
  return count ? std::optional(selected_frames(frames_, *count)) : std::nullopt;
}

ReadResult Source::read(Frame& frame) {
  const pybind11::gil_scoped_release release;
  return source_->read(frame, kReadTimeout);
}

std::optional<Frame> Source::next() {
  const bool seekable = !info().live;
  while (frames_.frames == 0 || taken_ < frames_.frames) {
    if (seekable && position_ != wanted_) source_->seek(wanted_);
    Frame frame;
    const ReadResult result = read(frame);
    if (result.status == ReadStatus::end) return std::nullopt;
    if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
    if (result.status == ReadStatus::timeout) continue;
    if (!seekable && frame.index < wanted_) continue;
    position_ = (seekable ? wanted_ : frame.index) + 1;
    wanted_ = position_ - 1 + frames_.every;
    ++taken_;
    if (result.status == ReadStatus::rejected) {
      rejected_.emplace_back(position_ - 1, result.reason);
      continue;
    }
    if (frames_.intrinsics) frame.intrinsics = *frames_.intrinsics;
    return frame;
  }
  return std::nullopt;
}

}  // namespace saccade::python
