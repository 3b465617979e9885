// The SQLite database of ROS 2: tables topics (id, name, type, serialization_format) and messages (id,
// topic_id, timestamp, data).
#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>
#include <sqlite3.h>

#include "core/error.hpp"
#include "sources/bag_file.hpp"

namespace saccade {
namespace {

using Bytes = BagFile::Bytes;

struct CloseDatabase {
  void operator()(sqlite3* database) const { sqlite3_close_v2(database); }
};
struct FinishStatement {
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
struct CloseBlob {
  void operator()(sqlite3_blob* blob) const { sqlite3_blob_close(blob); }
};
using Statement = std::unique_ptr<sqlite3_stmt, FinishStatement>;

// The pages of a damaged database may refer to each other so that a table never ends. While this lives,
// SQLite stops (SQLITE_INTERRUPT) after more instructions than reading a sound file of this size needs.
class StepLimit {
 public:
  StepLimit(sqlite3* database, std::uintmax_t file_bytes)
      : database_(database), left_((kFew + kPerByte * file_bytes) / kInterval) {
    sqlite3_progress_handler(
        database, kInterval, [](void* self) { return static_cast<StepLimit*>(self)->left_-- == 0 ? 1 : 0; },
        this);
  }
  ~StepLimit() { sqlite3_progress_handler(database_, 0, nullptr, nullptr); }
  StepLimit(const StepLimit&) = delete;
  StepLimit& operator=(const StepLimit&) = delete;

 private:
  static constexpr int kInterval = 1000;
  static constexpr std::uintmax_t kFew = 1'000'000, kPerByte = 20;
  sqlite3* database_;
  std::uintmax_t left_;
};

// The name of a file in a URI.
std::string escaped(const std::string& path) {
  std::string text;
  for (const char c : path)
    text += c == '?' || c == '#' || c == '%' ? fmt::format("%{:02X}", c) : std::string(1, c);
  return text;
}

class Db3File final : public BagFile {
 public:
  explicit Db3File(const std::filesystem::path& path) : path_(path.string()) {
    sqlite3* opened = nullptr;
    // Immutable: no journal beside it is applied, and nothing is locked or written.
    const std::string uri = "file:" + escaped(path_) + "?mode=ro&immutable=1";
    const int code = sqlite3_open_v2(uri.c_str(), &opened, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
    database_.reset(opened);
    if (code != SQLITE_OK) throw unreadable("cannot open the database", path_, "check its permissions");
    sqlite3_limit(opened, SQLITE_LIMIT_LENGTH, static_cast<int>(kLargestMessage) + (1 << 20));
    sqlite3_db_config(opened, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    sqlite3_db_config(opened, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
    std::error_code ignored;
    if (const auto bytes = std::filesystem::file_size(path, ignored); !ignored) bytes_ = bytes;
    const StepLimit limit(opened, bytes_);
    read_topics();
  }

  void scan(const Visit& visit) override {
    const StepLimit limit(database_.get(), bytes_);
    const Statement rows = prepare("SELECT rowid, topic_id, timestamp FROM messages ORDER BY rowid");
    if (!rows) return problems_.push_back(reason());
    int code = SQLITE_OK;
    std::optional<sqlite3_int64> last;
    while ((code = sqlite3_step(rows.get())) == SQLITE_ROW) {
      const sqlite3_int64 row = sqlite3_column_int64(rows.get(), 0);
      if (last && row <= *last)
        return problems_.push_back("the database is damaged: its messages are not in their order");
      last = row;
      const auto topic = numbers_.find(sqlite3_column_int64(rows.get(), 1));
      if (topic == numbers_.end() || !topics_[topic->second].type.starts_with("sensor_msgs/")) continue;
      give(topic->second, row, sqlite3_column_int64(rows.get(), 2), visit);
    }
    if (code != SQLITE_DONE) problems_.push_back(reason());
  }

  const std::vector<BagTopic>& topics() const override { return topics_; }
  const std::vector<std::string>& problems() const override { return problems_; }

  Bytes read(const BagPlace& place) override {
    message_.resize(place.size);
    read_blob(static_cast<sqlite3_int64>(place.part), message_);
    return message_;
  }

 private:
  Statement prepare(const char* sql) const {
    sqlite3_stmt* statement = nullptr;
    sqlite3_prepare_v2(database_.get(), sql, -1, &statement, nullptr);
    return Statement(statement);
  }

  std::string reason() const {
    if (sqlite3_errcode(database_.get()) == SQLITE_INTERRUPT)
      return "the database is damaged: reading it does not end";
    return fmt::format("the database is damaged or truncated: {}", sqlite3_errmsg(database_.get()));
  }

  static std::string text(const Statement& row, int column) {
    const auto* value = reinterpret_cast<const char*>(sqlite3_column_text(row.get(), column));
    return value == nullptr ? std::string() : std::string(value);
  }

  void read_topics() {
    const Statement rows = prepare("SELECT id, name, type, serialization_format FROM topics");
    if (!rows)
      throw unreadable("not a recording of ROS 2: " + std::string(sqlite3_errmsg(database_.get())), path_,
                       "is it the right file?");
    int code = SQLITE_OK;
    while ((code = sqlite3_step(rows.get())) == SQLITE_ROW) {
      BagTopic topic{text(rows, 1), text(rows, 2), BagEncoding::cdr};
      if (const auto msg = topic.type.find("/msg/"); msg != std::string::npos) topic.type.erase(msg, 4);
      if (text(rows, 3) != "cdr") continue;
      numbers_[sqlite3_column_int64(rows.get(), 0)] = topics_.size();
      topics_.push_back(std::move(topic));
    }
    if (code != SQLITE_DONE) throw unreadable(reason(), path_, "is it the right file?");
  }

  std::unique_ptr<sqlite3_blob, CloseBlob> open_blob(sqlite3_int64 row) const {
    sqlite3_blob* blob = nullptr;
    if (sqlite3_blob_open(database_.get(), "main", "messages", "data", row, 0, &blob) != SQLITE_OK)
      throw std::runtime_error(reason());
    return std::unique_ptr<sqlite3_blob, CloseBlob>(blob);
  }

  // Fills `bytes` from the beginning of a message.
  void read_blob(sqlite3_int64 row, std::span<std::uint8_t> bytes) const {
    const auto blob = open_blob(row);
    const auto size = static_cast<int>(bytes.size());
    if (sqlite3_blob_bytes(blob.get()) < size ||
        sqlite3_blob_read(blob.get(), bytes.data(), size, 0) != SQLITE_OK)
      throw std::runtime_error(reason());
  }

  void give(std::size_t topic, sqlite3_int64 row, std::int64_t time_ns, const Visit& visit) {
    try {
      const int size = sqlite3_blob_bytes(open_blob(row).get());
      if (size < 0 || static_cast<std::uint32_t>(size) > kLargestMessage) return;
      message_.resize(std::min(static_cast<std::uint32_t>(size), kMessageBeginning));
      read_blob(row, message_);
      visit(topic, time_ns, message_, {static_cast<std::uint64_t>(row), 0, static_cast<std::uint32_t>(size)});
    } catch (const std::runtime_error& error) {
      if (problems_.empty()) problems_.push_back(fmt::format("message {}: {}", row, error.what()));
    }
  }

  std::string path_;
  std::uintmax_t bytes_ = 0;  // of the file
  std::unique_ptr<sqlite3, CloseDatabase> database_;
  std::map<std::int64_t, std::size_t> numbers_;  // of topics, by their ids
  std::vector<BagTopic> topics_;
  std::vector<std::string> problems_;
  std::vector<std::uint8_t> message_;
};

}  // namespace

std::unique_ptr<BagFile> open_db3(const std::filesystem::path& path) {
  return std::make_unique<Db3File>(path);
}

}  // namespace saccade
