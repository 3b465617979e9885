#include "drivers/openni2/openni2_installation.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include <OpenNI.h>
#include <fmt/format.h>

#include "drivers/openni2/module_file.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kSuffix = ".so.0";  // of the modules that OpenNI2 loads

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

// The value of Repository in the section [Drivers]; empty = there is none.
std::string repository_in(const fs::path& ini) {
  std::ifstream file(ini);
  std::string section, repository;
  for (std::string line; std::getline(file, line);) {
    line = trimmed(line);
    if (line.starts_with('['))
      section = line;
    else if (const auto equals = line.find('='); section == "[Drivers]" && equals != std::string::npos)
      if (trimmed(line.substr(0, equals)) == "Repository") repository = trimmed(line.substr(equals + 1));
  }
  return repository;
}

OpenNi2Installation::Module examine_module(const std::string& name, const fs::path& file, bool named) {
  OpenNi2Installation::Module module{.name = name, .path = file, .named = named};
  if (const auto trouble = trouble_with_module(file)) {
    module.problem = trouble->problem;
    module.remedy = trouble->remedy;
  }
  return module;
}

void find_modules(OpenNi2Installation& found) {
  std::error_code code;
  for (const auto& entry : fs::directory_iterator(found.driver_folder, code)) {
    const std::string file = entry.path().filename().string(), name = module_name(entry.path());
    if (!name.empty() && file.ends_with(kSuffix))
      found.modules.push_back(examine_module(name, entry.path(), false));
  }
  std::ranges::sort(found.modules, {}, &OpenNi2Installation::Module::name);
  for (const fs::path& file : named_modules(std::getenv(kModulesVariable))) {
    const std::string name = module_name(file);
    found.modules.push_back(examine_module(name.empty() ? file.filename().string() : name, file, true));
  }
}

}  // namespace

OpenNi2Installation find_openni2(const fs::path& root) {
  OpenNi2Installation found;
#ifdef SACCADE_NO_FREENECT
  found.left_out = {"SaccadeFreenect"};
#endif
  const openni::Version version = openni::OpenNI::getVersion();
  found.version =
      fmt::format("{}.{}.{}.{}", version.major, version.minor, version.maintenance, version.build);
  Dl_info info{};
  if (::dladdr(::dlsym(RTLD_DEFAULT, "oniGetVersion"), &info) == 0 || info.dli_fname == nullptr) return found;
  found.library = fs::absolute(info.dli_fname);
  const fs::path ini = root / "etc" / "openni2" / "OpenNI.ini";
  const std::string repository = repository_in(ini);
  if (!repository.empty()) found.redirected_by = ini;
  found.driver_folder = found.library.parent_path() / (repository.empty() ? "OpenNI2/Drivers" : repository);
  find_modules(found);
  return found;
}

}  // namespace saccade
