#include "sources/depth_video.hpp"

#include <algorithm>
#include <array>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

extern "C" {
#include <libavutil/crc.h>
#include <libavutil/frame.h>
#include <libavutil/pixfmt.h>
}

#include "core/error.hpp"
#include "core/image_size.hpp"
#include "core/png.hpp"
#include "core/text.hpp"

namespace saccade {
namespace {

constexpr const char* kExactRoutes =
    "depth must be FFV1 gray16le, 16-bit PNGs or rawvideo gray16le or gray16be, in Matroska, AVI, MOV or NUT";

using Bytes = std::span<const std::uint8_t>;

Bytes bytes_of(const AVPacket& packet) {
  return {packet.data, packet.size > 0 ? static_cast<std::size_t>(packet.size) : 0};
}

bool begins_as_png(Bytes packet) {
  constexpr std::array<std::uint8_t, 4> kSignature = {0x89, 'P', 'N', 'G'};
  return packet.size() > 8 && std::equal(kSignature.begin(), kSignature.end(), packet.begin());
}

// Images of a file's packets, which derived classes decode.
class PacketVideo : public DepthVideo {
 public:
  explicit PacketVideo(std::unique_ptr<VideoFile> file) : file_(std::move(file)) {}

  cv::Size size() const final { return file_->size(); }
  double rate_hz() const final { return file_->rate_hz(); }
  bool has_checksums() const override { return file_->has_checksums(); }

  bool read(cv::Mat1w& depth, std::int64_t& time_us) final {
    const auto next = file_->next();
    if (!next) return false;
    time_us = next->time_us;
    if (!next->problem.empty() && (next->packet == nullptr || !proves_itself(*next->packet))) {
      lose_image();
      throw std::runtime_error(next->problem);
    }
    decode(*next->packet, depth);
    if (depth.size() != size())
      throw std::runtime_error(
          fmt::format("{}x{} instead of {}x{}", depth.cols, depth.rows, size().width, size().height));
    return true;
  }

  bool skip() override { return file_->next().has_value(); }

 protected:
  const VideoFile& file() const { return *file_; }

 private:
  // Fills `depth`, or throws std::runtime_error.
  virtual void decode(const AVPacket& packet, cv::Mat1w& depth) = 0;
  // Whether decode() would notice damage of this packet, so that a checksum of the container, which covers
  // many, does not matter.
  virtual bool proves_itself(const AVPacket& packet) const = 0;
  // This image will not be decoded.
  virtual void lose_image() {}

  std::unique_ptr<VideoFile> file_;
};

class PngVideo final : public PacketVideo {
 public:
  using PacketVideo::PacketVideo;
  bool has_checksums() const override { return true; }

 private:
  void decode(const AVPacket& packet, cv::Mat1w& depth) override {
    const cv::Mat image = decode_png(bytes_of(packet));
    if (image.type() != CV_16UC1) throw std::runtime_error("not a 16-bit grey PNG");
    image.copyTo(depth);
  }
  bool proves_itself(const AVPacket&) const override { return true; }
};

class RawVideo final : public PacketVideo {
 public:
  using PacketVideo::PacketVideo;

 private:
  void decode(const AVPacket& packet, cv::Mat1w& depth) override {
    const Bytes bytes = bytes_of(packet);
    if (bytes.size() != 2 * static_cast<std::size_t>(size().area()))
      throw std::runtime_error(
          fmt::format("{} for {}x{} pixels", counted(bytes.size(), "byte"), size().width, size().height));
    depth.create(size());
    if (file().codec().format == AV_PIX_FMT_GRAY16LE) {
      std::ranges::copy(bytes, depth.data);
      return;
    }
    const std::uint8_t* big = bytes.data();
    for (std::uint16_t& value : depth) {
      value = static_cast<std::uint16_t>(big[0] << 8 | big[1]);
      big += 2;
    }
  }
  bool proves_itself(const AVPacket&) const override { return false; }
};

// An image may depend on those before it, back to the last key frame.
class Ffv1Video final : public PacketVideo {
 public:
  explicit Ffv1Video(std::unique_ptr<VideoFile> opened)
      : PacketVideo(std::move(opened)), frame_(av_frame_alloc()) {
    const AVCodec* codec = avcodec_find_decoder(AV_CODEC_ID_FFV1);
    context_.reset(codec == nullptr ? nullptr : avcodec_alloc_context3(codec));
    if (!frame_ || !context_) throw std::bad_alloc();
    if (avcodec_parameters_to_context(context_.get(), &file().codec()) < 0) throw std::bad_alloc();
    context_->thread_count = 1;  // so that its messages come on this thread
    context_->max_pixels = kMostPixels;
    context_->err_recognition = AV_EF_CRCCHECK;
    VideoMessages messages;
    const int code = avcodec_open2(context_.get(), codec, nullptr);
    if (code == AVERROR(ENOMEM)) throw std::bad_alloc();
    const auto error = messages.take_error();
    if (code < 0)
      throw unreadable("this FFV1 video cannot be decoded: " + error.value_or("damaged header"),
                       file().path().string(), "the file may be damaged");
  }

  // From version 2 on the stream has a header of its own, and by default checksums.
  bool has_checksums() const override {
    return file().codec().extradata_size > 0 || PacketVideo::has_checksums();
  }

  bool skip() override {
    try {
      cv::Mat1w unused;
      std::int64_t time_us = 0;
      return read(unused, time_us);
    } catch (const std::runtime_error&) {
      return true;
    }
  }

 private:
  struct FreeContext {
    void operator()(AVCodecContext* context) const { avcodec_free_context(&context); }
  };
  struct FreeFrame {
    void operator()(AVFrame* frame) const { av_frame_free(&frame); }
  };

  void lose_image() override { incomplete_ = true; }

  // A packet is a row of slices. If the stream has checksums, each slice ends with its length (3 bytes), a
  // status and the checksum.
  bool proves_itself(const AVPacket& packet) const override {
    constexpr std::size_t kTrailer = 8;
    Bytes rest = bytes_of(packet);
    while (!rest.empty()) {
      if (rest.size() < kTrailer) return false;
      const Bytes trailer = rest.last(kTrailer);
      const std::size_t length =
          static_cast<std::size_t>(trailer[0]) << 16 | static_cast<std::size_t>(trailer[1]) << 8 | trailer[2];
      if (length + kTrailer > rest.size()) return false;
      const Bytes slice = rest.last(length + kTrailer);
      if (av_crc(av_crc_get_table(AV_CRC_32_IEEE), 0, slice.data(), slice.size()) != 0) return false;
      rest = rest.first(rest.size() - slice.size());
    }
    return true;
  }

  void decode(const AVPacket& packet, cv::Mat1w& depth) override {
    if ((packet.flags & AV_PKT_FLAG_KEY) != 0) incomplete_ = false;
    if (incomplete_) throw std::runtime_error("it depends on an image that is lost or damaged");
    incomplete_ = true;  // until it is known to be sound
    VideoMessages messages;
    int code = avcodec_send_packet(context_.get(), &packet);
    if (code >= 0) code = avcodec_receive_frame(context_.get(), frame_.get());
    if (code == AVERROR(ENOMEM)) throw std::bad_alloc();
    const auto error = messages.take_error();
    if (code < 0 || error)
      throw std::runtime_error("damaged FFV1: " + error.value_or("it cannot be decoded"));
    copy_image(depth);
    incomplete_ = false;
  }

  void copy_image(cv::Mat1w& depth) const {
    if (frame_->format != AV_PIX_FMT_GRAY16LE) throw std::runtime_error("not 16-bit grey");
    const cv::Mat image(frame_->height, frame_->width, CV_16UC1, frame_->data[0],
                        static_cast<std::size_t>(frame_->linesize[0]));
    image.copyTo(depth);
  }

  std::unique_ptr<AVCodecContext, FreeContext> context_;
  std::unique_ptr<AVFrame, FreeFrame> frame_;
  bool incomplete_ = false;  // an image since the last key frame is missing
};

bool is_grey16(int format) { return format == AV_PIX_FMT_GRAY16LE || format == AV_PIX_FMT_GRAY16BE; }

enum class Route { none, png, raw, ffv1 };  // none: it is no depth

Route route_of(VideoFile& file) {
  const AVPacket* first = file.peek();
  const std::string path = file.path().string();
  if (first == nullptr)
    throw unreadable("no video that can be read", path, "the file may be truncated or not a video");
  const AVCodecParameters& codec = file.codec();
  if (is_grey16(codec.format)) {
    if (begins_as_png(bytes_of(*first))) return Route::png;
    if (codec.codec_id == AV_CODEC_ID_RAWVIDEO) return Route::raw;
    if (codec.format == AV_PIX_FMT_GRAY16LE && codec.codec_id == AV_CODEC_ID_FFV1) return Route::ffv1;
    throw unreadable("16-bit grey in a codec that need not keep every bit", path, kExactRoutes);
  }
  if (codec.codec_id == AV_CODEC_ID_NONE)
    throw unreadable("no codec is known for this video", path, "the file may be damaged");
  if (file.path().stem().string().ends_with("_depth"))
    throw unreadable("this depth video has 8 bits a pixel, or would be flattened to 8", path, kExactRoutes);
  return Route::none;
}

}  // namespace

bool holds_depth(VideoFile& file) { return route_of(file) != Route::none; }

std::unique_ptr<DepthVideo> open_depth_video(std::unique_ptr<VideoFile> file) {
  switch (route_of(*file)) {
    case Route::png:
      return std::make_unique<PngVideo>(std::move(file));
    case Route::raw:
      return std::make_unique<RawVideo>(std::move(file));
    case Route::ffv1:
      return std::make_unique<Ffv1Video>(std::move(file));
    case Route::none:
      break;
  }
  throw unreadable("it holds no depth", file->path().string(), kExactRoutes);
}

}  // namespace saccade
