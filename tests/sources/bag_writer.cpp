#include "bag_writer.hpp"

#include <cstring>
#include <map>
#include <stdexcept>
#include <string_view>

#include <bzlib.h>
#include <libdeflate.h>
#include <lz4frame.h>
#include <sqlite3.h>
#include <zstd.h>

#include "core/file.hpp"

namespace saccade {
namespace {

using Bytes = std::vector<std::uint8_t>;

template <typename T>
void put(Bytes& out, T value) {
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(&value);
  out.insert(out.end(), bytes, bytes + sizeof value);
}

void put_bytes(Bytes& out, const Bytes& bytes) { out.insert(out.end(), bytes.begin(), bytes.end()); }

void put_text(Bytes& out, std::string_view text) {
  put(out, static_cast<std::uint32_t>(text.size()));
  out.insert(out.end(), text.begin(), text.end());
}

class Serialiser {
 public:
  explicit Serialiser(bool cdr) : cdr_(cdr) {}

  template <typename T>
  void number(T value) {
    while (cdr_ && body_.size() % sizeof(T) != 0) body_.push_back(0);
    put(body_, value);
  }
  void text(const std::string& text) {
    number(static_cast<std::uint32_t>(text.size() + (cdr_ ? 1 : 0)));
    body_.insert(body_.end(), text.begin(), text.end());
    if (cdr_) body_.push_back(0);
  }
  void bytes(const Bytes& bytes) {
    number(static_cast<std::uint32_t>(bytes.size()));
    put_bytes(body_, bytes);
  }
  void header(std::int64_t stamp_ns) {
    if (!cdr_) number(std::uint32_t{0});
    number(static_cast<std::uint32_t>(stamp_ns / 1'000'000'000));
    number(static_cast<std::uint32_t>(stamp_ns % 1'000'000'000));
    text("camera_optical");
  }
  Bytes take() const {
    Bytes out;
    if (cdr_) out = {0, 1, 0, 0};
    put_bytes(out, body_);
    return out;
  }

 private:
  bool cdr_;
  Bytes body_;
};

Bytes compress(const Bytes& data, const std::string& method) {
  if (method.empty() || method == "none") return data;
  Bytes out;
  if (method == "lz4") {
    out.resize(LZ4F_compressFrameBound(data.size(), nullptr));
    out.resize(LZ4F_compressFrame(out.data(), out.size(), data.data(), data.size(), nullptr));
  } else if (method == "zstd") {
    out.resize(ZSTD_compressBound(data.size()));
    out.resize(ZSTD_compress(out.data(), out.size(), data.data(), data.size(), 1));
  } else if (method == "bz2") {
    auto size = static_cast<unsigned>(data.size() + data.size() / 50 + 1000);
    out.resize(size);
    Bytes copy = data;
    if (BZ2_bzBuffToBuffCompress(reinterpret_cast<char*>(out.data()), &size,
                                 reinterpret_cast<char*>(copy.data()), static_cast<unsigned>(copy.size()), 9,
                                 0, 0) != BZ_OK)
      throw std::runtime_error("bz2");
    out.resize(size);
  } else {
    out = data;  // a method that no reader knows
  }
  return out;
}

// The number of each topic, in the order in which they come.
std::map<std::string, std::uint32_t> number_topics(const std::vector<TestMessage>& messages) {
  std::map<std::string, std::uint32_t> numbers;
  for (const TestMessage& message : messages)
    numbers.emplace(message.topic, static_cast<std::uint32_t>(numbers.size() + 1));
  return numbers;
}

template <typename T>
Bytes little(T value) {
  Bytes out;
  put(out, value);
  return out;
}

Bytes text_bytes(std::string_view text) { return {text.begin(), text.end()}; }

void put_bag_record(Bytes& out, const std::vector<std::pair<std::string, Bytes>>& fields, const Bytes& data) {
  Bytes header;
  for (const auto& [name, value] : fields) {
    put(header, static_cast<std::uint32_t>(name.size() + 1 + value.size()));
    put_bytes(header, text_bytes(name + "="));
    put_bytes(header, value);
  }
  put(out, static_cast<std::uint32_t>(header.size()));
  put_bytes(out, header);
  put(out, static_cast<std::uint32_t>(data.size()));
  put_bytes(out, data);
}

Bytes bag_time(std::int64_t time_ns) {
  Bytes out;
  put(out, static_cast<std::uint32_t>(time_ns / 1'000'000'000));
  put(out, static_cast<std::uint32_t>(time_ns % 1'000'000'000));
  return out;
}

void put_bag_field(Bytes& out, const std::string& field) { put_text(out, field); }

void put_mcap_record(Bytes& out, std::uint8_t type, const Bytes& content) {
  out.push_back(type);
  put(out, static_cast<std::uint64_t>(content.size()));
  put_bytes(out, content);
}

std::string ros2_type(std::string type) { return type.insert(type.find('/'), "/msg"); }

// Schemas, channels and messages.
Bytes mcap_records(const std::vector<TestMessage>& messages) {
  const auto numbers = number_topics(messages);
  std::map<std::string, bool> defined;
  Bytes out;
  for (const TestMessage& message : messages) {
    const auto number = static_cast<std::uint16_t>(numbers.at(message.topic));
    if (!defined[message.topic]) {
      Bytes schema = little(number), channel = little(number);
      put_text(schema, ros2_type(message.type));
      put_text(schema, "ros2msg");
      put_text(schema, "...");
      put_mcap_record(out, 3, schema);
      put(channel, number);
      put_text(channel, message.topic);
      put_text(channel, "cdr");
      put(channel, std::uint32_t{0});
      put_mcap_record(out, 4, channel);
      defined[message.topic] = true;
    }
    Bytes record = little(number);
    put(record, std::uint32_t{0});
    put(record, message.time_ns);
    put(record, message.time_ns);
    put_bytes(record, message.bytes);
    put_mcap_record(out, 5, record);
  }
  return out;
}

const Bytes kMcapMagic = {0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};

Bytes mcap_begin() {
  Bytes out = kMcapMagic, header;
  put_text(header, "ros2");
  put_text(header, "test");
  put_mcap_record(out, 1, header);
  return out;
}

void mcap_end(Bytes& out) {
  put_mcap_record(out, 15, little(std::uint32_t{0}));
  put_mcap_record(out, 2, Bytes(20, 0));
  put_bytes(out, kMcapMagic);
}

class RvlWriter {
 public:
  static std::vector<std::uint8_t> encode(const cv::Mat1w& image) {
    RvlWriter writer;
    std::uint32_t before = 0;
    for (auto pixel = image.begin(); pixel != image.end();) {
      const auto other = std::find_if(pixel, image.end(), [](std::uint16_t value) { return value != 0; });
      const auto zero = std::find(other, image.end(), std::uint16_t{0});
      writer.put(static_cast<std::uint32_t>(other - pixel));
      writer.put(static_cast<std::uint32_t>(zero - other));
      for (pixel = other; pixel != zero; ++pixel) {
        const auto difference = static_cast<std::int32_t>(*pixel - before);
        writer.put(static_cast<std::uint32_t>(difference) << 1 ^
                   static_cast<std::uint32_t>(difference >> 31));
        before = *pixel;
      }
    }
    while (writer.groups_ % 8 != 0) writer.put_group(0);
    return writer.bytes_;
  }

 private:
  void put(std::uint32_t value) {
    for (; value > 7; value >>= 3) put_group((value & 7U) | 8U);
    put_group(value);
  }
  void put_group(std::uint32_t group) {
    word_ = word_ << 4 | group;
    if (++groups_ % 8 == 0)
      for (const int shift : {0, 8, 16, 24}) bytes_.push_back(static_cast<std::uint8_t>(word_ >> shift));
  }

  std::vector<std::uint8_t> bytes_;
  std::uint32_t word_ = 0, groups_ = 0;
};

}  // namespace

TestMessage MessageWriter::image(const std::string& topic, std::int64_t stamp_ns, const cv::Mat& image,
                                 const std::string& encoding) const {
  Serialiser out(cdr_);
  out.header(stamp_ns);
  out.number(static_cast<std::uint32_t>(image.rows));
  out.number(static_cast<std::uint32_t>(image.cols));
  out.text(encoding);
  out.number(std::uint8_t{0});
  const std::size_t row = static_cast<std::size_t>(image.cols) * image.elemSize();
  out.number(static_cast<std::uint32_t>(row));
  Bytes data;
  for (int r = 0; r < image.rows; ++r) data.insert(data.end(), image.ptr(r), image.ptr(r) + row);
  out.bytes(data);
  return {topic, "sensor_msgs/Image", stamp_ns, out.take()};
}

TestMessage MessageWriter::compressed(const std::string& topic, std::int64_t stamp_ns,
                                      const std::string& format, const Bytes& data) const {
  Serialiser out(cdr_);
  out.header(stamp_ns);
  out.text(format);
  out.bytes(data);
  return {topic, "sensor_msgs/CompressedImage", stamp_ns, out.take()};
}

TestMessage MessageWriter::camera(const std::string& topic, std::int64_t stamp_ns, cv::Size size,
                                  const Intrinsics& camera, const TestLens& lens) const {
  Serialiser out(cdr_);
  const auto integer = [&](int value) { out.number(static_cast<std::uint32_t>(value)); };
  const auto reals = [&](std::initializer_list<double> values) {
    for (const double value : values) out.number(value);
  };
  out.header(stamp_ns);
  integer(size.height);
  integer(size.width);
  out.text(lens.model);
  integer(static_cast<int>(lens.distortion.size()));
  for (const double value : lens.distortion) out.number(value);
  reals({camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1});
  reals({1, 0, 0, 0, 1, 0, 0, 0, 1});
  reals({lens.rectified.fx, 0, lens.rectified.cx, 0, 0, lens.rectified.fy, lens.rectified.cy, 0, 0, 0, 1, 0});
  for (const int value :
       {lens.binning, lens.binning, lens.part.x, lens.part.y, lens.part.height, lens.part.width})
    integer(value);
  out.number(std::uint8_t{0});
  return {topic, "sensor_msgs/CameraInfo", stamp_ns, out.take()};
}

void write_ros1_bag(const std::filesystem::path& path, const std::vector<TestMessage>& messages,
                    const std::string& compression) {
  const auto numbers = number_topics(messages);
  std::map<std::string, bool> defined;
  Bytes chunk;
  for (const TestMessage& message : messages) {
    const Bytes number = little(numbers.at(message.topic));
    if (!defined[message.topic]) {
      Bytes connection;
      put_bag_field(connection, "topic=" + message.topic);
      put_bag_field(connection, "type=" + message.type);
      put_bag_record(chunk, {{"op", {7}}, {"conn", number}, {"topic", text_bytes(message.topic)}},
                     connection);
      defined[message.topic] = true;
    }
    put_bag_record(chunk, {{"op", {2}}, {"conn", number}, {"time", bag_time(message.time_ns)}},
                   message.bytes);
  }
  Bytes out = text_bytes("#ROSBAG V2.0\n");
  put_bag_record(out,
                 {{"op", {3}},
                  {"index_pos", little(std::uint64_t{0})},
                  {"conn_count", little(std::uint32_t{1})},
                  {"chunk_count", little(std::uint32_t{1})}},
                 Bytes(100, ' '));
  put_bag_record(out,
                 {{"op", {5}},
                  {"compression", text_bytes(compression)},
                  {"size", little(static_cast<std::uint32_t>(chunk.size()))}},
                 compress(chunk, compression));
  write_file(path, out);
}

void write_mcap(const std::filesystem::path& path, const std::vector<TestMessage>& messages,
                const std::string& compression, bool checksum) {
  const Bytes records = mcap_records(messages), compressed = compress(records, compression);
  Bytes chunk = little(std::uint64_t{0});
  put(chunk, std::uint64_t{0});
  put(chunk, static_cast<std::uint64_t>(records.size()));
  put(chunk, checksum ? libdeflate_crc32(0, records.data(), records.size()) : std::uint32_t{0});
  put_text(chunk, compression);
  put(chunk, static_cast<std::uint64_t>(compressed.size()));
  put_bytes(chunk, compressed);
  Bytes out = mcap_begin();
  put_mcap_record(out, 6, chunk);
  mcap_end(out);
  write_file(path, out);
}

void write_plain_mcap(const std::filesystem::path& path, const std::vector<TestMessage>& messages) {
  Bytes out = mcap_begin();
  put_bytes(out, mcap_records(messages));
  mcap_end(out);
  write_file(path, out);
}

void write_db3(const std::filesystem::path& path, const std::vector<TestMessage>& messages,
               const std::string& serialisation) {
  sqlite3* database = nullptr;
  if (sqlite3_open(path.c_str(), &database) != SQLITE_OK) throw std::runtime_error("sqlite");
  const auto run = [&](const std::string& sql) {
    if (sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
      throw std::runtime_error(sqlite3_errmsg(database));
  };
  run("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
      "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL)");
  run("CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL, "
      "data BLOB NOT NULL)");
  const auto numbers = number_topics(messages);
  std::map<std::string, bool> defined;
  for (const TestMessage& message : messages) {
    const std::string number = std::to_string(numbers.at(message.topic));
    if (!std::exchange(defined[message.topic], true))
      run("INSERT INTO topics VALUES(" + number + ",'" + message.topic + "','" + ros2_type(message.type) +
          "','" + serialisation + "','')");
    sqlite3_stmt* statement = nullptr;
    sqlite3_prepare_v2(database, "INSERT INTO messages(topic_id, timestamp, data) VALUES(?, ?, ?)", -1,
                       &statement, nullptr);
    sqlite3_bind_int64(statement, 1, numbers.at(message.topic));
    sqlite3_bind_int64(statement, 2, message.time_ns);
    sqlite3_bind_blob(statement, 3, message.bytes.data(), static_cast<int>(message.bytes.size()),
                      SQLITE_STATIC);
    sqlite3_step(statement);
    sqlite3_finalize(statement);
  }
  sqlite3_close(database);
}

std::vector<std::uint8_t> encode_rvl(const cv::Mat1w& image) { return RvlWriter::encode(image); }

}  // namespace saccade
