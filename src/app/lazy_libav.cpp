// FFmpeg's functions that the program uses, each of which opens its library when it is first called. FFmpeg
// needs some 120 other libraries; loading them took more than half of the time until any command began, and
// most commands read or write no video. These definitions come before those of the libraries, which the
// linker then leaves out (--as-needed). A function that is missing here works too, but its library is loaded
// at the start again.
#include <dlfcn.h>

#include <cstdarg>
#include <cstdint>
#include <string>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/crc.h>
#include <libavutil/display.h>
#include <libavutil/opt.h>
#include <libswscale/swscale.h>
}

#include "core/error.hpp"

namespace saccade {
namespace {

// A function of a shared library, which stays open. Throws Error (failed).
template <typename Function>
Function* find(const std::string& library, const char* name) {
  void* const handle = ::dlopen(library.c_str(), RTLD_LAZY | RTLD_LOCAL);
  void* const found = handle == nullptr ? nullptr : ::dlsym(handle, name);
  if (found == nullptr) {
    const char* reason = ::dlerror();
    throw failed("cannot use the video library", library, reason == nullptr ? name : reason);
  }
  return reinterpret_cast<Function*>(found);
}

constexpr const char *kUtil = "libavutil.so." AV_STRINGIFY(LIBAVUTIL_VERSION_MAJOR),
                     *kCodec = "libavcodec.so." AV_STRINGIFY(LIBAVCODEC_VERSION_MAJOR),
                     *kFormat = "libavformat.so." AV_STRINGIFY(LIBAVFORMAT_VERSION_MAJOR),
                     *kScale = "libswscale.so." AV_STRINGIFY(LIBSWSCALE_VERSION_MAJOR);

}  // namespace
}  // namespace saccade

// Hidden: FFmpeg's libraries go on calling each other directly. The compiler compares the types with those of
// FFmpeg's headers.
#define FORWARD(library, result, name, parameters, arguments)                            \
  extern "C" __attribute__((visibility("hidden"))) result name parameters {              \
    static const auto function = saccade::find<decltype(name)>(saccade::library, #name); \
    return function arguments;                                                           \
  }

// clang-format off
FORWARD(kUtil, std::uint32_t, av_crc,
        (const AVCRC* ctx, std::uint32_t crc, const std::uint8_t* buffer, std::size_t length),
        (ctx, crc, buffer, length))
FORWARD(kUtil, const AVCRC*, av_crc_get_table, (AVCRCId crc_id), (crc_id))
FORWARD(kUtil, AVRational, av_d2q, (double d, int max), (d, max))
FORWARD(kUtil, void, av_dict_free, (AVDictionary** m), (m))
FORWARD(kUtil, AVDictionaryEntry*, av_dict_get,
        (const AVDictionary* m, const char* key, const AVDictionaryEntry* prev, int flags),
        (m, key, prev, flags))
FORWARD(kUtil, int, av_dict_set,
        (AVDictionary** pm, const char* key, const char* value, int flags),
        (pm, key, value, flags))
FORWARD(kUtil, double, av_display_rotation_get, (const std::int32_t matrix[9]), (matrix))
FORWARD(kUtil, AVFrame*, av_frame_alloc, (), ())
FORWARD(kUtil, void, av_frame_free, (AVFrame** frame), (frame))
FORWARD(kUtil, int, av_frame_get_buffer, (AVFrame* frame, int align), (frame, align))
FORWARD(kUtil, int, av_frame_make_writable, (AVFrame* frame), (frame))
FORWARD(kUtil, void, av_frame_unref, (AVFrame* frame), (frame))
FORWARD(kUtil, void, av_log_set_callback, (void (*callback)(void*, int, const char*, va_list)), (callback))
FORWARD(kUtil, void, av_log_set_level, (int level), (level))
FORWARD(kUtil, int, av_opt_set_int,
        (void* obj, const char* name, std::int64_t val, int search_flags),
        (obj, name, val, search_flags))
FORWARD(kUtil, std::int64_t, av_rescale, (std::int64_t a, std::int64_t b, std::int64_t c), (a, b, c))
FORWARD(kUtil, std::int64_t, av_rescale_q, (std::int64_t a, AVRational bq, AVRational cq), (a, bq, cq))
FORWARD(kUtil, int, av_strerror,
        (int errnum, char* errbuf, std::size_t errbuf_size),
        (errnum, errbuf, errbuf_size))

FORWARD(kCodec, AVPacket*, av_packet_alloc, (), ())
FORWARD(kCodec, void, av_packet_free, (AVPacket** pkt), (pkt))
FORWARD(kCodec, void, av_packet_rescale_ts,
        (AVPacket* pkt, AVRational tb_src, AVRational tb_dst),
        (pkt, tb_src, tb_dst))
FORWARD(kCodec, void, av_packet_unref, (AVPacket* pkt), (pkt))
FORWARD(kCodec, AVCodecContext*, avcodec_alloc_context3, (const AVCodec* codec), (codec))
FORWARD(kCodec, const AVCodecDescriptor*, avcodec_descriptor_get, (AVCodecID id), (id))
FORWARD(kCodec, const AVCodec*, avcodec_find_decoder, (AVCodecID id), (id))
FORWARD(kCodec, const AVCodec*, avcodec_find_encoder, (AVCodecID id), (id))
FORWARD(kCodec, void, avcodec_free_context, (AVCodecContext** avctx), (avctx))
FORWARD(kCodec, const char*, avcodec_get_name, (AVCodecID id), (id))
FORWARD(kCodec, int, avcodec_open2,
        (AVCodecContext* avctx, const AVCodec* codec, AVDictionary** options),
        (avctx, codec, options))
FORWARD(kCodec, int, avcodec_parameters_from_context,
        (AVCodecParameters* par, const AVCodecContext* codec),
        (par, codec))
FORWARD(kCodec, int, avcodec_parameters_to_context,
        (AVCodecContext* codec, const AVCodecParameters* par),
        (codec, par))
FORWARD(kCodec, int, avcodec_receive_frame, (AVCodecContext* avctx, AVFrame* frame), (avctx, frame))
FORWARD(kCodec, int, avcodec_receive_packet, (AVCodecContext* avctx, AVPacket* avpkt), (avctx, avpkt))
FORWARD(kCodec, int, avcodec_send_frame, (AVCodecContext* avctx, const AVFrame* frame), (avctx, frame))
FORWARD(kCodec, int, avcodec_send_packet, (AVCodecContext* avctx, const AVPacket* avpkt), (avctx, avpkt))

FORWARD(kFormat, int, av_find_best_stream,
        (AVFormatContext* ic, AVMediaType type, int wanted_stream_nb, int related_stream, const AVCodec**
        decoder_ret, int flags),
        (ic, type, wanted_stream_nb, related_stream, decoder_ret, flags))
FORWARD(kFormat, AVRational, av_guess_frame_rate,
        (AVFormatContext* ctx, AVStream* stream, AVFrame* frame),
        (ctx, stream, frame))
FORWARD(kFormat, int, av_interleaved_write_frame, (AVFormatContext* s, AVPacket* pkt), (s, pkt))
FORWARD(kFormat, int, av_read_frame, (AVFormatContext* s, AVPacket* pkt), (s, pkt))
FORWARD(kFormat, std::uint8_t*, av_stream_get_side_data,
        (const AVStream* stream, AVPacketSideDataType type, std::size_t* size),
        (stream, type, size))
FORWARD(kFormat, int, av_write_trailer, (AVFormatContext* s), (s))
FORWARD(kFormat, int, avformat_alloc_output_context2,
        (AVFormatContext** ctx, const AVOutputFormat* oformat, const char* format_name, const char* filename),
        (ctx, oformat, format_name, filename))
FORWARD(kFormat, void, avformat_close_input, (AVFormatContext** s), (s))
FORWARD(kFormat, int, avformat_find_stream_info, (AVFormatContext* ic, AVDictionary** options), (ic, options))
FORWARD(kFormat, void, avformat_free_context, (AVFormatContext* s), (s))
FORWARD(kFormat, AVStream*, avformat_new_stream, (AVFormatContext* s, const AVCodec* c), (s, c))
FORWARD(kFormat, int, avformat_open_input,
        (AVFormatContext** ps, const char* url, const AVInputFormat* fmt, AVDictionary** options),
        (ps, url, fmt, options))
FORWARD(kFormat, int, avformat_write_header, (AVFormatContext* s, AVDictionary** options), (s, options))
FORWARD(kFormat, int, avio_closep, (AVIOContext** s), (s))
FORWARD(kFormat, int, avio_open, (AVIOContext** s, const char* url, int flags), (s, url, flags))

FORWARD(kScale, void, sws_freeContext, (SwsContext* context), (context))
FORWARD(kScale, SwsContext*, sws_getCachedContext,
        (SwsContext* context, int width_in, int height_in, AVPixelFormat format_in, int width_out, int
        height_out, AVPixelFormat format_out, int flags, SwsFilter* filter_in, SwsFilter* filter_out, const
        double* param),
        (context, width_in, height_in, format_in, width_out, height_out, format_out, flags, filter_in,
        filter_out, param))
FORWARD(kScale, int, sws_scale,
        (SwsContext* c, const std::uint8_t* const pixels_in[], const int stride_in[], int row, int rows,
        std::uint8_t* const pixels_out[], const int stride_out[]),
        (c, pixels_in, stride_in, row, rows, pixels_out, stride_out))
// clang-format on

#undef FORWARD
