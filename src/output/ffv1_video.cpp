#include "output/ffv1_video.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <new>
#include <string>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/opt.h>
}

#include "core/error.hpp"
#include "core/worker_pool.hpp"

namespace saccade {
namespace {

constexpr AVRational kMillisecond = {1, 1000};
constexpr int kSlices = 4;  // parts of an image that are compressed at the same time; the bytes depend on it

}  // namespace

struct Ffv1Video::Encoder {
  struct FreeContext {
    void operator()(AVCodecContext* unused) const { avcodec_free_context(&unused); }
  };
  struct FreeFrame {
    void operator()(AVFrame* unused) const { av_frame_free(&unused); }
  };
  struct FreePacket {
    void operator()(AVPacket* unused) const { av_packet_free(&unused); }
  };
  struct CloseFormat {
    void operator()(AVFormatContext* unused) const {
      if (unused->pb != nullptr) avio_closep(&unused->pb);
      avformat_free_context(unused);
    }
  };

  Encoder(const std::filesystem::path& file, cv::Size size, Pixels pixels, double rate_hz)
      : path(file.string()), frame(av_frame_alloc()), packet(av_packet_alloc()) {
    av_log_set_level(AV_LOG_QUIET);  // failures are reported by their codes
    const AVCodec* codec = avcodec_find_encoder(AV_CODEC_ID_FFV1);
    if (codec == nullptr) throw failed("libavcodec has no encoder for FFV1", path, "choose another --format");
    AVFormatContext* made = nullptr;
    check(avformat_alloc_output_context2(&made, nullptr, "matroska", path.c_str()));
    format.reset(made);
    format->flags |= AVFMT_FLAG_BITEXACT;  // no random numbers in the file
    context.reset(avcodec_alloc_context3(codec));
    if (!frame || !packet || !context) throw std::bad_alloc();
    set_up_codec(size, pixels, rate_hz);
    check(avcodec_open2(context.get(), codec, nullptr));
    stream = avformat_new_stream(format.get(), nullptr);
    if (stream == nullptr) throw std::bad_alloc();
    stream->time_base = kMillisecond;
    stream->avg_frame_rate = context->framerate;
    check(avcodec_parameters_from_context(stream->codecpar, context.get()));
    check(avio_open(&format->pb, ("file:" + path).c_str(), AVIO_FLAG_WRITE));
    check(avformat_write_header(format.get(), nullptr));
    frame->format = context->pix_fmt;
    frame->width = size.width;
    frame->height = size.height;
    check(av_frame_get_buffer(frame.get(), 0));
  }

  void set_up_codec(cv::Size size, Pixels pixels, double rate_hz) {
    context->width = size.width;
    context->height = size.height;
    context->pix_fmt = pixels == Pixels::grey16 ? AV_PIX_FMT_GRAY16LE : AV_PIX_FMT_BGR0;
    context->time_base = kMillisecond;
    context->framerate = av_d2q(rate_hz, 1'000'000);
    context->gop_size = 1;
    context->level = 3;
    context->slices = kSlices;
    context->thread_count = std::min(kSlices, processor_count());
    if ((format->oformat->flags & AVFMT_GLOBALHEADER) != 0) context->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    av_opt_set_int(context.get(), "slicecrc", 1, AV_OPT_SEARCH_CHILDREN);
    av_opt_set_int(format.get(), "cluster_time_limit", 200, AV_OPT_SEARCH_CHILDREN);
  }

  void check(int code) const {
    if (code >= 0) return;
    if (code == AVERROR(ENOMEM)) throw std::bad_alloc();
    std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
    av_strerror(code, text.data(), text.size());
    throw failed(fmt::format("cannot write the video: {}", text.data()), path,
                 "is the folder writable and the disk not full?");
  }

  void write(const cv::Mat& image, std::int64_t time_us) {
    check(av_frame_make_writable(frame.get()));
    cv::Mat to(image.rows, image.cols, image.depth() == CV_16U ? CV_16UC1 : CV_8UC4, frame->data[0],
               static_cast<std::size_t>(frame->linesize[0]));
    if (image.depth() == CV_16U)
      image.copyTo(to);
    else
      cv::cvtColor(image, to, cv::COLOR_BGR2BGRA);
    last_ms =
        std::max(last_ms + 1, static_cast<std::int64_t>(std::llround(static_cast<double>(time_us) / 1e3)));
    frame->pts = last_ms;
    check(avcodec_send_frame(context.get(), frame.get()));
    drain();
  }

  // A failed write shows at the end of a buffer, in avio's own error.
  void drain() {
    for (;;) {
      const int code = avcodec_receive_packet(context.get(), packet.get());
      if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) break;
      check(code);
      packet->stream_index = stream->index;
      av_packet_rescale_ts(packet.get(), kMillisecond, stream->time_base);
      check(av_interleaved_write_frame(format.get(), packet.get()));
    }
    check(format->pb->error);
  }

  void finish() {
    check(avcodec_send_frame(context.get(), nullptr));
    drain();
    check(av_write_trailer(format.get()));
    check(avio_closep(&format->pb));
  }

  std::string path;
  std::unique_ptr<AVFormatContext, CloseFormat> format;
  std::unique_ptr<AVCodecContext, FreeContext> context;
  std::unique_ptr<AVFrame, FreeFrame> frame;
  std::unique_ptr<AVPacket, FreePacket> packet;
  AVStream* stream = nullptr;
  std::int64_t last_ms = -1;
};

Ffv1Video::Ffv1Video(const std::filesystem::path& path, cv::Size size, Pixels pixels, double rate_hz)
    : encoder_(std::make_unique<Encoder>(path, size, pixels, rate_hz)) {}
Ffv1Video::~Ffv1Video() = default;

void Ffv1Video::write(const cv::Mat& image, std::int64_t time_us) { encoder_->write(image, time_us); }

void Ffv1Video::finish() { encoder_->finish(); }

}  // namespace saccade
