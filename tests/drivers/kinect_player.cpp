// Plays a Kinect through OpenNI2 and our driver module, and writes the frames to a file: for each frame u8
// sensor ('d' depth, 'c' colour, 'i' infrared), u64 time, u32 width, u32 height, u32 bytes and the bytes; at
// the end it prints how often OpenNI2 reported a device. It is a program of its own because the test replaces
// libfreenect in it, which may end the process.
// Usage: kinect_player OUT FRAMES SENSORS [RETURNS]. It plays until FRAMES frames came or the device was
// lost; then, with RETURNS, until the device has come back RETURNS times.
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "openni_device.hpp"

namespace {

using namespace openni;

template <typename T>
void put(std::ofstream& out, T value) {
  out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

void write_frame(std::ofstream& out, char sensor, const VideoFrameRef& frame) {
  put(out, sensor);
  put(out, std::uint64_t{frame.getTimestamp()});
  put(out, static_cast<std::uint32_t>(frame.getWidth()));
  put(out, static_cast<std::uint32_t>(frame.getHeight()));
  put(out, static_cast<std::uint32_t>(frame.getDataSize()));
  out.write(static_cast<const char*>(frame.getData()), frame.getDataSize());
}

SensorType sensor_of(char letter) {
  return letter == 'd' ? SENSOR_DEPTH : letter == 'c' ? SENSOR_COLOR : SENSOR_IR;
}

int fail(const char* what) {
  std::fprintf(stderr, "kinect_player: %s: %s\n", what, OpenNI::getExtendedError());
  return 1;
}

// Writes the frames of one connection; false if it could not begin.
bool play(Device& device, const std::string& sensors, int frames, std::ofstream& out,
          saccade::DeviceEvents& events) {
  std::vector<std::unique_ptr<VideoStream>> streams;
  std::vector<VideoStream*> waited;
  for (const char letter : sensors) {
    auto& stream = streams.emplace_back(std::make_unique<VideoStream>());
    if (stream->create(device, sensor_of(letter)) != STATUS_OK || stream->start() != STATUS_OK) return false;
    waited.push_back(stream.get());
  }
  while (frames > 0 && events.count("disconnected") == 0) {
    int ready = 0;
    if (OpenNI::waitForAnyStream(waited.data(), static_cast<int>(waited.size()), &ready, 100) != STATUS_OK)
      continue;
    VideoFrameRef frame;
    if (waited[static_cast<std::size_t>(ready)]->readFrame(&frame) != STATUS_OK) continue;
    write_frame(out, sensors[static_cast<std::size_t>(ready)], frame);
    --frames;
  }
  for (const auto& stream : streams) stream->stop();
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) return 2;
  if (OpenNI::initialize() != STATUS_OK) return fail("initialize");
  {
    saccade::DeviceEvents events;
    Device device;
    if (device.open("freenect://0") != STATUS_OK) return fail("open");
    if (device.isImageRegistrationModeSupported(IMAGE_REGISTRATION_DEPTH_TO_COLOR) &&
        device.setImageRegistrationMode(IMAGE_REGISTRATION_DEPTH_TO_COLOR) != STATUS_OK)
      return fail("registration");
    std::ofstream out(argv[1], std::ios::binary);
    if (!play(device, argv[3], std::atoi(argv[2]), out, events)) return fail("streams");
    device.close();
    if (argc > 4 && !events.wait_for("connected", std::atoi(argv[4]))) return fail("return");
    if (argc > 4 && device.open("freenect://0") != STATUS_OK) return fail("open again");
    std::printf("disconnected %d\n", events.count("disconnected"));
  }
  OpenNI::shutdown();
  return 0;
}
