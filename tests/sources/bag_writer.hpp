#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "core/intrinsics.hpp"

namespace saccade {

/// A message of a bag, serialised.
struct TestMessage {
  std::string topic, type;  ///< "/depth", "sensor_msgs/Image"
  std::int64_t time_ns = 0;
  std::vector<std::uint8_t> bytes;
};

/// What a CameraInfo says beside the matrix K.
struct TestLens {
  std::string model = "plumb_bob";
  std::vector<double> distortion = std::vector<double>(5, 0.0);
  Intrinsics rectified{};  ///< of the matrix P
  int binning = 0;
  cv::Rect part{};
};

/// Serialises messages as ROS 1 does, or as CDR.
class MessageWriter {
 public:
  explicit MessageWriter(bool cdr) : cdr_(cdr) {}

  /// `image` of the type that the encoding says; rows as they lie in the memory.
  TestMessage image(const std::string& topic, std::int64_t stamp_ns, const cv::Mat& image,
                    const std::string& encoding) const;
  TestMessage compressed(const std::string& topic, std::int64_t stamp_ns, const std::string& format,
                         const std::vector<std::uint8_t>& data) const;
  TestMessage camera(const std::string& topic, std::int64_t stamp_ns, cv::Size size, const Intrinsics& camera,
                     const TestLens& lens = {}) const;

 private:
  bool cdr_;
};

/// Write bags of these messages, by the descriptions of the formats. `compression`: of the chunks, as the
/// format names it.
void write_ros1_bag(const std::filesystem::path& path, const std::vector<TestMessage>& messages,
                    const std::string& compression);
void write_mcap(const std::filesystem::path& path, const std::vector<TestMessage>& messages,
                const std::string& compression, bool checksum = false);
/// As .mcap without chunks.
void write_plain_mcap(const std::filesystem::path& path, const std::vector<TestMessage>& messages);
void write_db3(const std::filesystem::path& path, const std::vector<TestMessage>& messages,
               const std::string& serialisation = "cdr");

/// Depth as RVL, by the description of the format; padded to whole words.
std::vector<std::uint8_t> encode_rvl(const cv::Mat1w& image);

}  // namespace saccade
