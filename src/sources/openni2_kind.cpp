#include "core/error.hpp"
#include "sources/source_kind.hpp"
#ifdef SACCADE_OPENNI2
#include "drivers/openni2/openni2_source.hpp"
#endif

namespace saccade {
namespace {

#ifdef SACCADE_OPENNI2
constexpr bool kBuilt = true;
std::unique_ptr<FrameSource> open_sensor(const SourceInput& input, const SourceOptions& options) {
  return std::make_unique<OpenNi2Source>(input.uri, options.sensor);
}
#else
constexpr bool kBuilt = false;
std::unique_ptr<FrameSource> open_sensor(const SourceInput&, const SourceOptions&) {
  throw not_in_this_build("OpenNI2", "SACCADE_OPENNI2");
}
#endif

}  // namespace

extern const SourceKind kOpenNi2Kind = {
    .name = "openni2",
    .written = "openni2[:URI]",
    .help =
        "a live sensor: Xtion, PrimeSense, Kinect v1, the virtual device, or any with an OpenNI2 module; "
        "openni2:serial=NUMBER is a particular one; saccade devices lists them",
    .recognised_by = "openni2",
    .recognises =
        [](const SourceInput& input) { return input.uri == "openni2" || input.uri.starts_with("openni2:"); },
    .open = open_sensor,
    .is_path = false,
    .is_device = true,
    .built = kBuilt,
};

}  // namespace saccade
