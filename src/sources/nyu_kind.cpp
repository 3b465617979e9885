#include "sources/nyu_source.hpp"
#include "sources/source_kind.hpp"

namespace saccade {
namespace {

constexpr std::string_view kNyuEndings[] = {".mat"};

std::unique_ptr<FrameSource> open_file(const SourceInput& input, const SourceOptions& options) {
  return open_nyu(input.path, options.input);
}

}  // namespace

extern const SourceKind kNyuKind = {
    .name = "nyu",
    .written = "FILE.mat",
    .help = "the labelled data set of NYU Depth V2 (MATLAB 7.3)",
    .recognised_by = "the ending",
    .endings = kNyuEndings,
    .open = open_file,
};

}  // namespace saccade
