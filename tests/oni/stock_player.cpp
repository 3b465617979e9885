// Plays the depth of a recording with OpenNI2's own player and writes its frames to a file: for each u64
// time, u32 number, u32 width, u32 height and the pixels, u16 each. A program of its own, because that player
// may crash or hang. usage: stock_player FILE.oni OUT
#include <OpenNI.h>

#include <cstdint>
#include <cstdio>
#include <fstream>

namespace {

int fail(const char* what) {
  std::fprintf(stderr, "stock_player: %s: %s\n", what, openni::OpenNI::getExtendedError());
  return 1;
}

template <typename T>
void put(std::ofstream& out, T value) {
  out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  using namespace openni;
  if (OpenNI::initialize() != STATUS_OK) return fail("initialize");
  Device device;
  if (device.open(argv[1]) != STATUS_OK) return fail("open");
  PlaybackControl* control = device.getPlaybackControl();
  if (control == nullptr) return fail("playback");
  control->setSpeed(-1);  // each readFrame() returns the next frame
  control->setRepeatEnabled(false);
  VideoStream depth;
  if (depth.create(device, SENSOR_DEPTH) != STATUS_OK || depth.start() != STATUS_OK)
    return fail("depth stream");
  std::ofstream out(argv[2], std::ios::binary);
  const int frames = control->getNumberOfFrames(depth);
  for (int k = 0; k < frames; ++k) {
    VideoStream* streams[] = {&depth};
    int ready = 0;
    if (OpenNI::waitForAnyStream(streams, 1, &ready, 3000) != STATUS_OK) break;
    VideoFrameRef frame;
    if (depth.readFrame(&frame) != STATUS_OK) break;
    put(out, std::uint64_t{frame.getTimestamp()});
    put(out, static_cast<std::uint32_t>(frame.getFrameIndex()));
    put(out, static_cast<std::uint32_t>(frame.getWidth()));
    put(out, static_cast<std::uint32_t>(frame.getHeight()));
    out.write(static_cast<const char*>(frame.getData()), frame.getDataSize());
  }
  out.close();
  // Its shutdown may crash; the frames are written already.
  std::fflush(nullptr);
  std::_Exit(0);
}
