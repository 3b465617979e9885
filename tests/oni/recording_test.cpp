#include "oni/recording.hpp"

#include <random>

#include <gmock/gmock.h>

#include "core/error.hpp"
#include "oni_fixtures.hpp"
#include "tests/support/outcome.hpp"

namespace saccade {
namespace {

using ::testing::HasSubstr;
using Bytes = std::vector<std::uint8_t>;

class RecordingTest : public OniFiles {
 protected:
  // A file of one stream with these payloads; `properties` may add some before the first frame.
  std::filesystem::path make(const TestStream& stream, const std::vector<Bytes>& payloads,
                             const std::function<void(OniRecordWriter&)>& properties = {}) {
    OniRecordWriter writer(path("made.oni"), true);
    add_test_stream(writer, 1, stream);
    if (properties) properties(writer);
    writer.begin();
    for (std::size_t k = 0; k < payloads.size(); ++k)
      EXPECT_TRUE(writer.write_frame(1, 33333 * k, payloads[k]));
    writer.close();
    return path("made.oni");
  }

  cv::Mat1f depth_of(const std::filesystem::path& file, std::size_t k = 0) {
    Recording recording(file);
    cv::Mat1f depth;
    EXPECT_TRUE(succeeded(recording.read_depth(recording.index().nodes.at(0), k, depth)));
    return depth;
  }

  cv::Mat3b colour_of(const std::filesystem::path& file) {
    Recording recording(file);
    cv::Mat3b colour;
    EXPECT_TRUE(succeeded(recording.read_colour(recording.index().nodes.at(0), 0, colour)));
    return colour;
  }

  Outcome read_frame(const std::filesystem::path& file, std::size_t k = 0) {
    Recording recording(file);
    const OniNode& node = recording.index().nodes.at(0);
    cv::Mat1f depth;
    cv::Mat3b colour;
    return node.declared.type == OniNodeType::depth ? recording.read_depth(node, k, depth)
                                                    : recording.read_colour(node, k, colour);
  }
};

Bytes words(const std::vector<std::uint16_t>& values) {
  ByteBuilder bytes;
  for (const std::uint16_t value : values) bytes.put(value);
  return bytes.take();
}

TEST_F(RecordingTest, DepthUnitsBecomeMillimetres) {
  const Bytes payload = words({0, 1, 9, 10, 11, 12345, 65535, 65534, 4, 5, 6, 7});
  const cv::Mat1f mm = depth_of(make({}, {payload}));
  EXPECT_EQ(mm.size(), cv::Size(4, 3));
  EXPECT_EQ(mm(1, 1), 12345.0f);
  EXPECT_EQ(mm(1, 2), 0.0f) << "no reading";
  EXPECT_EQ(mm(1, 3), 65534.0f);
  const cv::Mat1f tenths = depth_of(make({.pixels = OniPixelFormat::depth_100um}, {payload}));
  EXPECT_EQ(tenths(0, 2), 0.9f);
  EXPECT_EQ(tenths(1, 2), 0.0f);
  EXPECT_EQ(tenths(1, 3), 6553.4f);
}

TEST_F(RecordingTest, ShiftsAreConvertedByTheirTable) {
  const TestStream stream{.pixels = OniPixelFormat::shift_9_2};
  const Bytes payload = words({0, 1, 2, 3, 2047, 4, 65535, 0, 0, 0, 0, 1});
  const auto file = make(stream, {payload}, [](OniRecordWriter& writer) {
    writer.add_property(1, OniRecordType::general_property, oni_property::kShiftToDepth,
                        words({0, 500, 600, 700, 65535}));
  });
  const cv::Mat1f mm = depth_of(file);
  EXPECT_EQ(mm(0, 1), 500.0f);
  EXPECT_EQ(mm(0, 3), 700.0f);
  EXPECT_EQ(mm(1, 0), 0.0f) << "a shift beyond the table is no reading";
  EXPECT_EQ(mm(1, 1), 0.0f) << "nor is 65535 in the table a length";
  EXPECT_EQ(mm(1, 2), 0.0f);
  EXPECT_THAT(read_frame(make(stream, {payload})).reason(), HasSubstr("S2D"));
}

TEST_F(RecordingTest, CroppedFramesLieAtTheirPlaceInTheImage) {
  const auto file =
      make({}, {words({11, 12, 13, 14}), words({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}), words({1, 2})},
           [](OniRecordWriter& writer) {
             ByteBuilder crop;
             crop.put(std::uint32_t{1});
             for (const int v : {1, 1, 2, 2}) crop.put(static_cast<std::uint16_t>(v));
             writer.add_property(1, OniRecordType::general_property, oni_property::kCropping, crop.bytes());
           });
  const cv::Mat1f cropped = (cv::Mat1f(3, 4) << 0, 0, 0, 0, 0, 11, 12, 0, 0, 13, 14, 0);
  EXPECT_TRUE(equal(depth_of(file, 0), cropped));
  EXPECT_EQ(depth_of(file, 1)(2, 3), 12.0f)
      << "a full frame, as after cropping was switched off without a record";
  EXPECT_THAT(read_frame(file, 2).reason(), HasSubstr("instead of 8"));
}

TEST_F(RecordingTest, ColourFormatsBecomeBgr) {
  const TestStream rgb{.type = OniNodeType::image, .pixels = OniPixelFormat::rgb888, .width = 2, .height = 1};
  EXPECT_EQ(colour_of(make(rgb, {{1, 2, 3, 4, 5, 6}}))(0, 1), cv::Vec3b(6, 5, 4));
  TestStream grey = rgb;
  grey.pixels = OniPixelFormat::grey8;
  EXPECT_EQ(colour_of(make(grey, {{7, 9}}))(0, 1), cv::Vec3b(9, 9, 9));
  TestStream infrared = rgb;
  infrared.type = OniNodeType::ir;
  infrared.pixels = OniPixelFormat::grey16;
  const cv::Mat3b ir = colour_of(make(infrared, {words({1023, 4000})}));
  EXPECT_EQ(ir(0, 0), cv::Vec3b(255, 255, 255));
  EXPECT_EQ(ir(0, 1), cv::Vec3b(255, 255, 255));
  // Grey in both orders of luma and chroma; a chroma of 128 is neutral.
  TestStream yuv = rgb;
  yuv.pixels = OniPixelFormat::yuv422;
  const cv::Vec3b light = colour_of(make(yuv, {{128, 16, 128, 235}}))(0, 1);
  EXPECT_EQ(light, cv::Vec3b(255, 255, 255));
  yuv.pixels = OniPixelFormat::yuyv;
  EXPECT_EQ(colour_of(make(yuv, {{16, 128, 235, 128}}))(0, 1), light);
  EXPECT_EQ(colour_of(make(yuv, {{16, 128, 235, 128}}))(0, 0), cv::Vec3b(0, 0, 0));
  TestStream packed = rgb;
  packed.codec = OniCodec::z8;
  EXPECT_EQ(colour_of(make(packed, {{50, 0xE2, 0x6D}}))(0, 1), cv::Vec3b(50, 50, 50));
}

TEST_F(RecordingTest, AJpegOfAnotherSizeOrTruncatedIsABadFrame) {
  const Frame frame = test_frame(1, {16, 8}, true);
  Bytes payload;
  JpegCodec().encode(frame.colour, 90, payload);
  TestStream stream{.type = OniNodeType::image, .codec = OniCodec::jpeg, .pixels = OniPixelFormat::rgb888};
  EXPECT_THAT(read_frame(make(stream, {payload})).reason(), HasSubstr("16 x 8 instead of 4 x 3"));
  stream.width = 16;
  stream.height = 8;
  EXPECT_TRUE(succeeded(read_frame(make(stream, {payload}))));
  for (std::size_t cut = 0; cut < payload.size(); cut += 7)
    EXPECT_FALSE(read_frame(
        make(stream, {Bytes(payload.begin(), payload.begin() + static_cast<std::ptrdiff_t>(cut))})))
        << cut;
  EXPECT_FALSE(read_frame(make(stream, {Bytes(payload.size(), 0x5A)})));
}

TEST_F(RecordingTest, HostileNumbersMakeAStreamUnusable) {
  const std::vector<std::pair<TestStream, std::string>> cases = {
      {{.width = 0}, "size"},
      {{.height = 0}, "size"},
      {{.width = 0xFFFFFFFF, .height = 0xFFFFFFFF}, "size"},
      {{.width = 8192, .height = 8192}, "size"},
      {{.codec = OniCodec{}}, "codec"},
      {{.codec = OniCodec::jpeg}, "cannot hold"},
      {{.pixels = OniPixelFormat::rgb888}, "pixel format"},
      {{.pixels = OniPixelFormat{77}}, "pixel format"},
      {{.type = OniNodeType::image, .codec = OniCodec::z16t, .pixels = OniPixelFormat::rgb888},
       "cannot hold"},
      {{.type = OniNodeType::image, .pixels = OniPixelFormat::yuyv, .width = 3}, "odd width"},
  };
  for (const auto& [stream, why] : cases)
    EXPECT_THAT(read_frame(make(stream, {{1, 2, 3}})).reason(), HasSubstr(why));
}

TEST_F(RecordingTest, AHugeSizeIsNotAllocatedForASmallPayload) {
  const auto file = make({.width = 4000, .height = 4000}, {words({1, 2, 3})});
  Recording recording(file);
  EXPECT_EQ(main_depth(recording), nullptr);
  for (const OniCodec codec : {OniCodec::z16t, OniCodec::z16p}) {
    const auto coded = make({.codec = codec, .width = 4000, .height = 4000}, {Bytes(100, 0xEF)});
    EXPECT_THAT(read_frame(coded).reason(), HasSubstr("too short"));
  }
}

TEST_F(RecordingTest, AHugeImageIsNotAllocatedForACroppedFrame) {
  const auto file = make({.width = 8192, .height = 1900}, {Bytes(8, 1)}, [](OniRecordWriter& writer) {
    ByteBuilder crop;
    crop.put(std::uint32_t{1});
    for (const int v : {0, 0, 2, 2}) crop.put(static_cast<std::uint16_t>(v));
    writer.add_property(1, OniRecordType::general_property, oni_property::kCropping, crop.bytes());
  });
  EXPECT_THAT(read_frame(file).reason(), HasSubstr("2 x 2 in an image of 8192 x 1900"));
}

TEST_F(RecordingTest, CroppingOutsideOfTheImageIsIgnored) {
  const auto file = make({}, {Bytes(24, 1)}, [](OniRecordWriter& writer) {
    ByteBuilder crop;
    crop.put(std::uint32_t{1});
    for (const int v : {3, 0, 2, 2}) crop.put(static_cast<std::uint16_t>(v));
    writer.add_property(1, OniRecordType::general_property, oni_property::kCropping, crop.bytes());
  });
  EXPECT_TRUE(succeeded(read_frame(file)));
}

TEST_F(RecordingTest, CameraComesFromFieldOfViewZeroPlaneOrOurOwnProperty) {
  const auto with = [&](std::string_view name, const std::vector<double>& values) {
    const auto file = make({.width = 640, .height = 480}, {}, [&](OniRecordWriter& writer) {
      ByteBuilder bytes;
      for (const double value : values) bytes.put(value);
      writer.add_property(1, OniRecordType::general_property, name, bytes.bytes());
    });
    const Recording recording(file);
    return intrinsics_at(recording.index().nodes[0], recording.index().file_size, {640, 480});
  };
  const double half = std::atan(320 / 525.0);
  EXPECT_NEAR(with(oni_property::kFov, {2 * half, 1.0})->fx, 525, 1e-9);
  EXPECT_NEAR(with(oni_property::kRealWorld, {120, 0.1042, 2})->fx, 120 / 0.2084, 1e-9);
  const auto own = with(oni_property::kIntrinsics, {570.5, 571.25, 311, 250.5});
  EXPECT_EQ(std::tuple(own->fx, own->fy, own->cx, own->cy), std::tuple(570.5, 571.25, 311.0, 250.5));
  EXPECT_EQ(own->origin, IntrinsicsOrigin::file);
  const double nan = std::nan("");
  for (const double bad : {0.0, -1.0, 3.2, nan, HUGE_VAL})
    EXPECT_FALSE(with(oni_property::kFov, {bad, 1.0}).has_value()) << bad;
  EXPECT_FALSE(with(oni_property::kRealWorld, {0, 0.1, 2}).has_value());
  EXPECT_FALSE(with(oni_property::kIntrinsics, {0, 1, 2, 3}).has_value());
}

TEST_F(RecordingTest, PropertiesApplyFromTheirPositionOn) {
  OniRecordWriter writer(path("p.oni"), false);
  add_test_stream(writer, 1, {});
  writer.begin();
  ASSERT_TRUE(writer.write_frame(1, 0, words(std::vector<std::uint16_t>(12, 500))));
  writer.add_int(1, oni_property::kOniFormat, 101);
  ASSERT_TRUE(writer.write_frame(1, 1, words(std::vector<std::uint16_t>(12, 500))));
  writer.add_int(1, oni_property::kOniFormat, 100);
  ASSERT_TRUE(writer.write_frame(1, 2, words(std::vector<std::uint16_t>(12, 500))));
  writer.close();
  for (const auto& [k, depth] : {std::pair(2u, 500.0f), std::pair(1u, 50.0f), std::pair(0u, 500.0f)})
    EXPECT_EQ(depth_of(path("p.oni"), k)(0, 0), depth) << k;
}

TEST_F(RecordingTest, NearestInTimeAgreesWithALinearSearch) {
  std::mt19937 random(6);
  for (const bool in_order : {true, false}) {
    OniRecordWriter writer(path("t.oni"), true);
    add_test_stream(writer, 1, {});
    writer.begin();
    std::vector<std::uint64_t> times;
    std::uint64_t time = 0;
    for (int k = 0; k < 200; ++k) {
      time = in_order ? time + random() % 5 : random() % 1000;
      times.push_back(time);
      ASSERT_TRUE(writer.write_frame(1, time, Bytes{1}));
    }
    writer.close();
    const Recording recording(path("t.oni"));
    for (std::uint64_t at = 0; at < 1010; ++at) {
      const auto found = recording.nearest(recording.index().nodes[0], at).value();
      std::uint64_t least = ~std::uint64_t{0}, earliest = 0;
      for (const std::uint64_t t : times)
        if (time_between(t, at) < least || (time_between(t, at) == least && t < earliest)) {
          least = time_between(t, at);
          earliest = t;
        }
      ASSERT_EQ(times[found], earliest) << at;
    }
  }
}

TEST_F(RecordingTest, OtherFilesAreUnreadable) {
  const auto error_of = [&](const std::filesystem::path& file) {
    try {
      const Recording recording(file);
      return std::string("none");
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::unreadable);
      return std::string(error.what());
    }
  };
  write_bytes(path("text"), Bytes(100, 'x'));
  write_bytes(path("empty"), {});
  Bytes future = {'N', 'I', '1', '0', 1, 0, 2, 0};
  future.resize(24);
  write_bytes(path("future"), future);
  EXPECT_THAT(error_of(path("text")), HasSubstr("not an .oni recording"));
  EXPECT_THAT(error_of(path("empty")), HasSubstr("not an .oni recording"));
  EXPECT_THAT(error_of(path("future")), HasSubstr("1.0.2.0"));
  EXPECT_THAT(error_of(path("absent")), HasSubstr("No such file"));
  EXPECT_THAT(error_of(folder_), HasSubstr("not a file"));
}

TEST_F(RecordingTest, TheIndexOfAFrameIsSmall) {
  EXPECT_LE(sizeof(OniFrameEntry) + sizeof(std::uint32_t), 50u);
}

}  // namespace
}  // namespace saccade
