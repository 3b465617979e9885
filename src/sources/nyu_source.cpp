#include "sources/nyu_source.hpp"

#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/image_size.hpp"
#include "sources/hdf5_images.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

constexpr double kNyuRateHz = 30;  // the images are single views: times only number them
constexpr const char* kNyuHint = "expected the labelled .mat of NYU Depth V2 (MATLAB 7.3)";

// 1, 2, .. for each pair of class and instance that occurs, in their order.
cv::Mat1w number_objects(const cv::Mat1w& classes, const cv::Mat1w& instances) {
  std::map<std::pair<int, int>, std::uint16_t> numbers;
  const auto key = [&](int r, int c) {
    return classes(r, c) == 0 || instances(r, c) == 0 ? std::pair(0, 0)
                                                      : std::pair<int, int>(classes(r, c), instances(r, c));
  };
  for (int r = 0; r < classes.rows; ++r)
    for (int c = 0; c < classes.cols; ++c) numbers.emplace(key(r, c), std::uint16_t{0});
  numbers.erase({0, 0});
  if (numbers.size() > 65535) throw std::runtime_error("too many objects in one image");
  std::uint16_t next = 0;
  for (auto& [pair, number] : numbers) number = ++next;
  numbers.emplace(std::pair(0, 0), std::uint16_t{0});
  cv::Mat1w labels(classes.size());
  for (int r = 0; r < classes.rows; ++r)
    for (int c = 0; c < classes.cols; ++c) labels(r, c) = numbers.at(key(r, c));
  return labels;
}

// Throws Error (unreadable) with the reason.
Hdf5File open_file(const fs::path& path) {
  try {
    return Hdf5File(path);
  } catch (const Error&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw unreadable(error.what(), path.string(), kNyuHint);
  }
}

class NyuSource : public FrameSource {
 public:
  NyuSource(const fs::path& path, const InputSettings& settings)
      : path_(path.string()), file_(open_file(path)) {
    if (settings.depth_unit_mm > 0) mm_per_unit_ = static_cast<float>(settings.depth_unit_mm);
    try {
      open_arrays();
    } catch (const std::runtime_error& error) {
      throw unreadable(error.what(), path_, kNyuHint);
    }
    info_.uri = path_;
    info_.kind = "nyu";
    info_.rate_hz = kNyuRateHz;
    info_.intrinsics = Intrinsics::guess_for(info_.size);
    // The RGB camera of the data set's toolbox, which counts pixels from 1; depth is registered to it.
    if (info_.size == cv::Size(640, 480))
      info_.intrinsics = {518.857901, 519.469611, 324.582449, 252.736166, IntrinsicsOrigin::sensor};
    if (file_.missing() > 0)
      info_.notes.push_back(fmt::format("the file is truncated: {} are missing at its end",
                                        megabytes(static_cast<double>(file_.missing()))));
    if (!labels_) info_.notes.push_back("there are no labels that can be used in the file");
    if (labels_ && !instances_)
      info_.notes.push_back("there are no instances that can be used: each class counts as one object");
  }

  const SourceInfo& info() const override { return info_; }

  void seek(std::int64_t index) override { next_ = index; }

  ReadResult read(Frame& frame, std::chrono::milliseconds) override {
    if (next_ < 0 || next_ >= info_.frame_count) return {ReadStatus::end, ""};
    frame.index = next_++;
    frame.timestamp_us = std::llround(static_cast<double>(frame.index) * 1e6 / kNyuRateHz);
    frame.name.clear();
    frame.intrinsics = info_.intrinsics;
    frame.truth = {};
    try {
      read_depth(frame);
    } catch (const std::runtime_error& error) {
      return {ReadStatus::rejected, error.what()};
    }
    std::string problems;
    const auto attempt = [&](const char* what, auto read) {
      try {
        read();
      } catch (const std::runtime_error& error) {
        problems += fmt::format("{}no {}: {}", problems.empty() ? "" : "; ", what, error.what());
      }
    };
    frame.colour.release();
    attempt("colour", [&] { read_colour(frame); });
    attempt("labels", [&] { read_labels(frame); });
    return {ReadStatus::frame, problems};
  }

 private:
  void open_arrays() {
    depths_ = Hdf5Images::open(file_, "depths");
    if (!depths_) throw std::runtime_error("there are no depths in the file");
    const auto& shape = depths_->shape();
    if (shape.size() != 3 || shape[0] == 0) throw std::runtime_error("depths are not N x W x H");
    constexpr std::uint64_t kLeast = 8;
    for (const std::uint64_t side : {shape[1], shape[2]})
      if (side < kLeast || side > kLargestSide)
        throw std::runtime_error(
            fmt::format("{}x{} is not of 8 to {} pixels a side", shape[1], shape[2], kLargestSide));
    check_image_size(static_cast<std::int64_t>(shape[1]), static_cast<std::int64_t>(shape[2]));
    info_.size = {static_cast<int>(shape[1]), static_cast<int>(shape[2])};
    info_.frame_count = static_cast<std::int64_t>(shape[0]);
    images_ = open_companion("images", {shape[0], 3, shape[1], shape[2]});
    labels_ = open_companion("labels", shape);
    instances_ = open_companion("instances", shape);
  }

  // Depth does not need it: what does not fit is a note.
  std::optional<Hdf5Images> open_companion(const std::string& name, const std::vector<std::uint64_t>& shape) {
    try {
      auto array = Hdf5Images::open(file_, name);
      if (!array || array->shape() == shape) return array;
      info_.notes.push_back(fmt::format("{} are not used: their shape is not that of the depths", name));
    } catch (const std::runtime_error& error) {
      info_.notes.push_back(fmt::format("{} are not used: {}", name, error.what()));
    }
    return std::nullopt;
  }

  // One plane of W x H as it lies in the file is the transpose of the image.
  cv::Size stored() const { return {info_.size.height, info_.size.width}; }

  void read_depth(Frame& frame) {
    constexpr float kFarthest_mm = 1e7F;
    cv::Mat1f depth(stored());
    depths_->read(static_cast<std::uint64_t>(frame.index), std::span(depth.ptr<float>(), depth.total()));
    for (float& z : depth) {
      z *= mm_per_unit_;
      if (!(z > 0 && z < kFarthest_mm)) z = 0;  // also where it is not a number
    }
    cv::transpose(depth, frame.depth_mm);
  }

  void read_colour(Frame& frame) {
    if (!images_) return;
    const cv::Size plane = stored();
    cv::Mat1b planes(3 * plane.height, plane.width);
    images_->read(static_cast<std::uint64_t>(frame.index),
                  std::span(planes.ptr<std::uint8_t>(), planes.total()));
    std::array<cv::Mat1b, 3> bgr;
    for (int i = 0; i < 3; ++i) {  // stored as R, G, B
      const cv::Mat1b one = planes.rowRange(i * plane.height, (i + 1) * plane.height);
      cv::transpose(one, bgr[static_cast<std::size_t>(2 - i)]);
    }
    cv::Mat colour;
    cv::merge(bgr.data(), bgr.size(), colour);
    frame.colour = colour;
  }

  cv::Mat1w read_numbers(const Hdf5Images& array, std::int64_t index) const {
    cv::Mat1w turned(stored()), image;
    array.read(static_cast<std::uint64_t>(index), std::span(turned.ptr<std::uint16_t>(), turned.total()));
    cv::transpose(turned, image);
    return image;
  }

  void read_labels(Frame& frame) {
    if (!labels_) return;
    const cv::Mat1w classes = read_numbers(*labels_, frame.index);
    frame.truth.labels =
        instances_ ? number_objects(classes, read_numbers(*instances_, frame.index)) : classes;
    frame.truth.classes = classes;
  }

  std::string path_;
  Hdf5File file_;
  SourceInfo info_;
  std::optional<Hdf5Images> depths_, images_, labels_, instances_;
  float mm_per_unit_ = 1000;  // the arrays are in metres
  std::int64_t next_ = 0;
};

}  // namespace

std::unique_ptr<FrameSource> open_nyu(const fs::path& file, const InputSettings& settings) {
  return std::make_unique<NyuSource>(file, settings);
}

}  // namespace saccade
