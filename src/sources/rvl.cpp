#include "sources/rvl.hpp"

#include <algorithm>
#include <stdexcept>

#include "oni/bytes.hpp"

namespace saccade {
namespace {

class NumberReader {
 public:
  explicit NumberReader(std::span<const std::uint8_t> data) : data_(data) {}

  std::uint32_t next() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 33; shift += 3) {
      const std::uint32_t group = next_group();
      value |= std::uint64_t{group & 7U} << shift;
      if ((group & 8U) == 0) return static_cast<std::uint32_t>(value);
    }
    throw std::runtime_error("damaged RVL: a number does not end");
  }

 private:
  std::uint32_t next_group() {
    if (left_ == 0) {
      if (data_.size() < 4) throw std::runtime_error("damaged RVL: it ends early");
      word_ = load_le<std::uint32_t>(data_.data());
      data_ = data_.subspan(4);
      left_ = 8;
    }
    --left_;
    return word_ >> (4 * left_) & 15U;
  }

  std::span<const std::uint8_t> data_;
  std::uint32_t word_ = 0;
  unsigned left_ = 0;  // groups of the word
};

}  // namespace

void decode_rvl(std::span<const std::uint8_t> data, cv::Mat1w& depth) {
  NumberReader reader(data);
  auto pixel = depth.begin();
  const auto take = [&] {
    const std::uint32_t count = reader.next();
    if (count > static_cast<std::size_t>(depth.end() - pixel))
      throw std::runtime_error("damaged RVL: more pixels than the image has");
    return count;
  };
  std::uint32_t value = 0;
  while (pixel != depth.end()) {
    const std::uint32_t zeros = take();
    pixel = std::fill_n(pixel, zeros, std::uint16_t{0});
    const std::uint32_t others = take();
    if (zeros == 0 && others == 0) throw std::runtime_error("damaged RVL: a run of nothing");
    for (std::uint32_t i = 0; i < others; ++i, ++pixel) {
      const std::uint32_t difference = reader.next();
      value += (difference >> 1) ^ (0U - (difference & 1U));
      *pixel = static_cast<std::uint16_t>(value);
    }
  }
}

}  // namespace saccade
