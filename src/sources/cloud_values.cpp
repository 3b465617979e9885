#include "sources/cloud_values.hpp"

#include <algorithm>
#include <cstring>

namespace saccade {

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  constexpr std::string_view kBlank = " \t\r";
  for (std::size_t begin = 0; (begin = line.find_first_not_of(kBlank, begin)) != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(kBlank, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = end;
  }
  return words;
}

double float_at(const std::uint8_t* bytes, std::size_t size) {
  if (size == 8) {
    double value = 0;
    std::memcpy(&value, bytes, 8);
    return value;
  }
  float value = 0;
  std::memcpy(&value, bytes, 4);
  return static_cast<double>(value);
}

}  // namespace saccade
