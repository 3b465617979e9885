#include <benchmark/benchmark.h>

#include "register.hpp"

int main(int argc, char** argv) {
  saccade::register_benchmarks();  // not by a global object: sources can be opened in main() only
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
