#include "app/export_command.hpp"

#include <memory>

#include <fmt/format.h>

#include "app/command.hpp"
#include "app/export.hpp"
#include "app/options.hpp"
#include "app/source_option.hpp"
#include "output/frame_exporter.hpp"

namespace saccade {
namespace {

std::string format_help() {
  std::string text = "what to write:";
  for (const ExportFormat& format : export_formats())
    text += fmt::format("{} {}: {}", &format == export_formats().data() ? "" : ";", format.name, format.help);
  return text + " [folder]";
}

}  // namespace

void add_export_command(CLI::App& app, std::function<void()>& action) {
  CLI::App& command =
      *app.add_subcommand("export", "write the frames of a source as PNG, TUM, PLY, PCD or lossless video");
  const auto arguments = std::make_shared<ExportArguments>();
  add_source_option(command, "SOURCE", arguments->source, "what to export; see the end of this help")
      ->required();
  command.add_option("--out", arguments->out, "folder to write to; made if it does not exist")
      ->required()
      ->type_name("DIR");
  command.add_option("--format", arguments->format, format_help())->type_name("NAME");
  command.add_flag("--force", arguments->force, "write into a folder that is not empty");
  const auto options = std::make_shared<SettingsOptions>(
      command, AcceptedSettings{{SettingScope::frames, SettingScope::sensor}, {"json", "quiet"}});
  command.callback([arguments, options, &action] {
    action = [arguments, options] {
      const Settings settings = options->resolve();
      set_log_level(settings);
      export_frames(*arguments, settings);
    };
  });
}

}  // namespace saccade
