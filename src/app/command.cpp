#include "app/command.hpp"

#include <unistd.h>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "core/error.hpp"
#include "core/text.hpp"
#include "models/model.hpp"

namespace saccade {
namespace fs = std::filesystem;

void set_log_level(const Settings& settings) {
  spdlog::set_level(settings.quiet ? spdlog::level::warn : spdlog::level::from_str(settings.log_level));
}

void report_notes(const SourceInfo& source, const Settings& settings) {
  for (const std::string& note : source.notes) spdlog::warn("{}: {}", source.uri, note);
  const Intrinsics& camera = source.intrinsics;
  if (!settings.intrinsics && source.has_depth && camera.origin == IntrinsicsOrigin::guess)
    spdlog::warn(
        "{}: no calibration, guessing fx={:.6g} fy={:.6g} cx={:.6g} cy={:.6g} (specify --intrinsics "
        "fx,fy,cx,cy)",
        source.uri, camera.fx, camera.fy, camera.cx, camera.cy);
}

void report_state(const SourceState& state) {
  switch (state.connection) {
    case SourceState::Connection::streaming:
      if (state.losses > 0)
        spdlog::info("{} reconnected; {}, {:.1f} s in total", state.text, counted(state.losses, "dropout"),
                     state.away_s);
      for (const std::string& note : state.notes) spdlog::warn("{}: {}", state.text, note);
      return;
    case SourceState::Connection::waiting:
      if (::isatty(STDERR_FILENO) == 1) spdlog::info("{}", state.text);
      return;
    case SourceState::Connection::lost:
      spdlog::warn("{}", state.text);
  }
}

void fit_default_levels(Settings& settings, SourceInfo& source) {
  const int last = last_level_for(settings, source.size);
  if (last == settings.last_level) return;
  settings.last_level = last;
  source.notes.push_back(fmt::format("{}x{} images have room for levels 0..{} only, not for the default",
                                     source.size.width, source.size.height, last));
}

void fit_to_depth(Settings& settings, SourceInfo& source) {
  if (source.has_depth) return;
  if (needs_depth(settings.model))
    throw usage_error(
        fmt::format("model {} needs depth, and there is none", settings.model), source.uri,
        fmt::format("choose a model of the image with --model: {}", fmt::join(model_names(false), ", ")));
  if (settings.selector != Selector::proto) return;
  settings.selector = Selector::wta;
  source.notes.emplace_back("the selector proto needs depth; wta chooses the points");
}

std::optional<std::int64_t> expected_frames(const SourceInfo& source, const FrameSettings& settings) {
  if (source.frame_count) return selected_frames(settings, *source.frame_count);
  return settings.frames > 0 ? std::optional(settings.frames) : std::nullopt;
}

void make_output_folder(const fs::path& folder) {
  if (folder == "-")
    throw usage_error("the files of a run cannot go to standard output", "--out -", "name a folder");
  std::error_code code;
  fs::create_directories(folder, code);
  if (code || !fs::is_directory(folder, code))
    throw failed("cannot make the output folder" + (code ? ": " + code.message() : std::string()),
                 folder.string(), "choose a writable folder with --out");
}

}  // namespace saccade
