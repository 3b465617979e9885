#include "ffv1_writer.hpp"

#include <cstring>
#include <functional>
#include <stdexcept>
#include <string>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/display.h>
#include <libavutil/opt.h>
}

namespace saccade {
namespace {

void check(int code, const char* what) {
  if (code < 0) throw std::runtime_error(what);
}

void put_rows(AVFrame& frame, int plane, const cv::Mat& image) {
  for (int r = 0; r < image.rows; ++r)
    std::memcpy(frame.data[plane] + r * frame.linesize[plane], image.ptr(r),
                static_cast<std::size_t>(image.cols) * image.elemSize());
}

struct Encoding {
  const char* codec;
  AVPixelFormat pixels;
  cv::Size size;
  int rate_hz, key_every;
  std::function<void(AVCodecContext&)> set;  // further options
  bool container_crc = true;
  int turned_degrees = 0;
};

AVCodecContext* open_encoder(const Encoding& encoding, bool global_header) {
  const AVCodec* codec = avcodec_find_encoder_by_name(encoding.codec);
  AVCodecContext* encoder = avcodec_alloc_context3(codec);
  encoder->width = encoding.size.width;
  encoder->height = encoding.size.height;
  encoder->pix_fmt = encoding.pixels;
  encoder->time_base = {1, encoding.rate_hz};
  encoder->framerate = {encoding.rate_hz, 1};
  encoder->gop_size = encoding.key_every;
  encoder->thread_count = 1;
  if (global_header) encoder->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
  encoding.set(*encoder);
  check(avcodec_open2(encoder, codec, nullptr), "encoder");
  return encoder;
}

void turn(AVStream& stream, int degrees) {
  if (degrees == 0) return;
  std::uint8_t* matrix =
      av_stream_new_side_data(&stream, AV_PKT_DATA_DISPLAYMATRIX, 9 * sizeof(std::int32_t));
  if (matrix == nullptr) throw std::runtime_error("side data");
  av_display_rotation_set(reinterpret_cast<std::int32_t*>(matrix), degrees);
}

// `fill` sets the pixels of frame k.
void write_video(const std::filesystem::path& path, const Encoding& encoding, int count,
                 const std::function<void(AVFrame&, int k)>& fill) {
  AVFormatContext* format = nullptr;
  check(avformat_alloc_output_context2(&format, nullptr, nullptr, path.c_str()), "container");
  format->strict_std_compliance = FF_COMPLIANCE_EXPERIMENTAL;  // raw 16-bit grey in MOV
  AVCodecContext* encoder = open_encoder(encoding, (format->oformat->flags & AVFMT_GLOBALHEADER) != 0);
  AVStream* stream = avformat_new_stream(format, nullptr);
  stream->time_base = encoder->time_base;
  stream->avg_frame_rate = encoder->framerate;
  turn(*stream, encoding.turned_degrees);
  check(avcodec_parameters_from_context(stream->codecpar, encoder), "parameters");
  check(avio_open(&format->pb, path.c_str(), AVIO_FLAG_WRITE), "file");
  av_opt_set_int(format, "write_crc32", encoding.container_crc ? 1 : 0, AV_OPT_SEARCH_CHILDREN);
  av_opt_set_int(format, "cluster_time_limit", 200, AV_OPT_SEARCH_CHILDREN);
  check(avformat_write_header(format, nullptr), "header");
  AVFrame* frame = av_frame_alloc();
  frame->format = encoder->pix_fmt;
  frame->width = encoder->width;
  frame->height = encoder->height;
  check(av_frame_get_buffer(frame, 0), "buffer");
  AVPacket* packet = av_packet_alloc();
  const auto drain = [&] {
    while (avcodec_receive_packet(encoder, packet) >= 0) {
      packet->stream_index = stream->index;
      packet->duration = 1;
      av_packet_rescale_ts(packet, encoder->time_base, stream->time_base);
      check(av_interleaved_write_frame(format, packet), "packet");
    }
  };
  for (int k = 0; k < count; ++k) {
    check(av_frame_make_writable(frame), "frame");
    fill(*frame, k);
    frame->pts = k;
    check(avcodec_send_frame(encoder, frame), "frame");
    drain();
  }
  check(avcodec_send_frame(encoder, nullptr), "end");
  drain();
  check(av_write_trailer(format), "trailer");
  avio_closep(&format->pb);
  av_packet_free(&packet);
  av_frame_free(&frame);
  avcodec_free_context(&encoder);
  avformat_free_context(format);
}

}  // namespace

void write_ffv1(const std::filesystem::path& path, const std::vector<cv::Mat1w>& images,
                const Ffv1Options& options) {
  const auto set = [&](AVCodecContext& encoder) {
    encoder.level = options.level;
    av_opt_set_int(&encoder, "slicecrc", options.level >= 3 && options.slice_crc ? 1 : 0,
                   AV_OPT_SEARCH_CHILDREN);
  };
  const Encoding encoding{
      "ffv1", AV_PIX_FMT_GRAY16LE,  images.at(0).size(), options.rate_hz, options.key_every,
      set,    options.container_crc};
  write_video(path, encoding, static_cast<int>(images.size()),
              [&](AVFrame& frame, int k) { put_rows(frame, 0, images[static_cast<std::size_t>(k)]); });
}

void write_raw_grey(const std::filesystem::path& path, const std::vector<cv::Mat1w>& images,
                    bool big_endian) {
  const auto pixels = big_endian ? AV_PIX_FMT_GRAY16BE : AV_PIX_FMT_GRAY16LE;
  const Encoding encoding{"rawvideo", pixels, images.at(0).size(), 30, 1, [](AVCodecContext&) {}};
  write_video(path, encoding, static_cast<int>(images.size()), [&](AVFrame& frame, int k) {
    cv::Mat1w image = images[static_cast<std::size_t>(k)].clone();
    if (big_endian)
      for (std::uint16_t& value : image) value = static_cast<std::uint16_t>(value << 8 | value >> 8);
    put_rows(frame, 0, image);
  });
}

void write_mpeg4(const std::filesystem::path& path, const std::vector<cv::Mat1b>& images,
                 const Mpeg4Options& options) {
  const auto set = [&](AVCodecContext& encoder) {
    encoder.max_b_frames = options.b_frames;
    encoder.flags |= AV_CODEC_FLAG_QSCALE;
    encoder.global_quality = 3 * FF_QP2LAMBDA;
  };
  const cv::Size size = images.at(0).size();
  const Encoding encoding{"mpeg4",
                          AV_PIX_FMT_YUV420P,
                          size,
                          30,
                          options.key_every,
                          set,
                          options.container_crc,
                          options.turned_degrees};
  const cv::Mat1b neutral(size / 2, std::uint8_t{128});
  write_video(path, encoding, static_cast<int>(images.size()), [&](AVFrame& frame, int k) {
    put_rows(frame, 0, images[static_cast<std::size_t>(k)]);
    for (const int plane : {1, 2}) put_rows(frame, plane, neutral);
  });
}

}  // namespace saccade
