#pragma once

#include <sys/inotify.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <opencv2/core.hpp>

#include "core/file.hpp"
#include "core/frame_source.hpp"
#include "tests/support/folder_test.hpp"
#include "tests/support/no_wait.hpp"

namespace saccade {

inline const cv::Size kSize(64, 48);
inline constexpr int kFrames = 6;

/// Tests of videos in a folder of their own, which they can damage.
class VideoFiles : public FolderTest {
 protected:
  std::filesystem::path path(const std::string& name) const { return folder_ / name; }

  // Cuts the file to this share of its bytes.
  void cut(const std::string& name, double share) const {
    const auto size = static_cast<double>(std::filesystem::file_size(path(name)));
    std::filesystem::resize_file(path(name), static_cast<std::uintmax_t>(size * share));
  }

  // Overwrites bytes from `share` of the file on with zeros.
  void damage(const std::string& name, double share, std::size_t bytes) const {
    auto content = read_file(path(name));
    const auto begin = static_cast<std::size_t>(static_cast<double>(content.size()) * share);
    std::fill_n(content.begin() + static_cast<std::ptrdiff_t>(begin), bytes, std::uint8_t{0});
    write_file(path(name), content);
  }
};

/// Watches how a file is used: one that is opened again and again takes time before its first image.
class FileWatch {
 public:
  explicit FileWatch(const std::filesystem::path& file)
      : file_(std::filesystem::canonical(file)), events_(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {
    EXPECT_GE(::inotify_add_watch(events_, file.c_str(), IN_OPEN | IN_CLOSE), 0);
  }
  ~FileWatch() { ::close(events_); }
  FileWatch(const FileWatch&) = delete;
  FileWatch& operator=(const FileWatch&) = delete;

  /// How often it was closed so far; some in an unbroken row count once.
  int closed() {
    alignas(inotify_event) std::array<char, 4096> bytes{};
    for (ssize_t got = 0; (got = ::read(events_, bytes.data(), bytes.size())) > 0;)
      for (ssize_t at = 0; at < got;) {
        inotify_event event{};
        std::memcpy(&event, bytes.data() + at, sizeof event);
        closed_ += (event.mask & IN_CLOSE) != 0 ? 1 : 0;
        at += static_cast<ssize_t>(sizeof event + event.len);
      }
    return closed_;
  }

  /// How often this process has it open now.
  int open() const {
    int count = 0;
    std::error_code code;
    for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd"))
      count += std::filesystem::read_symlink(entry.path(), code) == file_ ? 1 : 0;
    return count;
  }

 private:
  std::filesystem::path file_;
  int events_, closed_ = 0;
};

/// Reads to the end, at most 2 kFrames positions: the status of each. `check(k, frame)` looks at the sound
/// ones.
template <typename Check>
std::vector<ReadStatus> read_positions(FrameSource& source, const Check& check) {
  std::vector<ReadStatus> all;
  Frame frame;
  for (int k = 0; k < 2 * kFrames; ++k) {
    const ReadResult read = source.read(frame, kNoWait);
    if (read.status == ReadStatus::end) break;
    all.push_back(read.status);
    EXPECT_EQ(frame.index, k);
    if (read.status == ReadStatus::rejected)
      // Whoever reports it names the frame.
      EXPECT_THAT(read.reason, ::testing::Not(::testing::AnyOf("", ::testing::StartsWith("frame "))));
    else
      check(k, frame);
  }
  return all;
}

inline std::ptrdiff_t rejected_of(const std::vector<ReadStatus>& all) {
  return std::ranges::count(all, ReadStatus::rejected);
}

}  // namespace saccade
