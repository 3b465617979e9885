#include "app/record_command.hpp"

#include <map>
#include <memory>
#include <string>

#include "app/command.hpp"
#include "app/options.hpp"
#include "app/record.hpp"
#include "app/source_option.hpp"

namespace saccade {
namespace {

// An option with a value of the enumeration by name.
template <typename Enum>
void add_choice(CLI::App& command, const std::string& name, const char* type, Enum& value,
                const std::map<std::string, Enum>& choices, const std::string& help) {
  command.add_option(name, value, help)
      ->type_name(type)
      ->transform(CLI::CheckedTransformer(choices, CLI::ignore_case).description(""));
}

void add_file_options(CLI::App& command, OniWriterOptions& options) {
  add_choice<OniDepthCodec>(
      command, "--depth-codec", "CODEC", options.depth_codec,
      {{"16zT", OniDepthCodec::z16t}, {"16zP", OniDepthCodec::z16p}, {"none", OniDepthCodec::none}},
      "16zT (smallest), 16zP or none [16zT]");
  add_choice<OniColourCodec>(
      command, "--colour-codec", "CODEC", options.colour_codec,
      {{"jpeg", OniColourCodec::jpeg}, {"none", OniColourCodec::none}, {"off", OniColourCodec::off}},
      "jpeg (lossy), none (uncompressed) or off (no colour) [jpeg]");
  add_choice<OniDepthUnit>(
      command, "--stored-unit", "UNIT", options.depth_unit,
      {{"auto", OniDepthUnit::automatic}, {"1mm", OniDepthUnit::mm1}, {"100um", OniDepthUnit::um100}},
      "step of the stored depth: 1mm, 100um, or auto (100um if the first frame has fractions of 1 mm) "
      "[auto]");
  command.add_flag("--force", options.overwrite, "replace FILE if it exists");
}

}  // namespace

void add_record_command(CLI::App& app, std::function<void()>& action) {
  CLI::App& command = *app.add_subcommand("record", "record a source to an .oni file");
  const auto arguments = std::make_shared<RecordArguments>();
  add_source_option(command, "SOURCE", arguments->source, "what to record; see the end of this help")
      ->required();
  command.add_option("FILE", arguments->file, "the .oni file to write")->required();
  command.add_option("--duration", arguments->duration_s, "stop after S seconds; 0 = do not stop [0]")
      ->type_name("S")
      ->check(CLI::Range(0.0, 1e9));
  add_file_options(command, arguments->options);
  const auto options = std::make_shared<SettingsOptions>(
      command, AcceptedSettings{{SettingScope::sensor},
                                {"frames", "start", "every", "depth-unit", "topics", "json", "quiet"}});
  command.callback([arguments, options, &action] {
    action = [arguments, options] {
      const Settings settings = options->resolve();
      set_log_level(settings);
      record(*arguments, settings);
    };
  });
}

}  // namespace saccade
