#include "app/completion.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "app/manual.hpp"
#include "settings/settings.hpp"

namespace saccade {
namespace {

// What can stand where an option has its value.
enum class ValueKind { none, words, file, folder, other };
struct Value {
  ValueKind kind = ValueKind::other;
  std::vector<std::string> words{};
};

Value value_of(const CLI::Option& option) {
  if (option.get_items_expected_max() == 0) return {ValueKind::none};
  if (option.get_positional()) return {ValueKind::file};
  const std::string type = option.get_type_name();
  if (type.starts_with("FILE")) return {ValueKind::file};
  if (type.starts_with("DIR")) return {ValueKind::folder};
  const auto specs = setting_specs();
  const auto spec = std::ranges::find_if(
      specs, [&](const SettingSpec& s) { return option.check_lname(std::string(s.key)); });
  if (spec != specs.end() && !spec->words.empty()) return {ValueKind::words, spec->words};
  return {};
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    if (is_shown(*option))
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::vector<std::string> names_of(const std::vector<const CLI::App*>& commands) {
  std::vector<std::string> names;
  names.reserve(commands.size());
  for (const CLI::App* command : commands) names.push_back(command->get_name());
  return names;
}

// Every command, and for a command with commands of its own, such as oni, those as "oni info".
struct Entry {
  std::string path;
  const CLI::App* command;
};
std::vector<Entry> entries(const CLI::App& program) {
  std::vector<Entry> all;
  for (const CLI::App* command : commands_of(program)) {
    all.push_back({command->get_name(), command});
    for (const CLI::App* child : commands_of(*command))
      all.push_back({command->get_name() + " " + child->get_name(), child});
  }
  return all;
}

// The cases of one command: what follows each option with a value.
std::string bash_values(const Entry& entry) {
  std::string text;
  for (const CLI::Option* option : entry.command->get_options()) {
    if (!is_shown(*option) || option->get_positional() || option->get_lnames().empty()) continue;
    const Value value = value_of(*option);
    if (value.kind == ValueKind::none) continue;
    const char* complete = value.kind == ValueKind::file     ? "files=-f"
                           : value.kind == ValueKind::folder ? "files=-d"
                                                             : "words=";
    text += fmt::format("    '{} --{}') {}", entry.path, option->get_lnames().front(), complete);
    if (value.kind == ValueKind::words) text += fmt::format("'{}'", fmt::join(value.words, " "));
    text += " ;;\n";
  }
  return text;
}

// Of one command, what can stand where no option's value is expected: its commands, else a file or an option.
std::string bash_words(const Entry& entry) {
  const auto children = commands_of(*entry.command);
  const auto& words = children.empty() ? option_names(*entry.command) : names_of(children);
  return fmt::format("      '{}') words='{}' {};;\n", entry.path, fmt::join(words, " "),
                     children.empty() ? "; [[ $current == -* ]] || files=-f " : "");
}

// Help in a specification of zsh's _arguments within single quotes.
std::string zsh_text(const std::string& text) {
  std::string out;
  for (const char c : text.substr(0, text.find('\n'))) {
    if (c == '\'')
      out += "'\\''";
    else if (c == '[' || c == ']' || c == ':' || c == '\\')
      out += std::string("\\") + c;
    else
      out += c;
  }
  return out;
}

std::string zsh_value(const CLI::Option& option, const Value& value) {
  const std::string type = option.get_type_name();
  const std::string name =
      zsh_text(option.get_positional() ? option.get_name(true) : type.substr(0, type.find(':')));
  switch (value.kind) {
    case ValueKind::words:
      return fmt::format(":{}:({})", name, fmt::join(value.words, " "));
    case ValueKind::file:
      return fmt::format(":{}:_files", name);
    case ValueKind::folder:
      return fmt::format(":{}:_files -/", name);
    default:
      return fmt::format(":{}: ", name);
  }
}

std::string zsh_options(const CLI::App& command) {
  std::string text;
  int position = 0;
  for (const CLI::Option* option : command.get_options()) {
    if (!is_shown(*option)) continue;
    const Value value = value_of(*option);
    if (option->get_positional()) {
      text += fmt::format(" \\\n        '{}{}'", ++position, zsh_value(*option, value));
      continue;
    }
    for (const std::string& name : option->get_lnames()) {
      const bool takes_value = value.kind != ValueKind::none;
      text += fmt::format(" \\\n        '--{}{}[{}]{}'", name, takes_value ? "=" : "",
                          zsh_text(option->get_description()), takes_value ? zsh_value(*option, value) : "");
    }
  }
  return text;
}

std::string zsh_descriptions(const CLI::App& app) {
  std::string text;
  for (const CLI::App* command : commands_of(app))
    text += fmt::format(" '{}:{}'", command->get_name(), zsh_text(command->get_description()));
  return text;
}

// A function that completes the commands of `app`, and calls that of a command for what follows it.
std::string zsh_function(const std::string& name, const CLI::App& app) {
  const auto children = commands_of(app);
  if (children.empty()) return fmt::format("{}() {{\n  _arguments{}\n}}\n", name, zsh_options(app));
  std::string text;
  for (const CLI::App* child : children) text += zsh_function(name + "_" + child->get_name(), *child);
  return text + fmt::format(
                    "{0}() {{\n"
                    "  local line state\n"
                    "  local -a commands=({1})\n"
                    "  _arguments -C{2} \\\n"
                    "        '1: :->command' '*:: :->arguments'\n"
                    "  case $state in\n"
                    "    command) _describe command commands ;;\n"
                    "    arguments) (( $+functions[{0}_$line[1]] )) && {0}_$line[1] ;;\n"
                    "  esac\n"
                    "}}\n",
                    name, zsh_descriptions(app), zsh_options(app));
}

}  // namespace

std::string bash_completion(const CLI::App& program) {
  std::string values, words;
  std::vector<std::string> with_commands;
  for (const Entry& entry : entries(program)) {
    values += bash_values(entry);
    words += bash_words(entry);
    if (!commands_of(*entry.command).empty()) with_commands.push_back(entry.path);
  }
  return fmt::format(R"(# bash completion of saccade, made from its own tables of options.
_saccade() {{
  local current=$2 command=${{COMP_WORDS[1]}} words= files=
  ((COMP_CWORD > 1)) || command=
  [[ $command == @({0}) ]] && ((COMP_CWORD > 2)) && command+=" ${{COMP_WORDS[2]}}"
  case "$command $3" in
{1}    *) case $command in
      '') words='{2} {3}' ;;
{4}      esac ;;
  esac
  if [[ -n $files ]]; then
    local IFS=$'\n'
    COMPREPLY=($(compgen $files -- "$current"))
  else
    COMPREPLY=($(compgen -W "$words" -- "$current"))
  fi
}}
complete -o filenames -F _saccade saccade
)",
                     fmt::join(with_commands, "|"), values, fmt::join(names_of(commands_of(program)), " "),
                     fmt::join(option_names(program), " "), words);
}

std::string zsh_completion(const CLI::App& program) {
  return "#compdef saccade\n# zsh completion of saccade, made from its own tables of options.\n" +
         zsh_function("_saccade", program) + "_saccade \"$@\"\n";
}

}  // namespace saccade
