// Writes the seed recordings of the fuzzer into a folder. usage: oni_make_corpus FOLDER
#include <cstdio>

#include "mutator.hpp"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::filesystem::path folder(argv[1]);
  std::filesystem::create_directories(folder);
  int number = 0;
  for (const auto& seed : saccade::seed_recordings(std::filesystem::temp_directory_path()))
    saccade::write_bytes(folder / ("seed" + std::to_string(number++)), seed);
  std::printf("%d recordings in %s\n", number, argv[1]);
}
