#include "app/version_option.hpp"

#include <memory>

#include <nlohmann/json.hpp>

#include "app/build_info.hpp"
#include "app/run_report.hpp"
#include "app/standard_output.hpp"
#include "core/version.hpp"
#include "eval/evaluation_format.hpp"
#include "output/fixations_json.hpp"
#include "settings/settings_format.hpp"

namespace saccade {

nlohmann::ordered_json version_info() {
  nlohmann::ordered_json libraries = nlohmann::ordered_json::object(), parts = libraries;
  for (const auto& [name, version] : kLibraries)
    if (!version.empty()) libraries[std::string(name)] = version;
  for (const auto& [name, built] : kParts) parts[std::string(name)] = built;
  return {{"program", "saccade"},
          {"version", kVersion},
          {"formats",
           {{"settings", kSettingsFormat},
            {"manifest", kManifestFormat},
            {"fixations", kFixationsFormat},
            {"evaluation", kEvaluationFormat}}},
          {"compiler", kCompiler},
          {"build_type", kBuildType},
          {"parts", parts},
          {"libraries", libraries}};
}

void add_version_option(CLI::App& app, std::function<void()>& action) {
  const auto json = std::make_shared<bool>(false);
  CLI::Option* version = app.add_flag_callback(
      "--version",
      [json, &action] {
        action = [json] {
          if (*json)
            print_json(version_info(), 2);
          else
            print_text(std::string("saccade ") + kVersion + "\n", Reader::may_leave);
        };
      },
      "print the version and quit");
  app.add_flag("--json", *json, "with --version: also formats and libraries of the build, as JSON")
      ->needs(version);
}

}  // namespace saccade
