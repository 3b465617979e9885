#include "app/source_option.hpp"

#include "sources/open_source.hpp"

namespace saccade {

CLI::Option* add_source_option(CLI::App& command, const std::string& name, std::string& value,
                               const std::string& help) {
  command.footer(source_help());
  return command.add_option(name, value, help);
}

}  // namespace saccade
