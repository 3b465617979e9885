#include "drivers/openni2/openni2_installation.hpp"

#include <dlfcn.h>

#include <algorithm>

#include <OpenNI.h>
#include <fmt/format.h>

#include "core/outcome.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kPrefix = "lib", kSuffix = ".so.0";  // as OpenNI2 looks for them

// Whether a module can be loaded.
Outcome try_to_load(const fs::path& module) {
  void* handle = ::dlopen(module.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) return Outcome::failure(::dlerror());
  const bool is_driver = ::dlsym(handle, "oniDriverCreate") != nullptr;
  ::dlclose(handle);
  return is_driver ? Outcome::success() : Outcome::failure("it is not a driver module");
}

}  // namespace

OpenNi2Installation find_openni2() {
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
  found.driver_folder = found.library.parent_path() / "OpenNI2" / "Drivers";
  std::error_code code;
  for (const auto& entry : fs::directory_iterator(found.driver_folder, code)) {
    const std::string file = entry.path().filename().string();
    if (!file.starts_with(kPrefix) || !file.ends_with(kSuffix)) continue;
    found.modules.push_back({file.substr(kPrefix.size(), file.size() - kPrefix.size() - kSuffix.size()),
                             entry.path(), try_to_load(entry.path()).reason()});
  }
  std::sort(found.modules.begin(), found.modules.end(),
            [](const auto& a, const auto& b) { return a.name < b.name; });
  return found;
}

}  // namespace saccade
