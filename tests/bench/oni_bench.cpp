// Reads a recording with Saccade's reader and with OpenNI2's player in the same run and prints the times:
//   oni_bench FILE.oni [FRAMES]
// First it records the depth frames of FILE repeatedly, until there are FRAMES of them (default 600), in a
// temporary file, once for each codec. Times are processor times of the process, so that a player gains
// nothing by threads of its own.
#include <OpenNI.h>
#include <unistd.h>

#include <chrono>
#include <ctime>
#include <filesystem>
#include <functional>
#include <random>

#include <fmt/format.h>

#include "core/error.hpp"
#include "oni/writer.hpp"
#include "sources/oni_source.hpp"
#include "tests/support/no_wait.hpp"

namespace {

namespace fs = std::filesystem;
using namespace saccade;

constexpr int kSeeks = 1000;

double processor_s() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

double wall_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Runs `read`, which returns the number of frames, and prints the times per frame; returns the processor time
// in ms.
double measure(const char* name, const std::function<int()>& read) {
  const double cpu = processor_s(), wall = wall_s();
  const int frames = read();
  const double cpu_ms = 1e3 * (processor_s() - cpu) / frames, wall_ms = 1e3 * (wall_s() - wall) / frames;
  fmt::print("{:<44} {:6} frames  {:.3f} ms processor  {:.3f} ms wall\n", name, frames, cpu_ms, wall_ms);
  return cpu_ms;
}

void make_recording(const fs::path& from, const fs::path& to, OniDepthCodec codec, int frames) {
  OniSource source(from);
  OniWriter writer(to, {.depth_codec = codec,
                        .colour_codec = OniColourCodec::off,
                        .rate_hz = source.info().rate_hz,
                        .overwrite = true});
  Frame frame;
  int read_in_turn = 0;
  for (int k = 0; k < frames;) {
    const ReadStatus status = source.read(frame, kNoWait).status;
    if (status == ReadStatus::end) {
      if (read_in_turn == 0) throw unreadable("no frame that decodes", from.string(), "");
      read_in_turn = 0;
      source.seek(0);
    }
    if (status != ReadStatus::frame) continue;
    ++read_in_turn;
    frame.timestamp_us = 33'333LL * k++;
    writer.write(frame);
  }
  writer.close();
}

int play_stock(const fs::path& file) {
  using namespace openni;
  Device device;
  VideoStream depth;
  if (OpenNI::initialize() != STATUS_OK || device.open(file.c_str()) != STATUS_OK ||
      depth.create(device, SENSOR_DEPTH) != STATUS_OK || depth.start() != STATUS_OK)
    throw unreadable("OpenNI2 cannot play it", file.string(), OpenNI::getExtendedError());
  PlaybackControl& control = *device.getPlaybackControl();
  control.setSpeed(-1);
  control.setRepeatEnabled(false);
  const int frames = control.getNumberOfFrames(depth);
  VideoFrameRef frame;
  for (int k = 0; k < frames; ++k)
    if (depth.readFrame(&frame) != STATUS_OK) throw unreadable("OpenNI2 stopped", file.string(), "");
  return frames;
}

int play_stored(const fs::path& file) {
  Recording recording(file);
  const OniNode& node = *main_depth(recording);
  cv::Mat1w depth;
  for (std::size_t k = 0; k < node.frames.size(); ++k)
    if (!recording.read_stored_depth(node, k, depth)) throw unreadable("a bad frame", file.string(), "");
  return static_cast<int>(node.frames.size());
}

int play_source(const fs::path& file) {
  OniSource source(file);
  Frame frame;
  int frames = 0;
  while (source.read(frame, kNoWait).status == ReadStatus::frame) ++frames;
  return frames;
}

int seek_at_random(OniSource& source) {
  std::mt19937 random(1);
  Frame frame;
  for (int k = 0; k < kSeeks; ++k) {
    source.seek(static_cast<std::int64_t>(random() % static_cast<unsigned>(*source.info().frame_count)));
    source.read(frame, kNoWait);
  }
  return kSeeks;
}

void compare(const fs::path& file, OniDepthCodec codec, const char* name, int frames) {
  const fs::path long_file = fs::temp_directory_path() / fmt::format("saccade_bench_{}.oni", ::getpid());
  make_recording(file, long_file, codec, frames);
  fmt::print("{} frames of depth in {}, {} bytes\n", frames, name, fs::file_size(long_file));
  play_stored(long_file);  // puts the file into the page cache
  const double ours = measure("Saccade, depth as stored", [&] { return play_stored(long_file); });
  measure("Saccade, depth in mm (OniSource)", [&] { return play_source(long_file); });
  OniSource source(long_file);
  measure("Saccade, random seeks, depth", [&] { return seek_at_random(source); });
  const double stock = measure("OpenNI2's player, depth as stored", [&] { return play_stock(long_file); });
  fmt::print("Saccade decodes depth {:.2f} times as fast per core as OpenNI2's player\n", stock / ours);
  fs::remove(long_file);
}

void run(const fs::path& file, int frames) {
  compare(file, OniDepthCodec::z16t, "16zT", frames);
  compare(file, OniDepthCodec::z16p, "16zP", frames);
  OniSource original(file);
  measure("Saccade, random seeks, depth and colour", [&] { return seek_at_random(original); });
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "usage: oni_bench FILE.oni [FRAMES]\n");
    return 2;
  }
  try {
    run(argv[1], argc > 2 ? std::stoi(argv[2]) : 600);
  } catch (const std::exception& error) {
    fmt::print(stderr, "oni_bench: {}\n", error.what());
    return 1;
  }
  // OpenNI2's shutdown can crash.
  std::_Exit(0);
}
