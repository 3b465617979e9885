// The settings that a command accepts follow from their scopes.
#include "app/options.hpp"

#include <functional>
#include <set>

#include <gmock/gmock.h>

#include "app/bench_command.hpp"
#include "app/eval_command.hpp"
#include "app/export_command.hpp"
#include "app/record_command.hpp"
#include "app/run_command.hpp"
#include "app/view_command.hpp"
#include "core/error.hpp"
#include "tests/support/places.hpp"

namespace saccade {
namespace {

using ::testing::HasSubstr;
using Keys = std::set<std::string_view>;
using Scope = SettingScope;

struct Commands {
  Commands() {
    add_view_command(app, action);
    add_run_command(app, action, {});
    add_record_command(app, action);
    add_export_command(app, action);
    add_eval_command(app, action);
    add_bench_command(app, action);
  }
  CLI::App app;
  std::function<void()> action;
};

Keys keys_of(std::initializer_list<Scope> scopes, const Keys& also = {}, const Keys& except = {}) {
  Keys keys = also;
  for (const SettingSpec& spec : setting_specs())
    for (const Scope scope : scopes)
      if (spec.scope == scope && !except.contains(spec.key)) keys.insert(spec.key);
  return keys;
}

Keys accepted_by(const CLI::App& command) {
  Keys keys;
  for (const SettingSpec& spec : setting_specs()) {
    const CLI::Option* option = command.get_option("--" + std::string(spec.key));
    if (option->get_group().empty()) continue;  // hidden
    keys.insert(spec.key);
    EXPECT_EQ(option->get_group(), title(spec.scope)) << spec.key;
  }
  return keys;
}

TEST(Options, EachCommandAcceptsTheScopesThatItUses) {
  Commands commands;
  const auto accepted = [&](const char* name) { return accepted_by(*commands.app.get_subcommand(name)); };
  EXPECT_EQ(accepted("run"), keys_of({Scope::model, Scope::attention, Scope::tracking, Scope::frames,
                                      Scope::sensor, Scope::output, Scope::program}));
#ifdef SACCADE_HAS_VIEWER
  EXPECT_EQ(accepted("view"), keys_of({Scope::model, Scope::attention, Scope::tracking, Scope::frames,
                                       Scope::sensor, Scope::program}));
#endif
  EXPECT_EQ(accepted("record"),
            keys_of({Scope::sensor}, {"frames", "start", "every", "depth-unit", "topics", "json", "quiet"}));
  EXPECT_EQ(accepted("export"), keys_of({Scope::frames, Scope::sensor}, {"json", "quiet"}));
  EXPECT_EQ(accepted("bench"), keys_of({Scope::model, Scope::attention}, {"json", "workers"}));
  EXPECT_EQ(accepted("eval"),
            keys_of({Scope::model, Scope::attention, Scope::frames, Scope::program}, {"json"},
                    {"model", "kernel", "selector", "fixations", "min-confidence"}));
}

TEST(Options, ASettingThatACommandDoesNotAcceptIsAUsageError) {
  for (const auto& [line, option] : std::initializer_list<std::pair<const char*, const char*>>{
           {"bench --frames 5", "--frames"},
           {"bench --quiet", "--quiet"},
           {"bench --no-registration", "--registration"},
           {"record synthetic:ball x.oni --kernel 9", "--kernel"},
           {"eval synthetic:table --out x --mode 320x240@30", "--mode"}}) {
    Commands commands;
    commands.app.parse(line);
    try {
      commands.action();
      ADD_FAILURE() << line;
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::usage);
      EXPECT_THAT(error.what(), HasSubstr(std::string("does not accept this setting: ") + option));
    }
  }
}

TEST(Options, OfTheCommandLineOverrideTheFileWhereverTheyStand) {
  const std::string file = "--config " + in_source("config/paper.toml");
  for (const std::string& line : {"--kernel 9 " + file, file + " --kernel 9"}) {
    CLI::App app{"", "bench"};
    const SettingsOptions options(app, {{Scope::model}});
    app.parse(line);
    const Settings settings = options.resolve();
    EXPECT_EQ(settings.kernel, 9) << line;
    EXPECT_EQ(settings.length_scale, LengthScale::millimetre);
    EXPECT_EQ(settings.selector, Selector::wta) << "a file may hold what the command does not accept";
  }
}

}  // namespace
}  // namespace saccade
