// The libFuzzer target: reads any bytes as a recording. Built with clang by -DSACCADE_FUZZ=ON.
#include "exercise.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  saccade::exercise({data, size});
  return 0;
}
