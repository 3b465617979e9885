#pragma once

#include <cstdarg>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <opencv2/core.hpp>

#include "sources/matroska_checksums.hpp"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

namespace saccade {

/// The containers that are read, as a list of libavformat's names: none of them is a playlist.
inline constexpr const char* kVideoFormats =
    "matroska,webm,mov,mp4,m4a,3gp,3g2,mj2,avi,nut,mpeg,mpegts,mpegvideo,ogg";

/// Collects what the libraries libavformat and libavcodec report on this thread while it lives, instead of on
/// standard error. They hide some damage behind pictures that look sound, and mention it here only. One per
/// thread at a time.
class VideoMessages {
 public:
  VideoMessages();
  ~VideoMessages();
  VideoMessages(const VideoMessages&) = delete;
  VideoMessages& operator=(const VideoMessages&) = delete;

  /// The first error since the last call; std::nullopt if there was none.
  std::optional<std::string> take_error() { return std::exchange(error_, std::nullopt); }

 private:
  friend void collect_video_message(void*, int level, const char* format, va_list arguments);
  std::optional<std::string> error_;
};

/// A position in the first video stream of a file, in the order of the file.
struct VideoPacket {
  const AVPacket* packet =
      nullptr;               ///< valid until the next call; nullptr for an image that the file has lost
  std::int64_t time_us = 0;  ///< of the container, from its first image
  std::string problem;       ///< not empty: the image is lost or damaged
};

/// The packets of one video stream of a file, by libavformat. The file cannot lead to other files.
class VideoFile {
 public:
  /// Opens the stream with that title; without one, the stream that libavformat thinks best. Throws Error
  /// (unreadable): not a video, no such stream, or images that check_image_size() refuses.
  explicit VideoFile(const std::filesystem::path& path, std::string_view title = {});

  const std::filesystem::path& path() const { return path_; }
  std::string_view title() const { return title_; }  ///< as the stream was chosen; empty: by libavformat

  /// The titles of all video streams; empty ones too.
  std::vector<std::string> titles() const;

  /// The stream with that title from now on, before anything was read. Throws Error as the constructor.
  void choose(std::string_view title);

  /// The content of a file that is attached; std::nullopt if there is none of that name.
  std::optional<std::string> attachment(std::string_view name) const;

  const AVCodecParameters& codec() const { return *stream_->codecpar; }
  cv::Size size() const { return {codec().width, codec().height}; }
  double rate_hz() const { return rate_hz_; }  ///< nominal, > 0
  AVRational time_base() const { return stream_->time_base; }

  /// The time of the first image in the container, by which streams of one file are aligned.
  std::int64_t start_us() const;

  /// A timestamp of the stream as time from the first image.
  std::int64_t time_us(std::int64_t timestamp) const;

  /// By how much the images must be turned to be upright, counterclockwise.
  double rotation_degrees() const;

  /// Whether damage of an image can be noticed by checksums of the container.
  bool has_checksums() const { return checksums_.present(); }

  /// The packet that next() will give; nullptr if that is an image that the file has lost, or the end.
  const AVPacket* peek();

  /// The next position; std::nullopt at the end. Where the file is cut, or so damaged that images are
  /// skipped, a packet with a problem stands for each image that is missing according to the times of the
  /// container.
  std::optional<VideoPacket> next();

 private:
  struct CloseFormat {
    void operator()(AVFormatContext* format) const { avformat_close_input(&format); }
  };
  struct FreePacket {
    void operator()(AVPacket* packet) const { av_packet_free(&packet); }
  };

  void open();
  std::int64_t start() const;  // as start_us(), in the units of the stream
  AVStream* find_stream(std::string_view title) const;
  void check_size() const;
  void advance();
  bool read_packet();
  std::int64_t time_of(const AVPacket& packet) const;
  std::int64_t missing_before(std::int64_t time_us) const;
  std::optional<std::int64_t> end_us() const;
  void look_for_gap();
  void lose(std::int64_t images);
  std::int64_t lost_at_end() const;
  void look_for_lost_end();

  std::filesystem::path path_;
  std::string title_;
  std::unique_ptr<AVFormatContext, CloseFormat> format_;
  std::unique_ptr<AVPacket, FreePacket> packet_;
  AVStream* stream_ = nullptr;
  double rate_hz_ = 0;
  MatroskaChecksums checksums_;
  std::int64_t damaged_clusters_ = 0;  // up to the packet that was read
  bool damaged_ = false;               // its cluster is
  std::int64_t count_ = 0;             // positions given so far
  std::int64_t last_us_ = -1;          // the latest of the positions
  std::int64_t longest_us_ = 0;        // the greatest distance of two sound ones
  std::int64_t lost_ = 0;              // positions to give before the packet that was read, or the end
  std::int64_t may_be_lost_ = 0;       // how many more are reported
  bool waiting_ = false;               // a packet was read and is to be given after the lost ones
  bool at_end_ = false;
  std::string reason_;  // why images are lost
};

}  // namespace saccade
