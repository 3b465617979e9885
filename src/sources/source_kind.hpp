#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "core/frame_source.hpp"
#include "sources/source_options.hpp"

namespace saccade {

/// The SOURCE that a user gave, examined once for all kinds.
struct SourceInput {
  enum class Type { absent, file, folder, special };  ///< special: a pipe, a socket or a device

  explicit SourceInput(const std::string& uri);

  std::string uri;             ///< as the user wrote it
  std::filesystem::path path;  ///< the same as a path
  Type type = Type::absent;    ///< what the file system has there
  std::string ending;          ///< ending_of(path)
  std::string head;            ///< a file's first bytes, at most 1024; empty if it cannot be read
};

/// One kind of source. The file that reads a kind ends with its row; source_kinds.cpp lists the rows.
struct SourceKind {
  std::string_view name;           ///< as in SourceInfo::kind: "oni"
  std::string_view written;        ///< as what SOURCE is written: "FILE.oni"
  std::string_view help;           ///< what is read, in one line
  std::string_view recognised_by;  ///< the same in words as `endings` and `recognises`

  /// A file with one of these endings (lower case, ".oni") is of this kind.
  std::span<const std::string_view> endings{};
  /// True for other inputs of this kind, by the form of the text or by the content. May be nullptr.
  bool (*recognises)(const SourceInput& input) = nullptr;
  /// Throws Error: (unreadable) it cannot be read, (usage) the text has a mistake.
  std::unique_ptr<FrameSource> (*open)(const SourceInput& input, const SourceOptions& options) = nullptr;
  bool is_path = true;      ///< false: SOURCE names a device or a scene, not files; its depth is in mm
  bool is_device = false;   ///< a sensor or a camera
  bool has_topics = false;  ///< it may hold several streams, among which InputSettings choose
  bool built = true;        ///< false: this build leaves it out, and open() throws Error (usage)
};

/// The ending of a file's name, in lower case with its dot: ".oni"; empty = none.
std::string ending_of(const std::filesystem::path& file);

/// All kinds, in the order in which they are tried and listed. A row stays in a build that leaves it out.
std::span<const SourceKind* const> source_kinds();

/// The first kind that recognises the input; nullptr if none does.
const SourceKind* kind_of(const SourceInput& input);

}  // namespace saccade
