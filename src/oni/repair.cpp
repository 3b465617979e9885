#include "oni/repair.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/setting.hpp"
#include "oni/record_writer.hpp"
#include "oni/recording.hpp"
#include "oni/walker.hpp"

namespace saccade {
namespace {

constexpr std::size_t kMaxPropertyBytes = 16u << 20;  // of all nodes; genuine files have far less

// True for nodes that a player can decode, and for nodes that hold no frames.
bool is_playable(const Recording& recording, const OniNode& node) {
  if (!is_known(node.declared.codec)) return false;
  if (!holds_frames(node.declared.type)) return true;
  const std::uint64_t position =
      node.frames.empty() ? recording.index().file_size : node.frames.front().payload_position;
  return !format_at(node, position).unusable;
}

// The frames of a piece: numbers of the depth stream, and the times of the others.
struct Window {
  const OniNode* depth = nullptr;
  std::size_t first = 0, last = 0;
  std::uint64_t from_us = 0, to_us = 0;

  bool holds(const OniNode& node, std::size_t k, std::uint64_t time_us) const {
    return &node == depth ? k >= first && k <= last : time_us >= from_us && time_us <= to_us;
  }
};

Window window_of(const Recording& recording, const OniPiece& piece) {
  const OniNode* depth = main_depth(recording);
  const std::string& name = recording.file().name();
  if (depth == nullptr) throw unreadable("no depth frames in this recording", name, "");
  const auto& frames = depth->frames;
  const std::uint64_t begin_us = frames.front().timestamp_us;
  const auto inside = [&](std::size_t k) {
    const std::uint64_t place =
        piece.times ? std::max(frames[k].timestamp_us, begin_us) - begin_us : std::uint64_t{k};
    return place >= piece.first && place <= piece.last;
  };
  Window window{depth, frames.size(), 0, 0, 0};
  for (std::size_t k = 0; k < frames.size(); ++k) {
    if (!inside(k)) continue;
    window.first = std::min(window.first, k);
    window.last = k;
  }
  if (window.first == frames.size())
    throw usage_error("no depth frame is in this piece", name,
                      fmt::format("it has frames 0..{}", frames.size() - 1));
  // As far as a reader looks for the colour of a depth frame.
  constexpr std::uint64_t kTolerance_us = 25'000;
  const std::uint64_t first_us = frames[window.first].timestamp_us;
  window.from_us = first_us - std::min(first_us, kTolerance_us);
  window.to_us = frames[window.last].timestamp_us + kTolerance_us;
  return window;
}

class Repair {
 public:
  Repair(const std::filesystem::path& from, const std::filesystem::path& to, bool overwrite,
         const std::optional<OniPiece>& piece = {})
      : recording_(from), index_(recording_.index()) {
    if (piece) window_ = window_of(recording_, *piece);
    for (const OniNode& node : index_.nodes) {
      if (is_playable(recording_, node))
        kept_.insert(node.id);
      else
        report_.notes.push_back(fmt::format("node {} ({}) cannot be played and is omitted", node.id,
                                            to_string(node.declared.type)));
    }
    const bool any = std::any_of(index_.nodes.begin(), index_.nodes.end(), [&](const OniNode& node) {
      return holds_frames(node.declared.type) && kept_.contains(node.id);
    });
    if (!any) throw unreadable("no stream can be repaired", from.string(), "");
    writer_.emplace(to, overwrite);
  }

  OniRepairReport run() {
    try {
      copy();
      if (report_.frames == 0)
        throw unreadable("no frame can be saved", recording_.file().name(),
                         "every frame of the recording is damaged");
      writer_->close();
    } catch (const Error&) {
      writer_->remove();
      throw;
    }
    report_.lost_bytes = index_.lost_bytes;
    return report_;
  }

 private:
  void copy() {
    OniWalker walker(recording_.file());
    for (const OniNode& node : index_.nodes)
      if (kept_.contains(node.id)) writer_->add_node(node.id, node.declared);
    const std::uint64_t first_frame = first_frame_position();
    bool begun = false;
    while (const auto record = walker.next()) {
      if (!begun && record->payload_position() >= first_frame) {
        complete_properties();
        writer_->begin();
        begun = true;
      }
      if (!kept_.contains(record->node) || record->position < index_.find(record->node)->position) continue;
      if (is_property(record->type)) copy_property(*record);
      if (record->type == OniRecordType::new_data) copy_frame(*record);
    }
    if (begun) return;
    complete_properties();
    writer_->begin();
  }

  std::uint64_t first_frame_position() const {
    std::uint64_t first = index_.file_size;
    for (const OniNode& node : index_.nodes)
      if (!node.frames.empty()) first = std::min(first, node.frames.front().payload_position);
    return first;
  }

  // Adds the properties without which the stock players refuse a stream (README 11).
  void complete_properties() {
    for (const OniNode& node : index_.nodes) {
      if (!kept_.contains(node.id) || !holds_frames(node.declared.type)) continue;
      if (!written_.contains({node.id, std::string(oni_property::kCropping)})) {
        writer_->add_property(node.id, OniRecordType::general_property, oni_property::kCropping,
                              std::array<std::uint8_t, 12>{});
        report_.notes.push_back(fmt::format("added xnCropping to node {}", node.id));
      }
      if (node.declared.type == OniNodeType::depth &&
          !written_.contains({node.id, std::string(oni_property::kMaxDepth)})) {
        writer_->add_int(node.id, oni_property::kMaxDepth, kOniMaxDepth);
        report_.notes.push_back(fmt::format("added xnDeviceMaxDepth to node {}", node.id));
      }
    }
  }

  std::span<const std::uint8_t> read(std::uint64_t position, std::size_t size) {
    buffer_.resize(size);
    buffer_.resize(recording_.file().read(position, buffer_));
    return buffer_;
  }

  void copy_property(const OniRecord& record) {
    const std::size_t header = index_.header.record_header_size();
    const auto property = parse_property(read(record.position + header, record.fields_size - header));
    if (!property) return;
    const bool number =
        record.type == OniRecordType::int_property || record.type == OniRecordType::real_property;
    const auto known = known_property_size(property->name);
    if ((number && property->value.size() != 8) || (known && !known->allows(property->value.size()))) return;
    property_bytes_ += property->value.size();
    if (property_bytes_ > kMaxPropertyBytes) return;
    written_.insert({record.node, property->name});
    const bool crop = property->name == oni_property::kCropping;
    // Cropping outside the image makes a stock player read beyond the frame, so it is switched off.
    if (crop && !crop_is_possible(record))
      writer_->add_property(record.node, record.type, property->name, std::array<std::uint8_t, 12>{});
    else
      writer_->add_property(record.node, record.type, property->name, property->value);
  }

  bool crop_is_possible(const OniRecord& record) const {
    const OniNode& node = *index_.find(record.node);
    const auto crop = cropping_at(node, record.end());
    const OniFormat here = format_at(node, record.end());
    // The image size may come later in the file.
    const cv::Size size = here.size.empty() ? format_at(node, index_.file_size).size : here.size;
    return !crop || fits_in(*crop, size);
  }

  void copy_frame(const OniRecord& record) {
    const OniNode& node = *index_.find(record.node);
    std::size_t& k = next_frame_[record.node];
    // The index and this walk have the same records in the same order, but the index may hold fewer frames.
    if (k >= node.frames.size() || node.frames[k].payload_position != record.payload_position()) return;
    if (window_ && !window_->holds(node, k, record.timestamp_us)) {
      ++k;
      return;
    }
    const OniFormat format = recording_.format(node, k);
    const Outcome read_frame = node.declared.type == OniNodeType::depth
                                   ? recording_.read_stored_depth(node, k, depth_)
                                   : recording_.read_colour(node, k, colour_);
    ++k;
    if (!read_frame && format.pixels != OniPixelFormat::jpeg) {
      ++report_.bad_frames;
      return;
    }
    if (!writer_->write_frame(record.node, record.timestamp_us,
                              read(record.payload_position(), record.payload_size)))
      throw failed("disk full", writer_->name(), "free some space and try again");
    ++report_.frames;
  }

  Recording recording_;
  const OniIndex& index_;
  std::optional<OniRecordWriter> writer_;
  OniRepairReport report_;
  std::optional<Window> window_;                             // the piece to copy; none = everything
  std::set<std::uint32_t> kept_;                             // node ids
  std::set<std::pair<std::uint32_t, std::string>> written_;  // properties
  std::map<std::uint32_t, std::size_t> next_frame_;          // of each node
  std::size_t property_bytes_ = 0;
  std::vector<std::uint8_t> buffer_;
  cv::Mat1w depth_;
  cv::Mat3b colour_;
};

}  // namespace

OniRepairReport repair_recording(const std::filesystem::path& from, const std::filesystem::path& to,
                                 bool overwrite) {
  std::error_code code;
  if (std::filesystem::equivalent(from, to, code))
    throw usage_error("the repaired recording needs another name", to.string(),
                      "repair never changes the original");
  return Repair(from, to, overwrite).run();
}

OniPiece parse_piece(std::string_view text) {
  const std::string expected = "FROM..TO, frame numbers (10..20) or seconds (1.5s..3s), FROM not after TO";
  const auto dots = text.find("..");
  if (dots == std::string_view::npos) throw std::invalid_argument(expected);
  std::string_view from = text.substr(0, dots), to = text.substr(dots + 2);
  OniPiece piece;
  piece.times = from.ends_with('s') && to.ends_with('s');
  if (piece.times) {
    from.remove_suffix(1);
    to.remove_suffix(1);
    const auto us = [&](std::string_view part) {
      constexpr double kLongest_s = 1e9;
      return static_cast<std::uint64_t>(std::llround(parse_number(part, 0.0, kLongest_s, expected) * 1e6));
    };
    piece.first = us(from);
    piece.last = us(to);
  } else {
    constexpr std::uint64_t kMost = kOniMaxFrames;
    piece.first = parse_number(from, std::uint64_t{0}, kMost, expected);
    piece.last = parse_number(to, std::uint64_t{0}, kMost, expected);
  }
  if (piece.last < piece.first) throw std::invalid_argument(expected);
  return piece;
}

OniRepairReport cut_recording(const std::filesystem::path& from, const std::filesystem::path& to,
                              const OniPiece& piece, bool overwrite) {
  std::error_code code;
  if (std::filesystem::equivalent(from, to, code))
    throw usage_error("the piece needs a name of its own", to.string(), "cut never changes the original");
  return Repair(from, to, overwrite, piece).run();
}

}  // namespace saccade
