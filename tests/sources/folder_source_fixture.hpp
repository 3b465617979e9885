#pragma once

#include <cstdint>
#include <ctime>
#include <string>
#include <string_view>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/png.hpp"
#include "sources/open_source.hpp"
#include "tests/support/error_of.hpp"
#include "tests/support/folder_test.hpp"
#include "tests/support/no_wait.hpp"

namespace saccade {

/// Processor time of this process: it bounds work, and other programs on the machine do not change it.
inline double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// A folder of images, opened as a source.
class FolderSourceTest : public FolderTest {
 protected:
  void put(const std::string& name, const cv::Mat& image) const {
    write_file(folder_ / name, encode_png(image));
  }
  void put_text(const std::string& name, std::string_view text) const { write_file(folder_ / name, text); }
  void put_depth(const std::string& name, int value, cv::Size size = {16, 12}) const {
    put(name, cv::Mat1w(size, static_cast<std::uint16_t>(value)));
  }

  std::string error() const {
    return error_of(ExitStatus::unreadable, [&] { open_source(folder_.string()); });
  }

  // The reason for which the only, or second, frame is rejected.
  std::string rejection() const {
    const auto source = open_source(folder_.string());
    Frame frame;
    ReadResult result = source->read(frame, kNoWait);
    if (result.status == ReadStatus::frame) result = source->read(frame, kNoWait);
    EXPECT_EQ(result.status, ReadStatus::rejected);
    return result.reason;
  }

  // What the second frame lacks, and why.
  std::string lack() const {
    const auto source = open_source(folder_.string());
    Frame frame;
    source->seek(1);
    const ReadResult result = source->read(frame, kNoWait);
    EXPECT_EQ(result.status, ReadStatus::frame);
    EXPECT_EQ(frame.depth_mm(3, 4), 1000.0F) << "sound depth stays";
    return result.reason;
  }
};

}  // namespace saccade
