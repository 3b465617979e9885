#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include <opencv2/core.hpp>

#include "sources/video_file.hpp"

struct SwsContext;

namespace saccade {

/// A position of a colour video.
struct ColourPicture {
  std::int64_t time_us = 0;  ///< of the container, from its first image
  cv::Mat3b image;           ///< BGR, upright; empty if it is lost or damaged
  std::string problem;       ///< the reason then, else empty
};

/// The pictures of one video stream of a file in the order of their times, by libavcodec. A picture
/// that is lost or damaged keeps its place, and so do those that depend on it, up to the next key frame.
/// Damage that a codec without checksums decodes into other pixels goes unnoticed.
class ColourDecoder {
 public:
  /// Of a file from which nothing was taken. Throws Error (unreadable): of an unknown codec.
  explicit ColourDecoder(std::unique_ptr<VideoFile> file);

  double rate_hz() const { return file_->rate_hz(); }  ///< nominal, > 0

  /// The next position; std::nullopt at the end.
  [[nodiscard]] std::optional<ColourPicture> next();

 private:
  struct FreeContext {
    void operator()(AVCodecContext* context) const { avcodec_free_context(&context); }
  };
  struct FreeFrame {
    void operator()(AVFrame* frame) const { av_frame_free(&frame); }
  };
  struct FreeScaler {
    void operator()(SwsContext* scaler) const;
  };
  using Frame = std::unique_ptr<AVFrame, FreeFrame>;

  // A packet that was sent to the decoder and whose picture has not come.
  struct Waiting {
    std::int64_t time_us = 0;
    std::int64_t group = 0;      // of the key frame before it
    bool spares_others = false;  // no other picture depends on it
  };

  void decode_packet();
  void finish();
  int receive_pictures();
  void take_picture(Waiting waiting, std::int64_t number);
  void deliver(ColourPicture picture);
  void lose(const Waiting& waiting, std::int64_t number, const std::string& problem);
  bool depends_on_damage(const Waiting& waiting, std::int64_t number) const;
  void convert(cv::Mat3b& image);

  std::unique_ptr<VideoFile> file_;
  std::unique_ptr<AVCodecContext, FreeContext> context_;
  Frame frame_, bgr_;
  std::unique_ptr<SwsContext, FreeScaler> scaler_;
  bool intra_only_ = false;                        // every picture is a key frame
  std::int64_t number_ = 0, group_ = 0;            // of packets and of key frames so far
  std::map<std::int64_t, Waiting> waiting_;        // by number
  std::map<std::int64_t, std::int64_t> damaged_;   // by group: the first number that is damaged
  std::multimap<std::int64_t, std::string> lost_;  // by time: why; they wait for a later picture
  std::deque<ColourPicture> ready_;
  bool at_end_ = false;
};

}  // namespace saccade
