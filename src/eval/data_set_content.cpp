#include "eval/data_set_content.hpp"

#include <cstdint>
#include <set>

#include <fmt/format.h>

namespace saccade {
namespace {

// FNV-1a, 64 bits.
class Hash {
 public:
  void add(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) value_ = (value_ ^ bytes[i]) * 0x100000001b3U;
  }
  void add(std::int64_t number) { add(&number, sizeof number); }
  void add(const cv::Mat& image) {
    add(image.rows);
    add(image.cols);
    for (int row = 0; row < image.rows; ++row)
      add(image.ptr(row), static_cast<std::size_t>(image.cols) * image.elemSize());
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

}  // namespace

std::string data_set_content(FrameSource& source, const EvalPlan& plan) {
  Hash hash;
  hash.add(source.info().size.width);
  hash.add(source.info().size.height);
  hash.add(source.info().frame_count.value_or(0));
  for (const std::int64_t position :
       std::set<std::int64_t>{0, plan.positions / 2, std::max<std::int64_t>(plan.positions - 1, 0)}) {
    Frame frame;
    source.seek(plan.frame_at(position));
    const bool readable = source.read(frame, std::chrono::seconds(1)).status == ReadStatus::frame;
    hash.add(readable);
    if (!readable) continue;
    hash.add(frame.depth_mm);
    hash.add(frame.truth.labels);
  }
  return fmt::format("{:016x}", hash.value());
}

}  // namespace saccade
