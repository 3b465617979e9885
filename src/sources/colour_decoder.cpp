#include "sources/colour_decoder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <utility>

extern "C" {
#include <libavutil/display.h>
#include <libswscale/swscale.h>
}

#include "core/error.hpp"
#include "core/image_size.hpp"

namespace saccade {
namespace {

constexpr const char* kDependent = "it depends on an image that is lost or damaged";

// Turns what a camera held upright or on its head has recorded.
void turn_upright(double angle_degrees, cv::Mat3b& image) {
  const int quarters = static_cast<int>(std::lround(angle_degrees / 90)) & 3;  // counterclockwise
  constexpr std::array<int, 4> kTurns = {-1, cv::ROTATE_90_COUNTERCLOCKWISE, cv::ROTATE_180,
                                         cv::ROTATE_90_CLOCKWISE};
  if (quarters != 0) cv::rotate(image, image, kTurns[static_cast<std::size_t>(quarters)]);
}

}  // namespace

void ColourDecoder::FreeScaler::operator()(SwsContext* scaler) const { sws_freeContext(scaler); }

ColourDecoder::ColourDecoder(std::unique_ptr<VideoFile> file)
    : file_(std::move(file)), frame_(av_frame_alloc()), bgr_(av_frame_alloc()) {
  const AVCodec* codec = avcodec_find_decoder(file_->codec().codec_id);
  const auto refuse = [&](const std::string& why) {
    return unreadable("this video cannot be decoded: " + why, file_->path().string(),
                      "the file may be damaged");
  };
  if (codec == nullptr)
    throw refuse(std::string("unknown codec ") + avcodec_get_name(file_->codec().codec_id));
  context_.reset(avcodec_alloc_context3(codec));
  if (!frame_ || !bgr_ || !context_) throw std::bad_alloc();
  if (avcodec_parameters_to_context(context_.get(), &file_->codec()) < 0) throw std::bad_alloc();
  context_->pkt_timebase = file_->time_base();
  context_->thread_count = 1;  // so that its messages come on this thread
  context_->max_pixels = kMostPixels;
  context_->err_recognition = AV_EF_CRCCHECK | AV_EF_EXPLODE;  // errors instead of invented pixels
  context_->flags |= AV_CODEC_FLAG_OUTPUT_CORRUPT;             // with a mark, instead of leaving them out
  VideoMessages messages;
  const int code = avcodec_open2(context_.get(), codec, nullptr);
  if (code == AVERROR(ENOMEM)) throw std::bad_alloc();
  if (code < 0) throw refuse(messages.take_error().value_or("damaged header"));
  intra_only_ = (avcodec_descriptor_get(codec->id)->props & AV_CODEC_PROP_INTRA_ONLY) != 0;
}

std::optional<ColourPicture> ColourDecoder::next() {
  while (ready_.empty() && !at_end_) decode_packet();
  if (ready_.empty()) return std::nullopt;
  ColourPicture picture = std::move(ready_.front());
  ready_.pop_front();
  return picture;
}

void ColourDecoder::decode_packet() {
  const auto position = file_->next();
  if (!position) return finish();
  const std::int64_t number = ++number_;
  if (position->packet == nullptr) return lose({position->time_us, group_, false}, number, position->problem);
  const AVPacket& packet = *position->packet;
  if ((packet.flags & AV_PKT_FLAG_KEY) != 0) damaged_.erase(damaged_.begin(), damaged_.lower_bound(group_++));
  const Waiting waiting{position->time_us, group_,
                        intra_only_ || (packet.flags & AV_PKT_FLAG_DISPOSABLE) != 0};
  if (!position->problem.empty())
    lose(waiting, number, position->problem);
  else if ((packet.flags & AV_PKT_FLAG_DISCARD) == 0)  // else it is not to be shown
    waiting_[number] = waiting;
  VideoMessages messages;
  context_->reordered_opaque = number;
  int code = avcodec_send_packet(context_.get(), &packet);
  const int received = receive_pictures();
  if (code >= 0) code = received;
  if (code == AVERROR(ENOMEM)) throw std::bad_alloc();
  if (code < 0 && code != AVERROR(EAGAIN) && code != AVERROR_EOF && waiting_.contains(number))
    lose(waiting, number, "damaged: " + messages.take_error().value_or("it cannot be decoded"));
}

// What the decoder holds back, and what never came.
void ColourDecoder::finish() {
  at_end_ = true;
  VideoMessages messages;
  avcodec_send_packet(context_.get(), nullptr);
  if (receive_pictures() == AVERROR(ENOMEM)) throw std::bad_alloc();
  // Other codecs have packets that are not to be shown.
  if (intra_only_)
    for (const auto& [number, waiting] : waiting_) lost_.emplace(waiting.time_us, "it cannot be decoded");
  for (auto& [time_us, problem] : lost_) ready_.push_back({time_us, {}, std::move(problem)});
  lost_.clear();
}

// Returns the code with which the decoder ended.
int ColourDecoder::receive_pictures() {
  for (;;) {
    const int code = avcodec_receive_frame(context_.get(), frame_.get());
    if (code < 0) return code;
    const auto found = waiting_.extract(frame_->reordered_opaque);
    if (!found.empty()) take_picture(found.mapped(), found.key());
  }
}

void ColourDecoder::take_picture(Waiting waiting, std::int64_t number) {
  if (frame_->best_effort_timestamp != AV_NOPTS_VALUE)
    waiting.time_us = file_->time_us(frame_->best_effort_timestamp);
  if (frame_->decode_error_flags != 0 || (frame_->flags & AV_FRAME_FLAG_CORRUPT) != 0)
    return lose(waiting, number, "damaged: the decoder had to guess a part of it");
  if (depends_on_damage(waiting, number)) return lose(waiting, number, kDependent);
  ColourPicture picture{waiting.time_us, {}, ""};
  convert(picture.image);
  deliver(std::move(picture));
}

// Those that are lost have their place before it.
void ColourDecoder::deliver(ColourPicture picture) {
  const auto later = lost_.lower_bound(picture.time_us);
  for (auto each = lost_.begin(); each != later; each = lost_.erase(each))
    ready_.push_back({each->first, {}, std::move(each->second)});
  ready_.push_back(std::move(picture));
}

void ColourDecoder::lose(const Waiting& waiting, std::int64_t number, const std::string& problem) {
  waiting_.erase(number);
  lost_.emplace(waiting.time_us, problem);
  if (!waiting.spares_others && !intra_only_) damaged_.try_emplace(waiting.group, number);
}

bool ColourDecoder::depends_on_damage(const Waiting& waiting, std::int64_t number) const {
  const auto damage = damaged_.find(waiting.group);
  return damage != damaged_.end() && damage->second < number;
}

// By way of memory with room at the end of each row, which the conversion may write to.
void ColourDecoder::convert(cv::Mat3b& image) {
  const int width = frame_->width, height = frame_->height;
  scaler_.reset(sws_getCachedContext(scaler_.release(), width, height,
                                     static_cast<AVPixelFormat>(frame_->format), width, height,
                                     AV_PIX_FMT_BGR24, SWS_BICUBIC, nullptr, nullptr, nullptr));
  if (!scaler_) throw std::bad_alloc();
  if (bgr_->width != width || bgr_->height != height) {
    av_frame_unref(bgr_.get());
    bgr_->format = AV_PIX_FMT_BGR24;
    bgr_->width = width;
    bgr_->height = height;
    if (av_frame_get_buffer(bgr_.get(), 0) < 0) throw std::bad_alloc();
  }
  sws_scale(scaler_.get(), frame_->data, frame_->linesize, 0, height, bgr_->data, bgr_->linesize);
  cv::Mat3b(height, width, reinterpret_cast<cv::Vec3b*>(bgr_->data[0]),
            static_cast<std::size_t>(bgr_->linesize[0]))
      .copyTo(image);
  turn_upright(file_->rotation_degrees(), image);
}

}  // namespace saccade
