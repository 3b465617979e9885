#include "sources/video_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <new>
#include <span>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

extern "C" {
#include <libavutil/display.h>
#include <libavutil/error.h>
#include <libavutil/log.h>
}

#include "core/error.hpp"
#include "core/frame_source.hpp"
#include "core/image_size.hpp"
#include "sources/times_file.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

constexpr const char* kVideoHint = "the file may be truncated or not a video";
constexpr const char* kBadChecksum = "the file is damaged here: its checksum does not fit";
// Rates and times of a damaged file may be anything.
constexpr double kLeastRateHz = 1e-3, kMostRateHz = 1e6;
// How many positions may be reported as lost: not many more than the file could hold if all of its bytes were
// images, since each of them takes memory.
constexpr std::int64_t kAlwaysLost = 1000, kMostLost = 1'000'000, kLeastImageBytes = 8;

thread_local VideoMessages* t_messages = nullptr;

std::string reason_of(int code) {
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
  av_strerror(code, text.data(), text.size());
  return text.data();
}

// Options of libavformat and libavcodec by name.
class Options {
 public:
  ~Options() { av_dict_free(&options_); }
  void set(const char* key, const std::string& value) { av_dict_set(&options_, key, value.c_str(), 0); }
  AVDictionary** get() { return &options_; }

 private:
  AVDictionary* options_ = nullptr;
};

Error no_video(int code, const fs::path& path) {
  return unreadable(fmt::format("no video that can be read: {}", reason_of(code)), path.string(),
                    code == AVERROR(EACCES) ? "check its permissions" : kVideoHint);
}

std::span<AVStream* const> streams_of(const AVFormatContext& format) {
  return {format.streams, format.nb_streams};
}

bool is_video(const AVStream& stream) { return stream.codecpar->codec_type == AVMEDIA_TYPE_VIDEO; }

// A value that the file gives to the stream; empty = none.
std::string_view value_of(const AVStream& stream, const char* key) {
  const AVDictionaryEntry* entry = av_dict_get(stream.metadata, key, nullptr, 0);
  return entry == nullptr ? "" : entry->value;
}

// libavformat writes raw 16-bit grey into AVI and MOV by these names, but does not know them when it reads.
void name_raw_grey(AVCodecParameters& codec) {
  if (codec.codec_type != AVMEDIA_TYPE_VIDEO || codec.codec_id != AV_CODEC_ID_NONE) return;
  const bool little = codec.codec_tag == MKTAG('Y', '1', 0, 16);
  if (!little && codec.codec_tag != MKTAG(16, 0, '1', 'Y')) return;
  codec.codec_id = AV_CODEC_ID_RAWVIDEO;
  codec.format = little ? AV_PIX_FMT_GRAY16LE : AV_PIX_FMT_GRAY16BE;
}

// A time of the container, at most kFarthestTime_us from 0.
std::int64_t to_us(std::int64_t time, AVRational unit) {
  const std::int64_t us = av_rescale_q(time, unit, {1, 1'000'000});
  if (us == INT64_MIN) return time < 0 ? -kFarthestTime_us : kFarthestTime_us;  // it does not fit
  return std::clamp(us, -kFarthestTime_us, kFarthestTime_us);
}

}  // namespace

void collect_video_message(void*, int level, const char* format, va_list arguments) {
  if (t_messages == nullptr || level > AV_LOG_ERROR || t_messages->error_) return;
  std::array<char, 256> text{};
  std::vsnprintf(text.data(), text.size(), format, arguments);
  std::string line = text.data();
  while (!line.empty() && (line.back() == '\n' || line.back() == ' ' || line.back() == '.')) line.pop_back();
  t_messages->error_ = line;
}

VideoMessages::VideoMessages() {
  t_messages = this;
  av_log_set_callback(collect_video_message);
}

VideoMessages::~VideoMessages() { t_messages = nullptr; }

VideoFile::VideoFile(const fs::path& path, std::string_view title)
    : path_(path), packet_(av_packet_alloc()), checksums_(path) {
  if (!packet_) throw std::bad_alloc();
  open();
  choose(title);
  std::error_code code;
  const std::uintmax_t bytes = fs::file_size(path_, code);
  const auto images =
      static_cast<std::int64_t>(code ? 0 : std::min<std::uintmax_t>(bytes, INT64_MAX)) / kLeastImageBytes;
  may_be_lost_ = std::clamp(images, kAlwaysLost, kMostLost);
}

void VideoFile::open() {
  VideoMessages messages;
  Options options;
  options.set("format_whitelist", kVideoFormats);
  options.set("protocol_whitelist", "file");
  AVFormatContext* format = nullptr;
  int code = avformat_open_input(&format, ("file:" + path_.string()).c_str(), nullptr, options.get());
  if (code == AVERROR(ENOMEM)) throw std::bad_alloc();
  if (code < 0) throw no_video(code, path_);
  format_.reset(format);
  // The codecs that look at the first images must not be led to allocate more, or to start threads.
  std::vector<Options> of_streams(format->nb_streams);
  std::vector<AVDictionary*> lists;
  for (Options& each : of_streams) {
    each.set("threads", "1");
    each.set("max_pixels", fmt::format("{}", kMostPixels));
    lists.push_back(*each.get());
    *each.get() = nullptr;
  }
  code = lists.empty() ? AVERROR_STREAM_NOT_FOUND : avformat_find_stream_info(format, lists.data());
  for (AVDictionary*& list : lists) av_dict_free(&list);
  if (code == AVERROR(ENOMEM)) throw std::bad_alloc();
  if (code < 0) throw no_video(code, path_);
  for (AVStream* stream : streams_of(*format_)) name_raw_grey(*stream->codecpar);
}

void VideoFile::choose(std::string_view title) {
  title_ = title;
  stream_ = find_stream(title);
  for (AVStream* stream : streams_of(*format_))
    stream->discard = stream == stream_ ? AVDISCARD_DEFAULT : AVDISCARD_ALL;
  check_size();
  rate_hz_ = kDefaultRateHz;
  const AVRational rate = av_guess_frame_rate(format_.get(), stream_, nullptr);
  if (const double hz = av_q2d(rate); rate.den != 0 && hz >= kLeastRateHz && hz <= kMostRateHz) rate_hz_ = hz;
}

AVStream* VideoFile::find_stream(std::string_view title) const {
  if (title.empty()) {
    VideoMessages messages;
    const int best = av_find_best_stream(format_.get(), AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
    if (best < 0) throw no_video(best, path_);
    return format_->streams[best];
  }
  const auto streams = streams_of(*format_);
  const auto found = std::ranges::find_if(streams, [&](const AVStream* stream) {
    return is_video(*stream) && value_of(*stream, "title") == title;
  });
  if (found == streams.end()) throw no_video(AVERROR_STREAM_NOT_FOUND, path_);
  return *found;
}

void VideoFile::check_size() const {
  if (codec().width < 1 || codec().height < 1) throw no_video(AVERROR_INVALIDDATA, path_);
  try {
    check_image_size(codec().width, codec().height);
  } catch (const std::runtime_error& error) {
    throw unreadable(error.what(), path_.string(), "reduce the images");
  }
}

// Reads on to the next packet of the stream; false at the end. Sets reason_ if a part of the file was
// skipped.
bool VideoFile::read_packet() {
  VideoMessages messages;
  for (;;) {
    av_packet_unref(packet_.get());
    const int code = av_read_frame(format_.get(), packet_.get());
    if (code == AVERROR(ENOMEM)) throw std::bad_alloc();
    if (const auto error = messages.take_error()) reason_ = "the file is damaged or truncated: " + *error;
    if (code < 0 && code != AVERROR_EOF && reason_.empty())
      reason_ = "the file is damaged: " + reason_of(code);
    if (code < 0) return false;
    if (packet_->stream_index == stream_->index) return true;
  }
}

std::int64_t VideoFile::time_of(const AVPacket& packet) const {
  const std::int64_t time = packet.pts == AV_NOPTS_VALUE ? packet.dts : packet.pts;
  if (time != AV_NOPTS_VALUE) return time_us(time);
  return std::llround(
      std::min(static_cast<double>(count_) * 1e6 / rate_hz_, static_cast<double>(kFarthestTime_us)));
}

std::int64_t VideoFile::start() const {
  return stream_->start_time == AV_NOPTS_VALUE ? 0 : stream_->start_time;
}

std::int64_t VideoFile::start_us() const { return to_us(start(), stream_->time_base); }

std::int64_t VideoFile::time_us(std::int64_t timestamp) const {
  std::int64_t since = 0;
  if (__builtin_sub_overflow(timestamp, start(), &since)) since = timestamp < 0 ? INT64_MIN : INT64_MAX;
  return to_us(since, stream_->time_base);
}

std::vector<std::string> VideoFile::titles() const {
  std::vector<std::string> result;
  for (const AVStream* stream : streams_of(*format_))
    if (is_video(*stream)) result.emplace_back(value_of(*stream, "title"));
  return result;
}

std::optional<std::string> VideoFile::attachment(std::string_view name) const {
  for (const AVStream* stream : streams_of(*format_)) {
    const AVCodecParameters& content = *stream->codecpar;
    if (content.codec_type == AVMEDIA_TYPE_ATTACHMENT && content.extradata_size > 0 &&
        value_of(*stream, "filename") == name)
      return std::string(content.extradata, content.extradata + content.extradata_size);
  }
  return std::nullopt;
}

double VideoFile::rotation_degrees() const {
  const std::uint8_t* matrix = av_stream_get_side_data(stream_, AV_PKT_DATA_DISPLAYMATRIX, nullptr);
  const double angle =
      matrix == nullptr ? 0 : av_display_rotation_get(reinterpret_cast<const std::int32_t*>(matrix));
  return std::isfinite(angle) ? angle : 0;
}

// The number of images that would fit between the last one and `time_us`.
std::int64_t VideoFile::missing_before(std::int64_t time_us) const {
  const double periods = static_cast<double>(time_us - last_us_) * rate_hz_ / 1e6;
  if (last_us_ < 0 || !(periods > 1.5)) return 0;
  return std::llround(std::min(periods, 1.0 + kMostLost)) - 1;
}

// The end that the container announces; std::nullopt if it announces none, or that of other streams too.
std::optional<std::int64_t> VideoFile::end_us() const {
  if (stream_->duration != AV_NOPTS_VALUE && stream_->duration > 0)
    return to_us(stream_->duration, stream_->time_base);
  if (format_->nb_streams == 1 && format_->duration != AV_NOPTS_VALUE && format_->duration > 0)
    return to_us(format_->duration, AV_TIME_BASE_Q);
  return std::nullopt;
}

// Where a part of the file is damaged, images may be missing before the packet that was read.
void VideoFile::look_for_gap() {
  damaged_ = checksums_.damaged_at(packet_->pos);
  const std::int64_t before = std::exchange(damaged_clusters_, checksums_.damaged_clusters());
  if (damaged_clusters_ != before && reason_.empty()) reason_ = kBadChecksum;
  if (!reason_.empty()) lose(missing_before(time_of(*packet_)));
}

void VideoFile::lose(std::int64_t images) {
  lost_ = std::min(images, may_be_lost_);
  may_be_lost_ -= lost_;
}

// By the number of images that the container announces, or else by its end: unless the images come at
// irregular times and the last one may simply last long.
std::int64_t VideoFile::lost_at_end() const {
  if (stream_->nb_frames > 0) return std::clamp<std::int64_t>(stream_->nb_frames - count_, 0, kMostLost);
  const auto end = end_us();
  return end && *end - last_us_ > longest_us_ + longest_us_ / 2 ? missing_before(*end) : 0;
}

void VideoFile::look_for_lost_end() {
  lose(lost_at_end());
  if (lost_ == 0 && !reason_.empty()) lost_ = 1;
  if (reason_.empty()) reason_ = "the file is truncated";
}

// Reads the next packet, if none waits.
void VideoFile::advance() {
  if (lost_ > 0 || waiting_ || at_end_) return;
  waiting_ = read_packet();
  at_end_ = !waiting_;
  if (waiting_) look_for_gap();
  if (at_end_) look_for_lost_end();
}

const AVPacket* VideoFile::peek() {
  advance();
  return lost_ == 0 && waiting_ ? packet_.get() : nullptr;
}

std::optional<VideoPacket> VideoFile::next() {
  advance();
  if (lost_ > 0) {
    --lost_;
    ++count_;
    last_us_ = std::min<std::int64_t>(last_us_ + std::llround(1e6 / rate_hz_), kFarthestTime_us);
    return VideoPacket{nullptr, last_us_, "the image is lost: " + reason_};
  }
  if (!waiting_) return std::nullopt;
  waiting_ = false;
  reason_.clear();
  VideoPacket result{packet_.get(), time_of(*packet_), ""};
  if ((packet_->flags & AV_PKT_FLAG_CORRUPT) != 0) result.problem = "the image is cut";
  if (damaged_) result.problem = kBadChecksum;
  if (last_us_ >= 0) longest_us_ = std::max(longest_us_, result.time_us - last_us_);
  last_us_ = std::max(last_us_, result.time_us);  // in the order of decoding they may go back
  ++count_;
  return result;
}

}  // namespace saccade
