// The libFuzzer target of the recording reader.
#include "tests/oni/exercise.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  saccade::exercise({data, size});
  return 0;
}
