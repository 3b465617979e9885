// The libFuzzer target of a parser, whose name is compiled in.
#include "parsers.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const saccade::FuzzedParser& parser = saccade::fuzzed_parser(SACCADE_FUZZED_PARSER);
  static_cast<void>(parser.read({data, size}));
  return 0;
}
