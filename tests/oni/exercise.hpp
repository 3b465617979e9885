#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>

#include "oni/check.hpp"
#include "oni/info.hpp"
#include "oni/recording.hpp"
#include "sources/oni_source.hpp"
#include "tests/support/memory_file.hpp"
#include "tests/support/proper_error.hpp"

namespace saccade {

/// Uses any bytes as a recording, as the program does: opens, describes and checks it, plays some frames and
/// seeks. Besides success, only an Error (unreadable) of one line is allowed; anything else throws. Returns
/// the number of frames played.
inline int exercise(std::span<const std::uint8_t> bytes) {
  const MemoryFile file(bytes);
  int played = 0;
  proper_error_at_worst(ExitStatus::unreadable, [&] {
    Recording recording{std::filesystem::path(file.path())};
    describe(recording);
    check_recording(recording);
  });
  proper_error_at_worst(ExitStatus::unreadable, [&] {
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
