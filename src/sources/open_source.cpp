#include "sources/open_source.hpp"

#include <algorithm>
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

// A source with one note more.
class NotedSource final : public FrameSource {
 public:
  NotedSource(std::unique_ptr<FrameSource> source, std::string note)
      : source_(std::move(source)), info_(source_->info()) {
    info_.notes.push_back(std::move(note));
  }
  const SourceInfo& info() const override { return info_; }
  ReadResult read(Frame& frame, std::chrono::milliseconds timeout) override {
    return source_->read(frame, timeout);
  }
  void seek(std::int64_t index) override { source_->seek(index); }
  SourceState state() const override { return source_->state(); }
  void interrupt() noexcept override { source_->interrupt(); }

 private:
  std::unique_ptr<FrameSource> source_;
  SourceInfo info_;
};

// Looks at the first usable frame of a file: depth in a wrong unit gives an empty map without a word.
std::unique_ptr<FrameSource> check_depth(std::unique_ptr<FrameSource> source) {
  constexpr int kTries = 3;
  if (!source->info().has_depth || source->info().live) return source;
  Frame frame;
  ReadResult result{ReadStatus::rejected, {}};
  for (int i = 0; i < kTries && result.status == ReadStatus::rejected; ++i)
    result = source->read(frame, std::chrono::milliseconds(0));
  source->seek(0);
  if (result.status != ReadStatus::frame) return source;
  auto note = describe_implausible_depth(frame.depth_mm, source->info().depth_unit_mm);
  return note ? std::make_unique<NotedSource>(std::move(source), *std::move(note)) : std::move(source);
}

}  // namespace

std::unique_ptr<FrameSource> open_source(const std::string& uri, const SourceOptions& options) {
  const SourceInput input(uri);
  try {
    const SourceKind* kind = kind_of(input);
    if (kind == nullptr) throw not_recognised(input);
    auto source = kind->open(input, options);
    return kind->is_path ? check_depth(std::move(source)) : std::move(source);
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
