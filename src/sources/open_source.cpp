#include "sources/open_source.hpp"

#include <algorithm>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/depth_units.hpp"
#include "core/error.hpp"
#include "sources/source_kind.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

// A field of all kinds that `choose` takes, each text once.
template <typename Choose>
std::string join(std::string_view SourceKind::*field, Choose choose) {
  std::vector<std::string_view> texts;
  for (const SourceKind* kind : source_kinds())
    if (choose(*kind) && std::ranges::count(texts, kind->*field) == 0) texts.push_back(kind->*field);
  return fmt::format("{}", fmt::join(texts, ", "));
}

std::string known_endings() {
  std::vector<std::string_view> endings;
  for (const SourceKind* kind : source_kinds())
    endings.insert(endings.end(), kind->endings.begin(), kind->endings.end());
  return fmt::format("{}", fmt::join(endings, " "));
}

// The error for an input that no kind recognises. Throws std::filesystem::filesystem_error for a folder that
// cannot be listed.
Error not_recognised(const SourceInput& input) {
  switch (input.type) {
    case SourceInput::Type::folder:
      fs::directory_iterator(input.path);  // throws if the folder cannot be listed
      return unreadable("no frames in the folder", input.uri,
                        "expected " + join(&SourceKind::recognised_by,
                                           [](const SourceKind& kind) { return kind.written == "FOLDER"; }));
    case SourceInput::Type::file:
      return unreadable("not a kind of file that can be read", input.uri,
                        "known endings: " + known_endings());
    case SourceInput::Type::special:
      return unreadable("not a regular file", input.uri, "copy its content to a file");
    case SourceInput::Type::absent:
      break;
  }
  return unreadable("no such source", input.uri,
                    has_source_ending(input.path) ? "check the path" : "expected " + source_forms());
}

// What a user says about a source must have an effect: a unit that is ignored gives wrong lengths without a
// word.
void check_input_settings(const SourceKind& kind, const InputSettings& settings, const std::string& uri) {
  if (settings.depth_unit_mm > 0 && !kind.is_path)
    throw usage_error("--depth-unit has no effect on this source", uri,
                      "it is for files; leave it out: the depth of a sensor or a scene is in mm");
  const bool topics =
      !(settings.depth_topic.empty() && settings.colour_topic.empty() && settings.camera_topic.empty());
  if (topics && !kind.has_topics)
    throw usage_error("--topics has no effect on this source", uri,
                      "it is for recordings of ROS; leave it out");
}

// A file whose first frames, up to the first usable one, are read when it is opened, to look at their depth:
// a wrong unit would give an empty map without a word. They are given to the first reader, not read again.
class ExaminedSource final : public FrameSource {
 public:
  explicit ExaminedSource(std::unique_ptr<FrameSource> source)
      : source_(std::move(source)), info_(source_->info()) {
    constexpr std::size_t kMost = 3;
    do {
      Taken& taken = ahead_.emplace_back();
      taken.result = source_->read(taken.frame, std::chrono::milliseconds(0));
    } while (ahead_.back().result.status == ReadStatus::rejected && ahead_.size() < kMost);
    if (ahead_.back().result.status != ReadStatus::frame) return;
    if (auto note = describe_implausible_depth(ahead_.back().frame.depth_mm, info_.depth_unit_mm))
      info_.notes.push_back(*std::move(note));
  }

  const SourceInfo& info() const override { return info_; }

  ReadResult read(Frame& frame, std::chrono::milliseconds timeout) override {
    if (ahead_.empty()) return source_->read(frame, timeout);
    std::swap(frame, ahead_.front().frame);
    ReadResult result = std::move(ahead_.front().result);
    ahead_.pop_front();
    ++next_;
    return result;
  }

  void seek(std::int64_t index) override {
    if (!ahead_.empty() && index == next_) return;
    ahead_.clear();
    source_->seek(index);
  }

  SourceState state() const override { return source_->state(); }
  void interrupt() noexcept override { source_->interrupt(); }

 private:
  struct Taken {
    Frame frame;
    ReadResult result;
  };

  std::unique_ptr<FrameSource> source_;
  SourceInfo info_;
  std::deque<Taken> ahead_;
  std::int64_t next_ = 0;  // the position of the first of ahead_
};

}  // namespace

std::unique_ptr<FrameSource> open_source(const std::string& uri, const SourceOptions& options) {
  const SourceInput input(uri);
  try {
    const SourceKind* kind = kind_of(input);
    if (kind == nullptr) throw not_recognised(input);
    check_input_settings(*kind, options.input, uri);
    auto source = kind->open(input, options);
    if (options.input.depth_unit_mm > 0 && !source->info().has_depth)
      throw usage_error("--depth-unit has no effect on this source", uri, "it has no depth; leave it out");
    if (!kind->is_path || !source->info().has_depth) return source;
    return std::make_unique<ExaminedSource>(std::move(source));
  } catch (const fs::filesystem_error& error) {
    throw unreadable("cannot list the folder: " + error.code().message(), error.path1().string(),
                     "check its permissions");
  }
}

bool has_source_ending(const fs::path& file) {
  const std::string ending = ending_of(file);
  return std::ranges::any_of(
      source_kinds(), [&](const SourceKind* kind) { return std::ranges::count(kind->endings, ending) > 0; });
}

bool names_device(const std::string& uri) {
  const SourceKind* kind = kind_of(SourceInput(uri));
  return kind != nullptr && kind->is_device;
}

std::string source_forms() {
  return join(&SourceKind::written, [](const SourceKind&) { return true; });
}

std::string source_help() {
  std::string text = "Sources:\n";
  for (const SourceKind* kind : source_kinds())
    text +=
        fmt::format("  {:<29} {}{}\n", kind->written, kind->help, kind->built ? "" : " (not in this build)");
  return text;
}

}  // namespace saccade
