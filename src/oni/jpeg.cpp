#include "oni/jpeg.hpp"

#include <turbojpeg.h>

#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "core/error.hpp"

namespace saccade {
namespace {

bool has_usable_components(int components) { return components == 1 || components == 3; }

}  // namespace

// The declaration is in the first frame header (SOF0 to SOF2).
std::optional<cv::Size> jpeg_size(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < 4 || bytes[0] != 0xFF || bytes[1] != 0xD8) return std::nullopt;
  std::size_t at = 2;
  while (at + 4 <= bytes.size()) {
    if (bytes[at] != 0xFF) return std::nullopt;
    const unsigned marker = bytes[at + 1];
    if (marker == 0xFF) {  // fill byte
      ++at;
      continue;
    }
    const std::size_t length = static_cast<std::size_t>(bytes[at + 2]) << 8 | bytes[at + 3];
    if (marker >= 0xC0 && marker <= 0xC2) {
      if (length < 8 || at + 10 > bytes.size()) return std::nullopt;
      if (!has_usable_components(bytes[at + 9])) return std::nullopt;
      return cv::Size(bytes[at + 7] << 8 | bytes[at + 8], bytes[at + 5] << 8 | bytes[at + 6]);
    }
    // The image data, its end, or a frame of a kind that no camera makes.
    const bool other_frame =
        marker >= 0xC3 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
    if (length < 2 || marker == 0xDA || marker == 0xD9 || other_frame) return std::nullopt;
    at += 2 + length;
  }
  return std::nullopt;
}

struct JpegCodec::Handles {
  tjhandle decompress = tjInitDecompress();
  tjhandle compress = tjInitCompress();
  ~Handles() {
    if (decompress != nullptr) tjDestroy(decompress);
    if (compress != nullptr) tjDestroy(compress);
  }
};

JpegCodec::JpegCodec() : handles_(std::make_unique<Handles>()) {
  if (handles_->decompress == nullptr || handles_->compress == nullptr)
    throw failed("cannot start libjpeg-turbo", tjGetErrorStr(), "there may be too little memory");
}

JpegCodec::~JpegCodec() = default;

Outcome JpegCodec::decode(std::span<const std::uint8_t> payload, cv::Size size, cv::Mat3b& image,
                          JpegWarning warning) {
  const auto declared = jpeg_size(payload);
  if (!declared) return Outcome::failure("not a JPEG image");
  if (*declared != size)
    return Outcome::failure(fmt::format("a JPEG of {} x {} instead of {} x {}", declared->width,
                                        declared->height, size.width, size.height));
  // Even a flat image takes at least one bit for 64 pixels.
  if (static_cast<std::size_t>(size.area()) / 512 > payload.size())
    return Outcome::failure("a JPEG too short for its size");
  image.create(size);
  const bool is_strict = warning == JpegWarning::is_damage;
  const int code = tjDecompress2(handles_->decompress, payload.data(), payload.size(), image.data, size.width,
                                 static_cast<int>(image.step[0]), size.height, TJPF_BGR,
                                 (is_strict ? TJFLAG_STOPONWARNING : 0) | TJFLAG_LIMITSCANS);
  if (code != 0 && (is_strict || tjGetErrorCode(handles_->decompress) != TJERR_WARNING))
    return Outcome::failure(fmt::format("damaged JPEG: {}", tjGetErrorStr2(handles_->decompress)));
  return Outcome::success();
}

void JpegCodec::encode(const cv::Mat3b& image, int quality, std::vector<std::uint8_t>& payload) {
  if (image.empty() || quality < 1 || quality > 100)
    throw std::invalid_argument("JpegCodec: an image and a quality of 1..100 are needed");
  const std::size_t start = payload.size();
  payload.resize(start + tjBufSize(image.cols, image.rows, TJSAMP_420));
  unsigned char* out = payload.data() + start;
  unsigned long written = payload.size() - start;
  const int code =
      tjCompress2(handles_->compress, image.data, image.cols, static_cast<int>(image.step[0]), image.rows,
                  TJPF_BGR, &out, &written, TJSAMP_420, quality, TJFLAG_NOREALLOC | TJFLAG_ACCURATEDCT);
  if (code != 0) throw failed("cannot encode a JPEG", tjGetErrorStr2(handles_->compress), "");
  payload.resize(start + written);
}

}  // namespace saccade
