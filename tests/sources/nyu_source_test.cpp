// Small files in the format of NYU Depth V2, written with libhdf5 as MATLAB lays them out.

#include <hdf5.h>

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/file.hpp"
#include "sources/open_source.hpp"
#include "tests/support/no_wait.hpp"

namespace saccade {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr int kImages = 3, kHeight = 10, kWidth = 12;

class NyuSourceTest : public ::testing::Test {
 protected:
  void SetUp() override {
    path_ =
        fs::path(::testing::TempDir()) /
        (std::string("saccade_") + ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".mat");
    // MATLAB puts a block of 512 bytes of its own before the file of HDF5.
    const hid_t creation = H5Pcreate(H5P_FILE_CREATE);
    H5Pset_userblock(creation, 512);
    file_ = H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, creation, H5P_DEFAULT);
    H5Pclose(creation);
  }
  void TearDown() override {
    close();
    fs::remove(path_);
  }
  void close() {
    if (file_ >= 0) H5Fclose(file_);
    file_ = -1;
  }

  // An array of `shape` whose value at image, row and column (and colour) is value(i, r, c, k); stored as
  // image, [colour,] column, row, in chunks of one image.
  template <typename Value, typename Function>
  void put(const std::string& name, hid_t type, Function value, int colours = 0, int images = kImages,
           int height = kHeight) {
    std::vector<hsize_t> shape = {static_cast<hsize_t>(images), kWidth, static_cast<hsize_t>(height)};
    if (colours > 0) shape.insert(shape.begin() + 1, static_cast<hsize_t>(colours));
    std::vector<Value> values;
    for (int i = 0; i < images; ++i)
      for (int k = 0; k < std::max(colours, 1); ++k)
        for (int c = 0; c < kWidth; ++c)
          for (int r = 0; r < height; ++r) values.push_back(static_cast<Value>(value(i, r, c, k)));
    const int axes = static_cast<int>(shape.size());
    const hid_t space = H5Screate_simple(axes, shape.data(), nullptr), layout = H5Pcreate(H5P_DATASET_CREATE);
    std::vector<hsize_t> chunk = shape;
    chunk[0] = 1;
    H5Pset_chunk(layout, axes, chunk.data());
    H5Pset_deflate(layout, 3);
    const hid_t data = H5Dcreate2(file_, name.c_str(), type, space, H5P_DEFAULT, layout, H5P_DEFAULT);
    H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Dclose(data);
    H5Pclose(layout);
    H5Sclose(space);
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

  std::string error() {
    close();
    try {
      open_source(path_.string());
    } catch (const Error& e) {
      EXPECT_EQ(e.status(), ExitStatus::unreadable);
      return e.what();
    }
    ADD_FAILURE() << "no error came";
    return "";
  }

  fs::path path_;
  hid_t file_ = -1;
};

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
  EXPECT_THAT(source->info().notes, ElementsAre(HasSubstr("no instances")));
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

TEST_F(NyuSourceTest, ArraysOfDifferentShapes) {
  put_depths();
  put<std::uint16_t>(
      "labels", H5T_NATIVE_UINT16, [](int, int, int, int) { return 1; }, 0, kImages, kHeight - 1);
  EXPECT_THAT(error(), HasSubstr("labels or instances are not N x W x H"));
}

TEST_F(NyuSourceTest, ImagesOfAnotherNumber) {
  put_depths();
  put<std::uint8_t>(
      "images", H5T_NATIVE_UINT8, [](int, int, int, int) { return 1; }, 3, kImages - 1);
  EXPECT_THAT(error(), HasSubstr("images are not N x 3 x W x H"));
}

TEST_F(NyuSourceTest, ACutFile) {
  put_depths();
  put_images();
  close();
  fs::resize_file(path_, fs::file_size(path_) / 2);
  EXPECT_THAT(error(), HasSubstr("not an HDF5 file"));
}

}  // namespace
}  // namespace saccade
