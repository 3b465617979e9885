// Kinect v1 without one: fakenect, which stands in for libfreenect, plays sessions written here, and they
// come through our driver module and OpenNI2. In a subprocess, because fakenect must be loaded instead of the
// real library.
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <opencv2/core.hpp>

#include "core/file.hpp"
#include "drivers/modules/kinect_depth.hpp"
#include "oni/bytes.hpp"
#include "tests/support/folder_test.hpp"

namespace saccade {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

struct PlayedFrame {
  char sensor = 0;
  std::uint64_t timestamp_us = 0;
  cv::Size size;
  std::vector<std::uint8_t> bytes;
};

class FreenectTest : public FolderTest {
 protected:
  // Runs the player on a libfreenect that is found in `library`; what it prints.
  std::string play(const std::string& library, const std::string& environment, const std::string& arguments) {
    const std::string command = fmt::format(
        "{} LD_LIBRARY_PATH='{}' timeout 100 '" KINECT_PLAYER "' '{}' {} > '{}' 2>&1", environment, library,
        (folder_ / "frames").string(), arguments, (folder_ / "said").string());
    const int status = std::system(command.c_str());
    const auto said = read_file(folder_ / "said");
    const std::string text(said.begin(), said.end());
    EXPECT_EQ(status, 0) << text;
    return text;
  }

  std::vector<PlayedFrame> frames() const {
    const auto bytes = read_file(folder_ / "frames");
    ByteCursor cursor(bytes);
    std::vector<PlayedFrame> played;
    while (!cursor.rest().empty()) {
      PlayedFrame& frame = played.emplace_back();
      frame.sensor = cursor.take<char>().value();
      frame.timestamp_us = cursor.take<std::uint64_t>().value();
      frame.size.width = static_cast<int>(cursor.take<std::uint32_t>().value());
      frame.size.height = static_cast<int>(cursor.take<std::uint32_t>().value());
      const auto pixels = cursor.take_bytes(cursor.take<std::uint32_t>().value());
      if (!pixels) throw std::runtime_error("the player wrote half a frame");
      frame.bytes.assign(pixels->begin(), pixels->end());
    }
    return played;
  }
};

template <typename T>
std::vector<std::uint8_t> bytes_of(const std::vector<T>& values) {
  std::vector<std::uint8_t> bytes(values.size() * sizeof(T));
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

// A stand-in of our own (fake_freenect.cpp) has what fakenect lacks.
TEST_F(FreenectTest, RegisteredDepthAndInfraredComeThrough) {
  play(FAKE_FREENECT_FOLDER, "", "20 di");
  std::size_t depths = 0, infrareds = 0;
  std::uint64_t first_us = 0;
  for (const PlayedFrame& frame : frames()) {
    const bool depth = frame.sensor == 'd';
    EXPECT_EQ(frame.size, depth ? cv::Size(640, 480) : cv::Size(640, 488));
    std::vector<std::uint16_t> pixels(frame.bytes.size() / 2);
    std::memcpy(pixels.data(), frame.bytes.data(), frame.bytes.size());
    ASSERT_EQ(pixels.size(), static_cast<std::size_t>(frame.size.area()));
    const int number = pixels.front() - (depth ? 1000 : 300);
    if (first_us == 0) first_us = frame.timestamp_us - static_cast<std::uint64_t>(number) * 2'000'000 / 60;
    EXPECT_NEAR(static_cast<double>(frame.timestamp_us - first_us), number * 2e6 / 60, 2);
    EXPECT_EQ(std::count(pixels.begin(), pixels.end(), pixels.front()), frame.size.area());
    ++(depth ? depths : infrareds);
  }
  EXPECT_GE(depths, 1U);
  EXPECT_GE(infrareds, 1U);
}

TEST_F(FreenectTest, AKinectThatIsPulledOutIsLostAndFoundAgain) {
  const std::string said = play(FAKE_FREENECT_FOLDER, "FAKE_KINECT_FRAMES=5", "1000 d 1");
  EXPECT_THAT(said, HasSubstr("disconnected 1"));
  EXPECT_FALSE(frames().empty());
}

#ifdef FAKENECT_FOLDER

constexpr int kPixels = 640 * 480;

struct Session {
  std::map<std::uint64_t, std::vector<std::uint16_t>> raw;  // by time, us
  std::map<std::uint64_t, std::vector<std::uint8_t>> colour;
};

// Writes a fakenect session of `count` frames, whose clock restarts on the way.
Session write_session(const fs::path& folder, int count) {
  Session session;
  std::string index;
  std::uint64_t ticks = (std::uint64_t{1} << 32) + 4'294'000'000U;
  for (int k = 0; k < count; ++k, ticks += 2'000'000) {
    const double time_s = 1000 + 0.1 * k;
    std::vector<std::uint16_t> raw(kPixels);
    for (int i = 0; i < kPixels; ++i) {
      const int row = i / 640, column = i % 640;
      raw[static_cast<std::size_t>(i)] =
          static_cast<std::uint16_t>(column < 8 ? 2047 : (4 * row + column / 16 + k) % 2047);
    }
    std::vector<std::uint8_t> colour(3 * kPixels);
    for (int i = 0; i < kPixels; ++i)
      for (int c = 0; c < 3; ++c)
        colour[static_cast<std::size_t>(3 * i + c)] =
            static_cast<std::uint8_t>((c + 1) * (i % 640) + i / 640 + 5 * k);
    const auto write = [&](const std::string& name, std::string bytes, const auto& values) {
      const auto pixels = bytes_of(values);
      bytes.append(pixels.begin(), pixels.end());
      write_file(folder / name, bytes);
      index += name + "\n";
    };
    const auto low = [](std::uint64_t t) { return static_cast<std::uint32_t>(t); };
    write(fmt::format("d-{:.6f}-{}.pgm", time_s, low(ticks)), "P5 640 480 65535\n", raw);
    write(fmt::format("r-{:.6f}-{}.ppm", time_s + 0.005, low(ticks + 300'000)), "P6 640 480 255\n", colour);
    session.raw[ticks / 60] = raw;
    session.colour[(ticks + 300'000) / 60] = colour;
  }
  write_file(folder / "INDEX.txt", index);
  return session;
}

std::vector<std::uint8_t> depth_bytes(const std::vector<std::uint16_t>& raw) {
  const auto table = kinect_depth_table({});
  std::vector<std::uint16_t> depth;
  for (const std::uint16_t value : raw) depth.push_back(table[value]);
  return bytes_of(depth);
}

TEST_F(FreenectTest, AFakenectSessionArrivesCompleteAndEndsAsADisconnect) {
  const Session session = write_session(folder_, 12);
  const std::string said =
      play(FAKENECT_FOLDER, fmt::format("FAKENECT_PATH='{}'", folder_.string()), "1000 dc");
  EXPECT_THAT(said, HasSubstr("disconnected 1"));
  std::size_t depths = 0, colours = 0;
  for (const PlayedFrame& frame : frames()) {
    EXPECT_EQ(frame.size, cv::Size(640, 480));
    if (frame.sensor == 'd') {
      ASSERT_TRUE(session.raw.contains(frame.timestamp_us)) << frame.timestamp_us;
      EXPECT_TRUE(frame.bytes == depth_bytes(session.raw.at(frame.timestamp_us)));
      ++depths;
    } else {
      ASSERT_TRUE(session.colour.contains(frame.timestamp_us)) << frame.timestamp_us;
      EXPECT_TRUE(frame.bytes == session.colour.at(frame.timestamp_us));
      ++colours;
    }
  }
  // OpenNI2 hands on the newest frame, so a slow machine misses some, and colour starts after depth.
  EXPECT_GE(depths, 1U);
  EXPECT_GE(colours, 1U);
}

TEST_F(FreenectTest, AfterADisconnectTheDeviceComesBack) {
  write_session(folder_, 2);
  const std::string said =
      play(FAKENECT_FOLDER, fmt::format("FAKENECT_PATH='{}'", folder_.string()), "1000 d 1");
  EXPECT_THAT(said, HasSubstr("disconnected 1"));
}

#else

TEST_F(FreenectTest, AFakenectSessionArrivesCompleteAndEndsAsADisconnect) {
  GTEST_SKIP() << "fakenect is not installed beside libfreenect";
}

#endif

}  // namespace
}  // namespace saccade
