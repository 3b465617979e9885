#include "ffv1_writer.hpp"

#include <cstring>
#include <stdexcept>
#include <string>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/opt.h>
}

namespace saccade {
namespace {

void check(int code, const char* what) {
  if (code < 0) throw std::runtime_error(what);
}

void set_image(AVFrame& frame, const cv::Mat1w& image, int k) {
  check(av_frame_make_writable(&frame), "frame");
  for (int r = 0; r < image.rows; ++r)
    std::memcpy(frame.data[0] + r * frame.linesize[0], image[r], 2 * static_cast<std::size_t>(image.cols));
  frame.pts = k;
}

}  // namespace

void write_ffv1(const std::filesystem::path& path, const std::vector<cv::Mat1w>& images,
                const Ffv1Options& options) {
  const AVCodec* codec = avcodec_find_encoder(AV_CODEC_ID_FFV1);
  AVCodecContext* encoder = avcodec_alloc_context3(codec);
  AVFormatContext* format = nullptr;
  check(avformat_alloc_output_context2(&format, nullptr, nullptr, path.c_str()), "container");
  encoder->width = images.at(0).cols;
  encoder->height = images.at(0).rows;
  encoder->pix_fmt = AV_PIX_FMT_GRAY16LE;
  encoder->time_base = {1, options.rate_hz};
  encoder->framerate = {options.rate_hz, 1};
  encoder->gop_size = options.key_every;
  encoder->level = options.level;
  encoder->thread_count = 1;
  if ((format->oformat->flags & AVFMT_GLOBALHEADER) != 0) encoder->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
  av_opt_set_int(encoder, "slicecrc", options.level >= 3 && options.slice_crc ? 1 : 0,
                 AV_OPT_SEARCH_CHILDREN);
  check(avcodec_open2(encoder, codec, nullptr), "encoder");
  AVStream* stream = avformat_new_stream(format, nullptr);
  stream->time_base = encoder->time_base;
  stream->avg_frame_rate = encoder->framerate;
  check(avcodec_parameters_from_context(stream->codecpar, encoder), "parameters");
  check(avio_open(&format->pb, path.c_str(), AVIO_FLAG_WRITE), "file");
  av_opt_set_int(format, "write_crc32", options.container_crc ? 1 : 0, AV_OPT_SEARCH_CHILDREN);
  av_opt_set_int(format, "cluster_time_limit", 200, AV_OPT_SEARCH_CHILDREN);
  check(avformat_write_header(format, nullptr), "header");
  AVFrame* frame = av_frame_alloc();
  frame->format = AV_PIX_FMT_GRAY16LE;
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
  for (std::size_t k = 0; k < images.size(); ++k) {
    set_image(*frame, images[k], static_cast<int>(k));
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

}  // namespace saccade
