#include "drivers/openni2/module_file.hpp"

#include <dlfcn.h>
#include <elf.h>
#include <sys/utsname.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <set>

#include <fmt/format.h>

#include "drivers/openni2/driver_functions.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

// The architecture of an ELF file, as uname -m names it.
std::string architecture_of(const Elf64_Ehdr& header) {
  const bool is_64 = header.e_ident[EI_CLASS] == ELFCLASS64;
  switch (header.e_machine) {
    case EM_X86_64:
      return is_64 ? "x86_64" : "x32";
    case EM_386:
      return "i686";
    case EM_AARCH64:
      return "aarch64";
    case EM_ARM:
      return "armv7l";
    case EM_RISCV:
      return is_64 ? "riscv64" : "riscv32";
    default:
      return fmt::format("ELF machine {}", header.e_machine);
  }
}

std::string architecture_of_this_machine() {
  utsname name{};
  return ::uname(&name) == 0 ? name.machine : "";
}

// What can be seen without loading it.
std::optional<ModuleTrouble> trouble_with_format(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    return ModuleTrouble{"the file cannot be read", fmt::format("check the path: ls -l {}", file.string())};
  Elf64_Ehdr header{};  // e_machine has the same place in files of 32 bits
  stream.read(reinterpret_cast<char*>(&header), sizeof header);
  if (stream.gcount() < static_cast<std::streamsize>(sizeof(Elf32_Ehdr)) ||
      std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0)
    return ModuleTrouble{"it is not a shared library of Linux",
                         "name the maker's file lib*.so for Linux, not an archive or a text file"};
  const std::string its = architecture_of(header), ours = architecture_of_this_machine();
  if (its != ours && !ours.empty())
    return ModuleTrouble{fmt::format("it is built for {}, and this machine is {}", its, ours),
                         fmt::format("get the maker's module for {}", ours)};
  return std::nullopt;
}

// What the loader says, which begins with the name of the file or of the missing library.
ModuleTrouble explain(const std::string& complaint, const fs::path& file) {
  const std::string ldd = fmt::format("ldd -r {} shows all", file.string());
  if (const auto at = complaint.find(": cannot open shared object file"); at != std::string::npos)
    return {fmt::format("the library {} that it needs is missing", complaint.substr(0, at)),
            "install that library, or add its folder to LD_LIBRARY_PATH; " + ldd};
  constexpr std::string_view kUndefined = "undefined symbol: ";
  if (const auto at = complaint.find(kUndefined); at != std::string::npos)
    return {
        fmt::format("it needs {}, which none of its libraries has", complaint.substr(at + kUndefined.size())),
        "its libraries here are of another version than the maker's: use those that came with it; " + ldd};
  if (complaint.find("version `") != std::string::npos)
    return {fmt::format("it is built for a newer system ({})", complaint),
            "get a module that is built for this system; " + ldd};
  return {complaint, ldd};
}

}  // namespace

std::optional<ModuleTrouble> trouble_with_module(const fs::path& file) {
  if (auto trouble = trouble_with_format(file)) return trouble;
  void* handle = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) return explain(::dlerror(), file);
  const std::vector<std::string> missing = missing_driver_functions(handle);
  ::dlclose(handle);
  if (missing.empty()) return std::nullopt;
  return ModuleTrouble{
      fmt::format("it is not an OpenNI2 driver module: it lacks {}{}", missing.front(),
                  missing.size() > 1 ? fmt::format(" and {} more functions", missing.size() - 1) : ""),
      "name the maker's driver for OpenNI 2, not another of its libraries"};
}

std::string module_name(const fs::path& file) {
  constexpr std::string_view kPrefix = "lib", kEnding = ".so";
  const std::string name = file.filename().string();
  const auto end = name.find(kEnding);
  if (!name.starts_with(kPrefix) || end == std::string::npos || end <= kPrefix.size()) return "";
  const std::string version = name.substr(end + kEnding.size());
  if (version.find_first_not_of(".0123456789") != std::string::npos) return "";
  return name.substr(kPrefix.size(), end - kPrefix.size());
}

std::vector<fs::path> named_modules(const char* variable) {
  std::vector<fs::path> files;
  std::set<fs::path> known;
  const auto add = [&](const fs::path& file) {
    std::error_code code;
    const fs::path real = fs::canonical(file, code);
    if (known.insert(code ? file : real).second) files.push_back(file);
  };
  std::string_view rest = variable == nullptr ? "" : variable;
  while (!rest.empty()) {
    const auto colon = std::min(rest.find(':'), rest.size());
    const fs::path path = rest.substr(0, colon);
    rest.remove_prefix(std::min(colon + 1, rest.size()));
    if (path.empty()) continue;
    std::error_code code;
    if (!fs::is_directory(path, code)) {
      add(fs::absolute(path));
      continue;
    }
    std::vector<fs::path> entries;
    for (const auto& entry : fs::directory_iterator(path, code))
      if (!module_name(entry.path()).empty()) entries.push_back(fs::absolute(entry.path()));
    std::ranges::sort(entries);
    std::ranges::for_each(entries, add);
  }
  return files;
}

}  // namespace saccade
