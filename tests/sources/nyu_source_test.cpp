// Small files in the format of NYU Depth V2.
#include <hdf5.h>

#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <span>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/file.hpp"
#include "nyu_writer.hpp"
#include "sources/hdf5_images.hpp"
#include "sources/open_source.hpp"
#include "tests/support/error_of.hpp"
#include "tests/support/folder_test.hpp"
#include "tests/support/no_wait.hpp"

namespace saccade {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr int kImages = NyuWriter::kImages, kHeight = NyuWriter::kHeight, kWidth = NyuWriter::kWidth;

class NyuSourceTest : public FolderTest {
 protected:
  NyuSourceTest() : path_(folder_ / "nyu.mat"), file_(std::make_unique<NyuWriter>(path_)) {}
  void close() { file_->close(); }

  template <typename Value, typename... More>
  void put(More&&... more) {
    file_->put<Value>(std::forward<More>(more)...);
  }

  void put_depths() {
    put<float>("depths", H5T_NATIVE_FLOAT, [](int i, int r, int c, int) {
      if (r == 0 && c == 0) return std::numeric_limits<float>::quiet_NaN();
      if (r == 0 && c == 1) return -1.0F;
      if (r == 0 && c == 2) return std::numeric_limits<float>::infinity();
      return static_cast<float>(1 + i) + 0.1F * static_cast<float>(r) + 0.01F * static_cast<float>(c);
    });
  }
  void put_images() {
    put<std::uint8_t>(
        "images", H5T_NATIVE_UINT8, [](int i, int r, int c, int k) { return 100 * k + 20 * i + r + c; }, 3);
  }
  // Class 7 on the left in two instances, class 300 on the right in one; nothing in the last row.
  void put_labels() {
    put<std::uint16_t>("labels", H5T_NATIVE_UINT16, [](int, int r, int c, int) {
      return r == kHeight - 1 ? 0 : c < 6 ? 7 : 300;
    });
  }
  void put_instances() {
    put<std::uint8_t>("instances", H5T_NATIVE_UINT8, [](int, int r, int c, int) {
      return r == 0 ? 0 : c < 6 && r > 4 ? 2 : 1;
    });
  }

  // Overwrites the compressed values of one image of an array.
  void damage_image(const std::string& name, hsize_t image) const {
    const hid_t file = H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    const hid_t data = H5Dopen2(file, name.c_str(), H5P_DEFAULT);
    const std::vector<hsize_t> corner = {image, 0, 0, 0};
    unsigned filters = 0;
    haddr_t address = 0;
    hsize_t size = 0;
    ASSERT_GE(H5Dget_chunk_info_by_coord(data, corner.data(), &filters, &address, &size), 0);
    H5Dclose(data);
    H5Fclose(file);
    constexpr hsize_t kUserBlock = 512;  // addresses count from the end of it
    auto bytes = read_file(path_);
    ASSERT_LE(kUserBlock + address + size, bytes.size());
    std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(kUserBlock + address), size, std::uint8_t{0xff});
    write_file(path_, bytes);
  }

  // Of three images, only the second has no depth.
  void expect_second_is_damaged() {
    close();
    const auto source = open_source(path_.string());
    Frame frame;
    EXPECT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
    const ReadResult second = source->read(frame, kNoWait);
    EXPECT_EQ(second.status, ReadStatus::rejected);
    EXPECT_THAT(second.reason, HasSubstr("depths is damaged here"));
    EXPECT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
  }

  std::string error() {
    close();
    return error_of(ExitStatus::unreadable, [&] { open_source(path_.string()); });
  }

  const fs::path path_;
  std::unique_ptr<NyuWriter> file_;
};

// The same numbers, whichever way they lie in the file.
TEST_F(NyuSourceTest, ReadsArraysStoredInAnyUsualWay) {
  using Storage = NyuWriter::Storage;
  const std::vector<std::pair<Storage, std::optional<hid_t>>> ways = {
      {{.chunked = false, .deflated = false}, {}},
      {{.chunked = false, .deflated = false, .compact = true}, {}},
      {{.deflated = false}, {}},
      {{}, {}},
      {{.shuffled = true}, {}},
      {{.shuffled = true, .deflated = false}, {}},
      {{.chunk = {2, 5, 7}}, {}},  // fits neither the images nor their sides
      {{.chunk = {1, 12, 1}, .shuffled = true}, H5T_IEEE_F64BE},
      {{.chunk = {3, 1, 10}}, H5T_IEEE_F32BE}};
  const auto value = [](int i, int r, int c, int) { return 1 + i + 0.125 * r + 0.0625 * c; };
  close();
  for (std::size_t way = 0; way < ways.size(); ++way) {
    NyuWriter writer(path_);
    writer.set_storage(ways[way].first);
    writer.put<float>("depths", H5T_NATIVE_FLOAT, value, 0, kImages, kHeight, ways[way].second);
    writer.close();
    const auto source = open_source(path_.string());
    Frame frame;
    for (int i = 0; i < kImages; ++i) {
      ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame) << way;
      for (int r = 0; r < kHeight; ++r)
        for (int c = 0; c < kWidth; ++c)
          ASSERT_EQ(static_cast<double>(frame.depth_mm(r, c)), 1000 * value(i, r, c, 0))
              << way << ' ' << i << ' ' << r << ' ' << c;
    }
  }
}

// libhdf5 itself copies the size of a chunk out of the four bytes.
TEST_F(NyuSourceTest, AChunkThatGivesLessThanItsSizeIsDamaged) {
  put_depths();
  file_->overwrite_chunk("depths", {1, 0, 0},
                         {0x78, 1, 1, 4, 0, 0xfb, 0xff, 'a', 'b', 'c', 'd', 3, 0xd8, 1, 0x8b});
  expect_second_is_damaged();
}

TEST_F(NyuSourceTest, AChunkThatIsNotCompressedAndTooShortIsDamaged) {
  put_depths();
  file_->overwrite_chunk("depths", {1, 0, 0}, {1, 2, 3, 4}, 1);
  expect_second_is_damaged();
}

// libhdf5 itself copies the array from nowhere.
TEST_F(NyuSourceTest, AnArrayOfNoBytesInItsDescriptionIsRefused) {
  file_->set_storage({.chunked = false, .deflated = false, .compact = true});
  put_depths();
  file_->close();
  auto bytes = read_file(path_);
  constexpr int kBytes = kImages * kWidth * kHeight * 4;
  const std::vector<std::uint8_t> layout = {3, H5D_COMPACT, kBytes & 0xff, kBytes >> 8};  // its version first
  const auto found = std::search(bytes.begin(), bytes.end(), layout.begin(), layout.end());
  ASSERT_NE(found, bytes.end());
  found[2] = found[3] = 0;
  write_file(path_, bytes);
  EXPECT_THAT(error(), HasSubstr("depths has 0 bytes instead of 1440"));
}

TEST_F(NyuSourceTest, AnotherCompressionIsRefusedWithTheReason) {
  file_->set_storage({.with_checksums = true});
  put_depths();
  EXPECT_THAT(error(), HasSubstr("depths is compressed in a way that is not read (filter 3 of HDF5)"));
}

TEST_F(NyuSourceTest, ReadsImagesDepthsAndObjects) {
  put_depths();
  put_images();
  put_labels();
  put_instances();
  close();
  const auto source = open_source(path_.string());
  EXPECT_EQ(source->info().kind, "nyu");
  EXPECT_EQ(source->info().size, cv::Size(kWidth, kHeight));
  EXPECT_EQ(source->info().frame_count, kImages);
  EXPECT_THAT(source->info().notes, IsEmpty());
  Frame frame;
  for (int i = 0; i < kImages; ++i) {
    ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
    EXPECT_EQ(frame.index, i);
    ASSERT_EQ(frame.size(), cv::Size(kWidth, kHeight));
    EXPECT_NEAR(frame.depth_mm(3, 8), 1000 * (1 + i + 0.3 + 0.08), 0.01);
    for (int c = 0; c < 3; ++c) EXPECT_EQ(frame.depth_mm(0, c), 0) << "no reading";
    const int red = 20 * i + 3 + 8;
    EXPECT_EQ(frame.colour(3, 8),
              cv::Vec3b(static_cast<std::uint8_t>(200 + red), static_cast<std::uint8_t>(100 + red),
                        static_cast<std::uint8_t>(red)))
        << "BGR";
    EXPECT_EQ(frame.truth.labels(2, 2), 1) << "class 7, instance 1";
    EXPECT_EQ(frame.truth.labels(6, 2), 2) << "class 7, instance 2";
    EXPECT_EQ(frame.truth.labels(6, 9), 3) << "class 300";
    EXPECT_EQ(frame.truth.labels(kHeight - 1, 4), 0);
    EXPECT_EQ(frame.truth.labels(0, 4), 0);
    EXPECT_EQ(frame.truth.classes(6, 9), 300);
    EXPECT_EQ(frame.truth.classes(0, 4), 7) << "structure: a class, no instance";
    EXPECT_EQ(frame.truth.classes(kHeight - 1, 4), 0) << "void";
  }
  EXPECT_EQ(source->read(frame, kNoWait).status, ReadStatus::end);
  source->seek(1);
  ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
  EXPECT_EQ(frame.index, 1);
  EXPECT_NEAR(frame.depth_mm(1, 1), 2110, 0.01);
}

TEST_F(NyuSourceTest, WithoutInstancesClassesAreObjects) {
  put_depths();
  put_labels();
  close();
  const auto source = open_source(path_.string());
  EXPECT_THAT(source->info().notes, ElementsAre(HasSubstr("no instances that can be used")));
  Frame frame;
  ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
  EXPECT_EQ(frame.truth.labels(2, 2), 7);
  EXPECT_EQ(frame.truth.labels(2, 9), 300);
  EXPECT_TRUE(frame.colour.empty());
}

TEST_F(NyuSourceTest, WithoutLabels) {
  put_depths();
  close();
  const auto source = open_source(path_.string());
  EXPECT_THAT(source->info().notes, ElementsAre(HasSubstr("no labels")));
  Frame frame;
  ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
  EXPECT_TRUE(frame.truth.labels.empty());
}

TEST_F(NyuSourceTest, FilesThatAreNotTheDataSet) {
  EXPECT_THAT(error(), HasSubstr("there are no depths"));
  write_file(path_, std::string_view("MATLAB 5.0 MAT-file"));
  EXPECT_THAT(error(), HasSubstr("not an HDF5 file"));
  fs::remove(path_);
  EXPECT_THAT(error(), HasSubstr("no such source"));
}

// Depth does not need its companions.
TEST_F(NyuSourceTest, CompanionsOfOtherShapesAreNotUsed) {
  put_depths();
  put<std::uint16_t>(
      "labels", H5T_NATIVE_UINT16, [](int, int, int, int) { return 1; }, 0, kImages, kHeight - 1);
  put<std::uint8_t>(
      "images", H5T_NATIVE_UINT8, [](int, int, int, int) { return 1; }, 3, kImages - 1);
  close();
  const auto source = open_source(path_.string());
  EXPECT_THAT(source->info().notes,
              ElementsAre(HasSubstr("images are not used"), HasSubstr("labels are not used"),
                          HasSubstr("no labels that can be used")));
  Frame frame;
  ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
  EXPECT_GT(frame.depth_mm(3, 8), 0);
  EXPECT_TRUE(frame.colour.empty());
  EXPECT_TRUE(frame.truth.labels.empty());
}

TEST_F(NyuSourceTest, DamagedColourAndLabelsLeaveTheDepth) {
  put_depths();
  put_images();
  put_labels();
  close();
  damage_image("images", 1);
  damage_image("labels", 2);
  const auto source = open_source(path_.string());
  Frame frame;
  for (int i = 0; i < kImages; ++i) {
    const ReadResult result = source->read(frame, kNoWait);
    ASSERT_EQ(result.status, ReadStatus::frame) << i;
    EXPECT_NEAR(frame.depth_mm(3, 8), 1000 * (1 + i + 0.3 + 0.08), 0.01);
    EXPECT_EQ(frame.colour.empty(), i == 1);
    EXPECT_EQ(frame.truth.labels.empty(), i == 2);
    EXPECT_EQ(result.reason, i == 1   ? "no colour: images is damaged here"
                             : i == 2 ? "no labels: labels is damaged here"
                                      : "");
  }
}

// What is there is read, and the rest rejected, wherever the file ends.
TEST_F(NyuSourceTest, ACutFile) {
  put_depths();
  put_images();
  close();
  const auto bytes = read_file(path_);
  std::set<int> read;
  constexpr std::size_t kStep = 37;  // bytes
  for (std::size_t size = bytes.size() - 1; size > kStep; size -= kStep) {
    write_file(path_, std::span(bytes).first(size));
    std::unique_ptr<FrameSource> source;
    try {
      source = open_source(path_.string());
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::unreadable) << size;
      continue;
    }
    EXPECT_THAT(source->info().notes, Contains(HasSubstr("the file is truncated"))) << size;
    Frame frame;
    int images = 0;
    for (int i = 0; i < kImages; ++i) {
      const ReadResult result = source->read(frame, kNoWait);
      if (result.status == ReadStatus::frame) {
        ++images;
        ASSERT_NEAR(frame.depth_mm(3, 8), 1000 * (1 + i + 0.3 + 0.08), 0.01) << size;
      } else {
        ASSERT_EQ(result.status, ReadStatus::rejected) << size;
        EXPECT_EQ(result.reason, "depths is damaged or cut off here") << size;
      }
    }
    read.insert(images);
  }
  EXPECT_THAT(read, Contains(kImages));
  EXPECT_GT(read.size(), 1U) << "some sizes hold some images";
}

TEST_F(NyuSourceTest, ANewerFormOfHdf5IsRefusedWithTheWayOut) {
  close();
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_libver_bounds(access, H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
  H5Fclose(H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access));
  H5Pclose(access);
  EXPECT_THAT(error(), HasSubstr("a newer form of HDF5, which is not read: write it with MATLAB"));
}

// Numbers of every usual type, at the ends of what they can be.
TEST_F(NyuSourceTest, ReadsNumbersOfEveryType) {
  const std::vector<std::pair<hid_t, double>> types = {
      {H5T_STD_I8LE, -5},       {H5T_STD_U8LE, 200},       {H5T_STD_I16LE, -5},
      {H5T_STD_I16BE, 300},     {H5T_STD_U16BE, 60'000},   {H5T_STD_I32LE, -100'000},
      {H5T_STD_I32BE, 100'000}, {H5T_STD_U32LE, 3e9},      {H5T_STD_U32BE, 70'000},
      {H5T_STD_I64LE, -1e15},   {H5T_STD_I64BE, 70'000},   {H5T_STD_U64LE, 1e15},
      {H5T_STD_U64BE, 70'000},  {H5T_IEEE_F32LE, 7.75},    {H5T_IEEE_F32BE, -7.75},
      {H5T_IEEE_F64LE, 1e300},  {H5T_IEEE_F64LE, -1e300},  {H5T_IEEE_F64BE, 7.75},
      {H5T_IEEE_F64LE, NAN},    {H5T_IEEE_F32LE, INFINITY}};
  close();
  for (const auto& [type, value] : types) {
    NyuWriter writer(path_);
    writer.put<double>(
        "numbers", H5T_NATIVE_DOUBLE, [&, v = value](int, int, int, int) { return v; }, 0, 1, kHeight, type);
    writer.close();
    const Hdf5File file(path_);
    const auto numbers = Hdf5Images::open(file, "numbers");
    ASSERT_TRUE(numbers);
    constexpr std::size_t kNumbers = kWidth * kHeight;
    std::vector<float> floats(kNumbers);
    std::vector<std::uint8_t> bytes(kNumbers);
    std::vector<std::uint16_t> words(kNumbers);
    numbers->read(0, std::span(floats));
    numbers->read(0, std::span(bytes));
    numbers->read(0, std::span(words));
    // What libhdf5 makes of it.
    const hid_t other = H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT),
                data = H5Dopen2(other, "numbers", H5P_DEFAULT);
    std::vector<float> float_truth(kNumbers);
    std::vector<std::uint8_t> byte_truth(kNumbers);
    std::vector<std::uint16_t> word_truth(kNumbers);
    H5Dread(data, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, float_truth.data());
    H5Dread(data, H5T_NATIVE_UINT8, H5S_ALL, H5S_ALL, H5P_DEFAULT, byte_truth.data());
    H5Dread(data, H5T_NATIVE_UINT16, H5S_ALL, H5S_ALL, H5P_DEFAULT, word_truth.data());
    H5Dclose(data);
    H5Fclose(other);
    EXPECT_THAT(floats, Each(::testing::NanSensitiveFloatEq(float_truth[0]))) << value;
    if (std::isnan(value)) continue;  // libhdf5 gives the largest or the smallest
    EXPECT_THAT(bytes, Each(byte_truth[0])) << value;
    EXPECT_THAT(words, Each(word_truth[0])) << value;
  }
}

}  // namespace
}  // namespace saccade
