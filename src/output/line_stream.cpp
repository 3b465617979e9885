#include "output/line_stream.hpp"

#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <stdexcept>
#include <string_view>
#include <thread>
#include <utility>

#include "core/error.hpp"
#include "core/setting.hpp"

namespace saccade {
namespace {

constexpr std::string_view kUdp = "udp://";
constexpr std::size_t kMostQueued = 256;  // lines; a few seconds of a camera
constexpr std::chrono::seconds kPatience{1};

// Lines to a pipe, a file or a terminal, on a thread of its own.
class PipeStream final : public LineStream {
 public:
  PipeStream(int descriptor, SlowReader slow_reader)
      : descriptor_(descriptor), slow_reader_(slow_reader), thread_([this] { work(); }) {}

  ~PipeStream() override { interrupt(); }

  void send(const std::string& line) override {
    std::unique_lock lock(mutex_);
    const auto has_room = [this] { return counts_.closed || interrupted_ || queue_.size() < kMostQueued; };
    if (slow_reader_ == SlowReader::wait) changed_.wait(lock, has_room);
    if (counts_.closed || interrupted_ || !has_room()) {
      ++counts_.dropped;
      return;
    }
    queue_.push_back(line + "\n");
    changed_.notify_all();
  }

  void finish() override {
    std::unique_lock lock(mutex_);
    const auto sent = [this] { return counts_.closed || interrupted_ || (queue_.empty() && !busy_); };
    if (slow_reader_ == SlowReader::wait)
      changed_.wait(lock, sent);
    else
      changed_.wait_for(lock, kPatience, sent);
    interrupted_ = true;
    drop_queue();
  }

  void interrupt() noexcept override {
    const std::lock_guard lock(mutex_);
    interrupted_ = true;
    changed_.notify_all();
  }

  LineStreamCounts counts() const override {
    const std::lock_guard lock(mutex_);
    return counts_;
  }

 private:
  void work() {
    std::unique_lock lock(mutex_);
    for (;;) {
      changed_.wait(lock, [this] { return interrupted_ || !queue_.empty(); });
      if (interrupted_) return drop_queue();
      const std::string line = std::move(queue_.front());
      queue_.pop_front();
      busy_ = true;
      lock.unlock();
      const Written written = write_line(line);
      lock.lock();
      busy_ = false;
      ++(written == Written::all ? counts_.sent : counts_.dropped);
      if (written == Written::closed) {
        counts_.closed = true;
        drop_queue();
      }
      changed_.notify_all();
    }
  }

  enum class Written { all, interrupted, closed };

  // A pipe that poll() calls ready takes PIPE_BUF bytes without waiting, so that no write can hang.
  Written write_line(std::string_view line) {
    constexpr std::size_t kPiece = 4096;
    constexpr int kPollMs = 50;
    while (!line.empty()) {
      pollfd ready{descriptor_, POLLOUT, 0};
      const int count = ::poll(&ready, 1, kPollMs);
      if (count == 0 || (count < 0 && errno == EINTR)) {
        const std::lock_guard lock(mutex_);
        if (interrupted_) return Written::interrupted;
        continue;
      }
      const ssize_t written = ::write(descriptor_, line.data(), std::min(line.size(), kPiece));
      if (written < 0 && (errno == EINTR || errno == EAGAIN)) continue;
      if (written < 0) return Written::closed;
      line.remove_prefix(static_cast<std::size_t>(written));
    }
    return Written::all;
  }

  // With the mutex held.
  void drop_queue() {
    counts_.dropped += static_cast<std::int64_t>(queue_.size());
    queue_.clear();
    changed_.notify_all();
  }

  const int descriptor_;
  const SlowReader slow_reader_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::string> queue_;  // guarded by mutex_, like all below
  LineStreamCounts counts_;
  bool busy_ = false, interrupted_ = false;
  std::jthread thread_;
};

struct Address {
  std::string host, port;
};

// "HOST:PORT" or "[IPv6]:PORT". Throws std::invalid_argument.
Address parse_address(std::string_view text) {
  const std::string expected = "- or udp://HOST:PORT, PORT 1..65535";
  const auto colon = text.rfind(':');
  if (colon == std::string_view::npos || colon == 0) throw std::invalid_argument(expected);
  std::string_view host = text.substr(0, colon);
  const std::string_view port = text.substr(colon + 1);
  static_cast<void>(parse_number(port, 1, 65535, expected));
  if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
  if (host.empty()) throw std::invalid_argument(expected);
  return {std::string(host), std::string(port)};
}

// A datagram for each line, which never waits. A host without a listener refuses them: the next may find one.
class UdpStream final : public LineStream {
 public:
  UdpStream(const std::string& to, const Address& address) : socket_(connect(to, address)) {}
  ~UdpStream() override { ::close(socket_); }

  void send(const std::string& line) override {
    const bool sent = ::send(socket_, line.data(), line.size(), MSG_DONTWAIT | MSG_NOSIGNAL) >= 0;
    const std::lock_guard lock(mutex_);
    ++(sent ? counts_.sent : counts_.dropped);
  }
  void finish() override {}
  void interrupt() noexcept override {}
  LineStreamCounts counts() const override {
    const std::lock_guard lock(mutex_);
    return counts_;
  }

 private:
  static int connect(const std::string& to, const Address& address) {
    addrinfo hints{};
    hints.ai_socktype = SOCK_DGRAM;
    addrinfo* found = nullptr;
    if (const int code = ::getaddrinfo(address.host.c_str(), address.port.c_str(), &hints, &found); code != 0)
      throw usage_error(std::string("this host is not known: ") + ::gai_strerror(code), "--stream " + to,
                        "check the name");
    int connected = -1;
    for (const addrinfo* each = found; each != nullptr && connected < 0; each = each->ai_next) {
      const int made = ::socket(each->ai_family, each->ai_socktype | SOCK_CLOEXEC, each->ai_protocol);
      if (made < 0) continue;
      if (::connect(made, each->ai_addr, each->ai_addrlen) == 0)
        connected = made;
      else
        ::close(made);
    }
    ::freeaddrinfo(found);
    if (connected < 0) throw usage_error("no way to this host", "--stream " + to, "check the network");
    return connected;
  }

  const int socket_;
  mutable std::mutex mutex_;
  LineStreamCounts counts_;  // guarded by mutex_
};

}  // namespace

void check_stream_form(const std::string& to) {
  if (to.empty() || to == "-") return;
  if (!to.starts_with(kUdp)) throw std::invalid_argument("- or udp://HOST:PORT");
  static_cast<void>(parse_address(std::string_view(to).substr(kUdp.size())));
}

std::unique_ptr<LineStream> open_line_stream(const std::string& to, SlowReader slow_reader) {
  if (to == "-") return std::make_unique<PipeStream>(STDOUT_FILENO, slow_reader);
  try {
    check_stream_form(to);
  } catch (const std::invalid_argument& expected) {
    throw usage_error("not a stream", "--stream " + to, std::string("expected ") + expected.what());
  }
  return std::make_unique<UdpStream>(to, parse_address(std::string_view(to).substr(kUdp.size())));
}

}  // namespace saccade
