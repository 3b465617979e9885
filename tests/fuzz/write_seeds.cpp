// Writes the seeds of the fuzzers, each parser's into a folder of its own. usage: fuzz_seeds FOLDER
#include <cstdio>
#include <filesystem>

#include "core/file.hpp"
#include "parsers.hpp"
#include "tests/oni/mutator.hpp"

namespace {

void write_seeds(const std::filesystem::path& folder, const std::vector<saccade::Bytes>& seeds) {
  std::filesystem::create_directories(folder);
  for (std::size_t i = 0; i < seeds.size(); ++i)
    saccade::write_file(folder / ("seed" + std::to_string(i)), seeds[i]);
  std::printf("%zu seeds in %s\n", seeds.size(), folder.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::filesystem::path folder(argv[1]);
  for (const saccade::FuzzedParser& parser : saccade::fuzzed_parsers())
    write_seeds(folder / parser.name, parser.seeds());
  write_seeds(folder / "oni", saccade::seed_recordings(std::filesystem::temp_directory_path()));
}
