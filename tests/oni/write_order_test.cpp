// The order in which bytes reach the disk (README 9). This program replaces the system calls that write. They
// write and keep a log, from which the tests build every state that a kill or a power failure may leave.
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <random>
#include <thread>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "oni/check.hpp"
#include "oni/recorder.hpp"
#include "oni/recording.hpp"
#include "oni/repair.hpp"
#include "oni_fixtures.hpp"
#include "tests/support/error_of.hpp"

namespace {

struct Operation {
  enum class Kind { write, cut, sync, frame, rename };
  Kind kind;
  std::uint64_t position = 0;       // of a write; the new size of a cut; the number of a frame
  std::vector<std::uint8_t> bytes;  // of a write
};

// The log of all files; a test writes one at a time.
struct Disk {
  std::mutex mutex;
  std::condition_variable changed;
  std::vector<Operation> log;
  bool held = false;  // syncs wait
  int waiting = 0;    // syncs that do
  int folder_syncs = 0;
  std::size_t largest_write = SIZE_MAX;  // bytes of a call
  int writes_until_full = -1;            // the call after them fails once, as on a full disk
  void add(Operation operation) {
    const std::lock_guard lock(mutex);
    log.push_back(std::move(operation));
  }
};

Disk& disk() {
  static Disk disk;
  return disk;
}

}  // namespace

extern "C" ssize_t pwrite(int file, const void* bytes, size_t count, off_t position) {
  const auto* begin = static_cast<const std::uint8_t*>(bytes);
  {
    const std::lock_guard lock(disk().mutex);
    if (disk().writes_until_full-- == 0) {
      errno = ENOSPC;
      return -1;
    }
    count = std::min(count, disk().largest_write);
  }
  const ssize_t written = ::syscall(SYS_pwrite64, file, bytes, count, position);
  if (written > 0)
    disk().add({Operation::Kind::write, static_cast<std::uint64_t>(position), {begin, begin + written}});
  return written;
}

extern "C" int ftruncate(int file, off_t size) noexcept {
  disk().add({Operation::Kind::cut, static_cast<std::uint64_t>(size), {}});
  return static_cast<int>(::syscall(SYS_ftruncate, file, size));
}

extern "C" int rename(const char* from, const char* to) noexcept {
  disk().add({Operation::Kind::rename, 0, {}});
  return static_cast<int>(::syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}

extern "C" int fdatasync(int file) {
  {
    std::unique_lock lock(disk().mutex);
    ++disk().waiting;
    disk().changed.notify_all();
    disk().changed.wait(lock, [] { return !disk().held; });
    --disk().waiting;
    disk().log.push_back({Operation::Kind::sync, 0, {}});
  }
  return static_cast<int>(::syscall(SYS_fdatasync, file));
}

extern "C" int fsync(int file) {
  {
    const std::lock_guard lock(disk().mutex);
    ++disk().folder_syncs;
  }
  return static_cast<int>(::syscall(SYS_fsync, file));
}

namespace saccade {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Log = std::vector<Operation>;
using Kind = Operation::Kind;

const cv::Size kSize(16, 12);
constexpr std::int64_t kFrames = 5;

void apply(const Operation& operation, std::size_t count, Bytes& file) {
  if (operation.kind == Kind::cut) file.resize(operation.position);
  if (operation.kind != Kind::write) return;
  file.resize(std::max<std::size_t>(file.size(), operation.position + count));
  std::copy_n(operation.bytes.begin(), count, file.begin() + static_cast<std::ptrdiff_t>(operation.position));
}

class WriteOrder : public OniFiles {
 protected:
  void SetUp() override {
    OniFiles::SetUp();
    for (int k = 0; k < kFrames; ++k) frames_.push_back(test_frame(k, kSize, true).depth_mm);
  }

  // The log of a recording of kFrames, each synced; a mark follows the last write of each frame.
  Log record() {
    disk().log.clear();
    OniWriter writer(path("log.oni"), {.overwrite = true});
    for (int k = 0; k < kFrames; ++k) {
      writer.write(test_frame(k, kSize, true));
      disk().add({Kind::frame, static_cast<std::uint64_t>(k), {}});
      writer.sync();
    }
    writer.close();
    return disk().log;
  }

  // The file has the first `count` depth frames, bit for bit, and after them at most the one that was being
  // written. If that is `torn`, it may differ: the format has no checksums, so even then it may decode.
  void expect_frames(const Bytes& bytes, std::int64_t count, bool torn, const std::string& where) {
    write_bytes(path("cut.oni"), bytes);
    Recording recording(path("cut.oni"));
    const OniNode* node = main_depth(recording);
    std::int64_t found = 0;
    cv::Mat1f depth;
    for (std::size_t k = 0; node != nullptr && k < node->frames.size(); ++k) {
      if (!recording.read_depth(*node, k, depth)) continue;
      ASSERT_LT(found, std::min(count + 1, kFrames)) << where;
      const bool same = equal(depth, frames_[static_cast<std::size_t>(found)]);
      ASSERT_TRUE(same || (torn && found == count)) << where << ", frame " << found;
      ++found;
    }
    ASSERT_GE(found, count) << where;
  }

  std::vector<cv::Mat1f> frames_;
};

TEST_F(WriteOrder, KilledAtAnyByteOfAnyWriteAllFramesBeforeItRemain) {
  const Log log = record();
  Bytes file;
  std::int64_t frames = 0;
  for (const Operation& operation : log) {
    if (operation.kind == Kind::frame) ++frames;
    for (std::size_t count = 1; count < operation.bytes.size(); ++count) {
      // Every byte of writes in place and of the headers of records; some of the rest.
      if (operation.position >= file.size() && count > 40 && count % 61 != 0) continue;
      Bytes cut = file;
      apply(operation, count, cut);
      if (cut.size() < kOniHeaderSize) continue;
      expect_frames(
          cut, frames, false,
          "after " + std::to_string(count) + " bytes of a write at " + std::to_string(operation.position));
      if (HasFatalFailure()) return;
    }
    apply(operation, operation.bytes.size(), file);
  }
  EXPECT_EQ(file, read_bytes(path("log.oni"))) << "the log has all writes";
  EXPECT_EQ(frames, kFrames);
}

TEST_F(WriteOrder, APowerFailureTakesAtMostTheFrameBeingWritten) {
  const Log log = record();
  std::mt19937 random(7);
  Bytes safe;  // the file as it is on the disk for certain
  std::size_t first_unsafe = 0;
  std::int64_t safe_frames = 0, frames = 0;
  for (std::size_t k = 0; k < log.size(); ++k) {
    if (log[k].kind == Kind::frame) ++frames;
    ASSERT_LE(frames - safe_frames, 1) << "a frame is written before the previous one is on the disk";
    // Each call since the last sync may have reached the disk completely, in part or not at all.
    for (int round = 0; round < 12 && safe.size() >= kOniHeaderSize; ++round) {
      Bytes file = safe;
      for (std::size_t i = first_unsafe; i <= k; ++i) {
        const std::size_t whole = log[i].bytes.size();
        const bool cut = random() % 2 == 0 && whole > 0;
        if (random() % 4 == 0) {
          // The size has changed and the bytes are missing.
          file.resize(std::max<std::size_t>(file.size(), whole == 0 ? 0 : log[i].position + whole));
          continue;
        }
        apply(log[i], cut ? random() % whole : whole, file);
      }
      expect_frames(file, safe_frames, true, "after call " + std::to_string(k));
      if (HasFatalFailure()) return;
    }
    if (log[k].kind != Kind::sync) continue;
    for (; first_unsafe <= k; ++first_unsafe) apply(log[first_unsafe], log[first_unsafe].bytes.size(), safe);
    safe_frames = frames;
  }
  EXPECT_EQ(safe, read_bytes(path("log.oni"))) << "the closed file is on the disk";
}

TEST_F(WriteOrder, CountsAndTablePositionsAreWrittenOnlyWhenTheTablesAreOnTheDisk) {
  const Log log = record();
  std::uint64_t end = 0;  // of the file so far
  bool synced = true;
  int overwrites = 0;
  for (const Operation& operation : log) {
    if (operation.kind == Kind::sync) synced = true;
    if (operation.kind != Kind::write) continue;
    if (operation.position < end) {
      ++overwrites;
      EXPECT_TRUE(synced || overwrites > 1) << "an earlier part is replaced before the end is on the disk";
    } else {
      synced = false;
    }
    end = std::max(end, operation.position + operation.bytes.size());
  }
  EXPECT_EQ(overwrites, 3) << "two nodes and the header";
}

TEST_F(WriteOrder, TheNameOfTheFileIsOnTheDiskWithItsFirstFrame) {
  for (const bool replaces : {false, true}) {
    disk().folder_syncs = 0;
    OniWriter writer(path("name.oni"), {.overwrite = true});
    writer.write(test_frame(0, kSize, false));
    EXPECT_EQ(disk().folder_syncs, replaces ? 2 : 1) << "the name, and the new name of a file that replaces";
    writer.close();
  }
}

// Else a power failure could leave the new name of an empty file in place of a recording.
TEST_F(WriteOrder, AFileIsOnTheDiskBeforeItReplacesAnother) {
  record();
  const Log log = record();
  const auto rename = std::ranges::find(log, Kind::rename, &Operation::kind);
  ASSERT_NE(rename, log.end());
  ASSERT_NE(rename, log.begin());
  EXPECT_EQ(std::prev(rename)->kind, Kind::sync);
}

TEST_F(WriteOrder, WritesThatTakeAPartGoOn) {
  record();
  const Bytes whole = read_bytes(path("log.oni"));
  disk().largest_write = 7;
  record();
  disk().largest_write = SIZE_MAX;
  EXPECT_EQ(read_bytes(path("log.oni")), whole);
}

// The blocks are reserved, but some file systems promise more than they have.
TEST_F(WriteOrder, AWriteThatFailsInTheMiddleLeavesTheFramesBefore) {
  OniWriter writer(path("full.oni"), {.depth_codec = OniDepthCodec::none});
  const cv::Size large(160, 120);  // one frame is longer than all that closing appends
  writer.write(test_frame(0, large, false));
  disk().largest_write = 30'000;
  disk().writes_until_full = 1;
  const std::string error = error_of(ExitStatus::failed, [&] { writer.write(test_frame(1, large, false)); });
  EXPECT_TRUE(error.starts_with("disk full")) << error;
  disk().largest_write = SIZE_MAX;
  Recording recording(path("full.oni"));
  EXPECT_TRUE(is_sound(check_recording(recording)));
  EXPECT_EQ(main_depth(recording)->frames.size(), 1u);
  EXPECT_LT(std::filesystem::file_size(path("full.oni")), 2 * large.area() + 10'000);
}

TEST_F(WriteOrder, AClosedFileKeepsNoBlocksThatItDoesNotUse) {
  record();
  struct stat status {};
  ASSERT_EQ(::stat(path("log.oni").c_str(), &status), 0);
  EXPECT_LT(status.st_blocks * 512, status.st_size + (1 << 20));
}

// A recorder whose disk holds its first sync, so that what is offered then waits in the queue.
class HeldRecorder : public WriteOrder {
 protected:
  void begin(std::size_t capacity) {
    writer_.emplace(path("held.oni"), OniWriterOptions{.colour_codec = OniColourCodec::none});
    recorder_.emplace(*writer_, capacity);
    hold(true);
    ASSERT_TRUE(recorder_->offer(test_frame(0, kSize, true)));
    std::unique_lock lock(disk().mutex);
    ASSERT_TRUE(disk().changed.wait_for(lock, std::chrono::minutes(1), [] { return disk().waiting == 1; }));
  }
  static void hold(bool held) {
    const std::lock_guard lock(disk().mutex);
    disk().held = held;
    disk().changed.notify_all();
  }

  std::optional<OniWriter> writer_;
  std::optional<OniRecorder> recorder_;
};

TEST_F(HeldRecorder, QueuedFramesAreCopies) {
  begin(30);
  Frame frame = test_frame(1, kSize, true);
  ASSERT_TRUE(recorder_->offer(frame));
  frame.depth_mm.setTo(7);  // the source reads the next one into the same memory
  frame.colour.setTo(cv::Scalar::all(7));
  hold(false);
  recorder_->finish();
  Recording recording(path("held.oni"));
  cv::Mat1f depth;
  cv::Mat3b colour;
  ASSERT_TRUE(recording.read_depth(*main_depth(recording), 1, depth));
  ASSERT_TRUE(recording.read_colour(*main_colour(recording), 1, colour));
  EXPECT_TRUE(equal(depth, test_frame(1, kSize, true).depth_mm));
  EXPECT_TRUE(equal(colour, test_frame(1, kSize, true).colour));
}

TEST_F(HeldRecorder, DropsAreNotedWhereTheyHappened) {
  begin(1);
  ASSERT_TRUE(recorder_->offer(test_frame(1, kSize, true)));
  ASSERT_FALSE(recorder_->offer(test_frame(2, kSize, true)));
  hold(false);
  recorder_->finish();
  const Recording recording(path("held.oni"));
  const OniNode& node = *main_depth(recording);
  EXPECT_EQ(node.int_property(oni_property::kDropped, node.frames[0].payload_position), std::nullopt);
  EXPECT_EQ(node.int_property(oni_property::kDropped, node.frames[1].payload_position), 1u);
}

// After an error elsewhere. The disk is let go when the recorder is being destroyed: at the latest at the
// third try.
TEST_F(HeldRecorder, WithoutFinishQueuedFramesAreLostAndTheFileIsClosed) {
  std::size_t frames = 0;
  for (const int wait_ms : {50, 1000, 20'000}) {
    std::filesystem::remove(path("held.oni"));
    begin(30);
    for (int k = 1; k < 12; ++k) ASSERT_TRUE(recorder_->offer(test_frame(k, kSize, true)));
    std::jthread later([wait_ms] {
      std::this_thread::sleep_for(std::chrono::milliseconds(wait_ms));
      hold(false);
    });
    recorder_.reset();
    writer_.reset();
    Recording recording(path("held.oni"));
    EXPECT_TRUE(is_sound(check_recording(recording)));
    frames = main_depth(recording)->frames.size();
    if (frames == 1) break;
  }
  EXPECT_EQ(frames, 1u);
}

TEST_F(HeldRecorder, ASlowDiskSyncsWaitingFramesTogetherAndNoneIsDropped) {
  begin(30);
  for (int k = 1; k < 12; ++k) ASSERT_TRUE(recorder_->offer(test_frame(k, kSize, true)));
  hold(false);
  recorder_->finish();
  EXPECT_EQ(recorder_->counts().frames, 12u);
  EXPECT_EQ(recorder_->counts().dropped, 0u);
  EXPECT_GT(recorder_->counts().most_unsynced, 1u) << "the count of unsynced frames is reported";
  EXPECT_EQ(recorder_->counts().unsynced, 0u);
  Recording recording(path("held.oni"));
  EXPECT_TRUE(is_sound(check_recording(recording)));
}

TEST_F(WriteOrder, APushedFrameIsOnTheDiskBeforeTheNextIsWritten) {
  disk().log.clear();
  OniWriter writer(path("push.oni"), {.colour_codec = OniColourCodec::off});
  OniRecorder recorder(writer, 2);
  for (int k = 0; k < 20; ++k) recorder.push(test_frame(k, kSize, false));
  recorder.finish();
  EXPECT_EQ(recorder.counts().most_unsynced, 1u);
  int writes = 0, syncs = 0;
  for (const Operation& operation : disk().log) {
    if (operation.kind == Kind::write) ++writes;
    if (operation.kind == Kind::sync) ++syncs;
    EXPECT_LE(writes - syncs, 3) << "three at the end: closing records, one node, the header";
  }
  EXPECT_GE(syncs, 20);
}

}  // namespace
}  // namespace saccade
