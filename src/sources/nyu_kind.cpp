#include "core/error.hpp"
#include "sources/source_kind.hpp"
#ifdef SACCADE_HDF5
#include "sources/nyu_source.hpp"
#endif

namespace saccade {
namespace {

constexpr std::string_view kEndings[] = {".mat"};

#ifdef SACCADE_HDF5
constexpr bool kBuilt = true;
std::unique_ptr<FrameSource> open(const SourceInput& input, const SourceOptions& options) {
  return open_nyu(input.path, options.input);
}
#else
constexpr bool kBuilt = false;
std::unique_ptr<FrameSource> open(const SourceInput&, const SourceOptions&) {
  throw not_in_this_build("HDF5", "SACCADE_HDF5");
}
#endif

}  // namespace

extern const SourceKind kNyuKind = {
    .name = "nyu",
    .written = "FILE.mat",
    .help = "the labelled data set of NYU Depth V2 (MATLAB 7.3)",
    .recognised_by = "the ending",
    .endings = kEndings,
    .open = open,
    .built = kBuilt,
};

}  // namespace saccade
