#include "app/manual.hpp"

#include <algorithm>
#include <cctype>
#include <vector>

#include <fmt/format.h>

#include "core/version.hpp"

namespace saccade {
namespace {

// Text that roff prints as it is.
std::string roff(const std::string& text) {
  std::string out;
  bool line_begins = true;
  for (const char c : text) {
    if (line_begins && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
    line_begins = c == '\n';
  }
  return out;
}

// The help of an option: a paragraph, and its table, if it has one, as it is.
std::string help_text(const std::string& help) {
  const std::size_t line = help.find('\n');
  if (line == std::string::npos) return roff(help) + "\n";
  return roff(help.substr(0, line)) + "\n.PP\n.RS\n.nf\n" + roff(help.substr(line + 1)) + "\n.fi\n.RE\n";
}

std::string names(const CLI::Option& option) {
  std::vector<std::string> all;
  for (const std::string& name : option.get_snames()) all.push_back("\\fB" + roff("-" + name) + "\\fR");
  for (const std::string& name : option.get_lnames()) all.push_back("\\fB" + roff("--" + name) + "\\fR");
  std::string text = fmt::format("{}", fmt::join(all, ", "));
  if (option.get_items_expected_max() > 0)
    text += " \\fI" + roff(option.get_type_name().substr(0, option.get_type_name().find(':'))) + "\\fR";
  return text;
}

std::string positionals(const CLI::App& command) {
  std::string text;
  for (const CLI::Option* option : command.get_options())
    if (option->get_positional() && is_shown(*option)) {
      const std::string name = "\\fI" + roff(option->get_name(true)) + "\\fR";
      text += option->get_required() ? " " + name : " [" + name + "]";
    }
  return text;
}

std::string full_name(const CLI::App& program, const CLI::App& command) {
  std::string name = command.get_name();
  for (const CLI::App* app = &command; app != &program && app->get_parent() != nullptr;) {
    app = app->get_parent();
    name.insert(0, app->get_name() + " ");
  }
  return name;
}

std::string synopsis(const CLI::App& program, const CLI::App& command) {
  std::string text = "\\fB" + roff(full_name(program, command)) + "\\fR";
  if (!commands_of(command).empty()) return text + " \\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n";
  for (const CLI::Option* option : command.get_options())
    if (option->get_required() && !option->get_positional()) text += " " + names(*option);
  return text + " [\\fIOPTIONS\\fR]" + positionals(command) + "\n";
}

// Arguments and options of a command, group by group in their order.
std::string options_of(const CLI::App& command) {
  std::vector<std::string> groups;
  for (const CLI::Option* option : command.get_options())
    if (is_shown(*option) && std::ranges::count(groups, option->get_group()) == 0)
      groups.push_back(option->get_group());
  std::string text;
  for (const std::string& group : groups) {
    text += ".SS " + roff(group) + "\n";
    for (const CLI::Option* option : command.get_options()) {
      if (!is_shown(*option) || option->get_group() != group) continue;
      text += ".TP\n" +
              (option->get_positional() ? "\\fI" + roff(option->get_name(true)) + "\\fR" : names(*option)) +
              "\n" + help_text(option->get_description());
    }
  }
  return text;
}

std::string commands_section(const CLI::App& program, const CLI::App& command) {
  std::string text;
  for (const CLI::App* child : commands_of(command)) {
    if (&command == &program) {
      text += fmt::format(".TP\n\\fB{}\\fR\n{}; see \\fB{}\\fR(1)\n", roff(child->get_name()),
                          roff(child->get_description()), roff(man_page_name(program, *child)));
    } else {
      text += ".SS \"" + roff(child->get_name()) + "\"\n" + roff(child->get_description()) + "\n.PP\n" +
              synopsis(program, *child) + options_of(*child);
    }
  }
  return text.empty() ? text : ".SH COMMANDS\n" + text;
}

// "Sources:" and its table at the end of the help.
std::string footer_section(const CLI::App& command) {
  const std::string footer = command.get_footer();
  const std::size_t title = footer.find(":\n");
  if (title == std::string::npos) return "";
  std::string heading = footer.substr(footer.find_first_not_of('\n'), title);
  std::ranges::transform(heading, heading.begin(), [](unsigned char c) { return std::toupper(c); });
  return ".SH " + heading + "\n.nf\n" + roff(footer.substr(title + 2)) + "\n.fi\n";
}

std::string see_also(const CLI::App& program, const CLI::App& command) {
  if (&command != &program) return ".SH SEE ALSO\n\\fBsaccade\\fR(1)\n";
  std::vector<std::string> pages;
  for (const CLI::App* child : commands_of(program))
    pages.push_back("\\fB" + roff(man_page_name(program, *child)) + "\\fR(1)");
  return fmt::format(".SH SEE ALSO\n{}\n", fmt::join(pages, ",\n"));
}

constexpr const char* kExitStatus =
    ".SH EXIT STATUS\n"
    ".TP\n0\ndone\n"
    ".TP\n1\nfailed while running: disk full, sensor lost\n"
    ".TP\n2\nthe command line or the configuration is wrong\n"
    ".TP\n3\nthe input cannot be read\n"
    ".PP\nEvery error is one line on standard error: what failed, on what, what to try.\n";

}  // namespace

bool is_shown(const CLI::Option& option) { return !option.get_group().empty(); }

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

std::string man_page_name(const CLI::App& program, const CLI::App& command) {
  return &program == &command ? program.get_name() : program.get_name() + "-" + command.get_name();
}

std::string man_page(const CLI::App& program, const CLI::App& command) {
  std::string what = command.get_description();
  if (what.starts_with("Saccade: ")) what.erase(0, what.find(' ') + 1);  // the page begins with the name
  const std::string name = man_page_name(program, command);
  std::string title = name;
  std::ranges::transform(title, title.begin(), [](unsigned char c) { return std::toupper(c); });
  return fmt::format(".TH {} 1 \"\" \"Saccade {}\" \"User Commands\"\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n{}",
                     roff(title), kVersion, roff(name), roff(what), synopsis(program, command)) +
         ".SH OPTIONS\n" + options_of(command) + commands_section(program, command) +
         footer_section(command) + kExitStatus + see_also(program, command);
}

}  // namespace saccade
