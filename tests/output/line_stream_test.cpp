#include "output/line_stream.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <string>
#include <thread>
#include <utility>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tests/support/system_calls.hpp"

namespace saccade {
namespace {

using Clock = std::chrono::steady_clock;

// Standard output is a pipe while it lives.
class PipeAsOutput {
 public:
  PipeAsOutput() : saved_(::dup(STDOUT_FILENO)) {
    std::signal(SIGPIPE, SIG_IGN);
    std::array<int, 2> ends{};
    EXPECT_EQ(::pipe(ends.data()), 0);
    reader = ends[0];
    ::dup2(ends[1], STDOUT_FILENO);
    ::close(ends[1]);
  }
  ~PipeAsOutput() {
    restore();
    if (reader >= 0) ::close(reader);
  }
  void restore() {
    if (saved_ < 0) return;
    ::dup2(saved_, STDOUT_FILENO);
    ::close(saved_);
    saved_ = -1;
  }
  void close_reader() { ::close(std::exchange(reader, -1)); }

  int reader = -1;

 private:
  int saved_;
};

std::string read_all(int descriptor) {
  std::string text;
  std::array<char, 4096> part{};
  for (ssize_t n = 0; (n = ::read(descriptor, part.data(), part.size())) > 0;)
    text.append(part.data(), static_cast<std::size_t>(n));
  return text;
}

TEST(LineStream, EveryLineReachesAReaderThatKeepsUp) {
  PipeAsOutput pipe;
  std::string text;
  std::jthread reader([&] { text = read_all(pipe.reader); });
  auto stream = open_line_stream("-", SlowReader::wait);
  std::string expected;
  for (int i = 0; i < 1000; ++i) {
    const std::string line = std::to_string(i) + std::string(static_cast<std::size_t>(i) * 20, 'x');
    stream->send(line);
    expected += line + "\n";
  }
  stream->finish();
  EXPECT_EQ(stream->counts().sent, 1000);
  EXPECT_EQ(stream->counts().dropped, 0);
  stream.reset();
  pipe.restore();  // closes the pipe
  reader.join();
  EXPECT_TRUE(text == expected);
}

TEST(LineStream, WritesThatAreInterruptedOrTakeAPartGoOn) {
  PipeAsOutput pipe;
  SystemCalls calls;
  int count = 0;
  calls.write = [&](int file, const void* bytes, std::size_t size) -> ssize_t {
    if (++count % 3 == 0) return SystemCalls::real_write(file, bytes, std::min<std::size_t>(size, 4));
    errno = count % 3 == 1 ? EINTR : EAGAIN;
    return -1;
  };
  auto stream = open_line_stream("-", SlowReader::wait);
  stream->send("one two three");
  stream->finish();
  EXPECT_EQ(stream->counts().sent, 1);
  EXPECT_FALSE(stream->counts().closed);
  stream.reset();
  pipe.restore();
  EXPECT_EQ(read_all(pipe.reader), "one two three\n");
  EXPECT_EQ(count, 3 * 4);
}

TEST(LineStream, AReaderThatStopsDoesNotStallLiveWork) {
  PipeAsOutput pipe;
  const auto begin = Clock::now();
  {
    const auto stream = open_line_stream("-", SlowReader::drop);
    const std::string line(1000, 'x');
    for (int i = 0; i < 2000; ++i) stream->send(line);
    stream->finish();
    const LineStreamCounts counts = stream->counts();
    EXPECT_GT(counts.dropped, 1000) << "a pipe holds 64 KB";
    EXPECT_GE(counts.sent + counts.dropped, 1999) << "one may be on its way";
    EXPECT_FALSE(counts.closed);
  }
  EXPECT_LT(Clock::now() - begin, std::chrono::seconds(5));
  pipe.restore();
}

TEST(LineStream, AReaderThatLeavesIsNoticed) {
  PipeAsOutput pipe;
  const auto stream = open_line_stream("-", SlowReader::wait);
  int lines = 0;
  const auto send = [&] {
    stream->send("line");
    ++lines;
  };
  send();
  std::array<char, 5> first{};
  ASSERT_EQ(::read(pipe.reader, first.data(), first.size()), 5);
  pipe.close_reader();
  for (int i = 0; i < 100 && !stream->counts().closed; ++i) {
    send();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_TRUE(stream->counts().closed);
  send();
  stream->finish();
  EXPECT_EQ(stream->counts().sent, 1) << "not the one that was refused";
  EXPECT_EQ(stream->counts().dropped, lines - 1);
  pipe.restore();
}

TEST(LineStream, AnInterruptionEndsTheWaitForASlowReader) {
  PipeAsOutput pipe;
  auto stream = open_line_stream("-", SlowReader::wait);
  std::jthread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    stream->interrupt();
  });
  const std::string line(1000, 'x');
  for (int i = 0; i < 2000; ++i) stream->send(line);
  stream->finish();
  later.join();
  const auto counted = [&] { return stream->counts().sent + stream->counts().dropped; };
  for (int i = 0; i < 1000 && counted() < 2000; ++i)  // the one on its way is given up
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_EQ(counted(), 2000);
  EXPECT_GT(stream->counts().dropped, 1000);
  stream.reset();  // its thread must not write to the restored output
  pipe.restore();
}

TEST(LineStream, DatagramsArriveOneForEachLine) {
  const int reader = ::socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ASSERT_EQ(::bind(reader, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  socklen_t size = sizeof address;
  ::getsockname(reader, reinterpret_cast<sockaddr*>(&address), &size);
  const auto stream =
      open_line_stream("udp://127.0.0.1:" + std::to_string(ntohs(address.sin_port)), SlowReader::drop);
  stream->send("one");
  stream->send("two");
  stream->send(std::string(70'000, 'x'));  // longer than a datagram can be
  std::array<char, 100> text{};
  for (const std::string expected : {"one", "two"}) {
    pollfd ready{reader, POLLIN, 0};
    ASSERT_EQ(::poll(&ready, 1, 5000), 1);
    const ssize_t n = ::recv(reader, text.data(), text.size(), 0);
    EXPECT_EQ(std::string(text.data(), static_cast<std::size_t>(n)), expected);
  }
  EXPECT_EQ(stream->counts().sent, 2);
  EXPECT_EQ(stream->counts().dropped, 1);
  ::close(reader);
}

TEST(LineStream, WrongTextsAreRefused) {
  for (const char* wrong :
       {"x", "udp://", "udp://host", "udp://host:0", "udp://host:70000", "udp://:5", "tcp://a:5"}) {
    EXPECT_THROW(check_stream_form(wrong), std::invalid_argument) << wrong;
    EXPECT_THROW(open_line_stream(wrong, SlowReader::drop), Error) << wrong;
  }
  for (const char* good : {"", "-", "udp://localhost:5005", "udp://[::1]:5005"}) check_stream_form(good);
}

}  // namespace
}  // namespace saccade
