#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>

#include "core/error.hpp"
#include "oni/check.hpp"
#include "oni/info.hpp"
#include "oni/recording.hpp"
#include "sources/oni_source.hpp"

namespace saccade {

/// A file in memory with a path, so that the code under test opens a real file.
class MemoryFile {
 public:
  explicit MemoryFile(std::span<const std::uint8_t> bytes) : descriptor_(::memfd_create("oni", MFD_CLOEXEC)) {
    if (descriptor_ < 0 ||
        ::write(descriptor_, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size()))
      throw std::runtime_error("no memory file");
  }
  ~MemoryFile() { ::close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

/// Uses any bytes as a recording, as the program does: opens, describes and checks it, plays some frames and
/// seeks. Besides success, only an Error (unreadable) of one line is allowed; anything else throws. Returns
/// the number of frames played.
inline int exercise(std::span<const std::uint8_t> bytes) {
  const MemoryFile file(bytes);
  int played = 0;
  const auto unreadable_at_worst = [](const auto& action) {
    try {
      action();
    } catch (const Error& error) {
      if (error.status() != ExitStatus::unreadable ||
          std::string(error.what()).find('\n') != std::string::npos)
        throw std::logic_error(std::string("not a proper error: ") + error.what());
    }
  };
  unreadable_at_worst([&] {
    Recording recording{std::filesystem::path(file.path())};
    describe(recording);
    check_recording(recording);
  });
  unreadable_at_worst([&] {
    OniSource source(file.path());
    Frame frame;
    const auto read = [&] {
      const ReadResult result = source.read(frame, std::chrono::milliseconds(0));
      if (result.status != ReadStatus::frame) return;
      if (frame.depth_mm.size() != source.info().size) throw std::logic_error("a frame of another size");
      if (!frame.colour.empty() && frame.colour.size() != frame.size())
        throw std::logic_error("colour of another size");
      ++played;
    };
    for (int k = 0; k < 3; ++k) read();
    source.seek(*source.info().frame_count - 1);
    read();
  });
  return played;
}

}  // namespace saccade
