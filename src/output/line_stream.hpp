#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace saccade {

/// Counts of a stream of lines.
struct LineStreamCounts {
  std::int64_t sent = 0;
  std::int64_t dropped = 0;  ///< the reader was too slow, absent, or left
  bool closed = false;       ///< the reader has left: nothing more can be sent
};

/// What to do with a line for which the reader has no room.
enum class SlowReader {
  drop,  ///< drop the line, and count it: for work that must not wait
  wait,  ///< wait: for work that can
};

/// Sends lines to another program while the work goes on. One thread calls send() and finish(); any thread
/// calls interrupt() and counts().
class LineStream {
 public:
  virtual ~LineStream() = default;

  /// Sends a line, which has no line feed. Throws nothing: what cannot be sent is counted.
  virtual void send(const std::string& line) = 0;

  /// After the last line: waits until the lines are sent; with SlowReader::drop at most a second, after which
  /// the rest is dropped.
  virtual void finish() = 0;

  /// Ends all waiting, now and later: the lines that are not sent yet are dropped. Any thread.
  virtual void interrupt() noexcept = 0;

  virtual LineStreamCounts counts() const = 0;
};

/// `to` is "-", standard output, or "udp://HOST:PORT", a datagram for each line. Throws Error (usage) for
/// another text or a host that is not known.
std::unique_ptr<LineStream> open_line_stream(const std::string& to, SlowReader slow_reader);

/// Throws std::invalid_argument that says what is expected, if `to` is not of one of these forms.
void check_stream_form(const std::string& to);

}  // namespace saccade
