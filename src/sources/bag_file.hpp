#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace saccade {

/// How messages of a topic are laid out.
enum class BagEncoding { ros1, cdr };

struct BagTopic {
  std::string name;  ///< "/camera/depth/image_raw"
  std::string type;  ///< "sensor_msgs/Image", without the "msg" of ROS 2
  BagEncoding encoding = BagEncoding::ros1;
};

/// Where a message is in its file.
struct BagPlace {
  std::uint64_t part = 0;    ///< a chunk, or a row of a database
  std::uint64_t offset = 0;  ///< in it
  std::uint32_t size = 0;    ///< bytes
};

/// The largest message that is read, bytes: an image of the largest size in floats, and its header.
inline constexpr std::uint32_t kLargestMessage = 68u << 20;

/// Bytes of a message that scan() passes on if it is not in a chunk.
inline constexpr std::uint32_t kMessageBeginning = 256;

/// A recording of messages: ROS 1 .bag, ROS 2 .mcap and .db3. Every length in it is checked before it is
/// used. One thread at a time.
class BagFile {
 public:
  using Bytes = std::span<const std::uint8_t>;
  /// A message in the order of the file: topic number, time of recording (ns), the message or its beginning.
  using Visit =
      std::function<void(std::size_t topic, std::int64_t time_ns, Bytes beginning, const BagPlace& place)>;

  virtual ~BagFile() = default;

  /// Calls `visit` for each message whose type is one of sensor_msgs. To be called once, before the others.
  /// Throws Error (unreadable) if the file is not of its kind; where it is damaged or truncated, reading
  /// stops and problems() says so.
  virtual void scan(const Visit& visit) = 0;

  /// The topics that scan() met.
  virtual const std::vector<BagTopic>& topics() const = 0;

  /// The bytes of a message, valid until the next call. Throws std::runtime_error with the reason.
  virtual Bytes read(const BagPlace& place) = 0;

  /// What is wrong with the file; one line each.
  virtual const std::vector<std::string>& problems() const = 0;
};

/// Open each kind. Throw Error (unreadable): no such file, or not of that kind.
std::unique_ptr<BagFile> open_mcap(const std::filesystem::path& path);
std::unique_ptr<BagFile> open_ros1_bag(const std::filesystem::path& path);
std::unique_ptr<BagFile> open_db3(const std::filesystem::path& path);

/// A file of a recording that is split into several.
struct BagPart {
  std::string name;  ///< for problems
  std::unique_ptr<BagFile> file;
};

/// The parts as one recording. They are scanned in their order.
std::unique_ptr<BagFile> join_bags(std::vector<BagPart> parts);

}  // namespace saccade
