#include "tests/house/run_path.hpp"

#include <elf.h>

#include <cstring>
#include <fstream>
#include <span>
#include <stdexcept>

#include "core/file.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

using Bytes = std::span<const std::uint8_t>;

template <typename T>
T at(Bytes bytes, std::uint64_t offset) {
  if (offset > bytes.size() || bytes.size() - offset < sizeof(T)) throw std::runtime_error("the file is cut");
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof(T));
  return value;
}

std::vector<Elf64_Phdr> program_headers(Bytes elf) {
  const auto header = at<Elf64_Ehdr>(elf, 0);
  std::vector<Elf64_Phdr> headers;
  for (std::uint64_t i = 0; i < header.e_phnum; ++i)
    headers.push_back(at<Elf64_Phdr>(elf, header.e_phoff + i * header.e_phentsize));
  return headers;
}

// Where in the file the byte is that is loaded to `address`.
std::uint64_t offset_of(std::uint64_t address, std::span<const Elf64_Phdr> headers) {
  for (const Elf64_Phdr& header : headers)
    if (header.p_type == PT_LOAD && address >= header.p_vaddr && address - header.p_vaddr < header.p_filesz)
      return address - header.p_vaddr + header.p_offset;
  throw std::runtime_error("an address is outside of the file");
}

std::vector<Elf64_Dyn> dynamic_entries(Bytes elf, std::span<const Elf64_Phdr> headers) {
  std::vector<Elf64_Dyn> entries;
  for (const Elf64_Phdr& header : headers)
    if (header.p_type == PT_DYNAMIC)
      for (std::uint64_t i = 0; (i + 1) * sizeof(Elf64_Dyn) <= header.p_filesz; ++i)
        entries.push_back(at<Elf64_Dyn>(elf, header.p_offset + i * sizeof(Elf64_Dyn)));
  return entries;
}

std::string text_at(Bytes elf, std::uint64_t offset) {
  std::string text;
  for (char c; (c = at<char>(elf, offset)) != '\0'; ++offset) text += c;
  return text;
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts(1);
  for (const char c : text)
    if (c == ':')
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

bool is_binary(const fs::path& file) {
  Elf64_Ehdr header{};
  std::ifstream(file, std::ios::binary).read(reinterpret_cast<char*>(&header), sizeof header);
  return std::memcmp(header.e_ident, ELFMAG, SELFMAG) == 0 && header.e_ident[EI_CLASS] == ELFCLASS64 &&
         (header.e_type == ET_EXEC || header.e_type == ET_DYN);
}

}  // namespace

std::vector<std::string> run_path(const fs::path& file) {
  const auto bytes = read_file(file);
  const auto headers = program_headers(bytes);
  const auto dynamic = dynamic_entries(bytes, headers);
  std::uint64_t strings = 0;
  for (const Elf64_Dyn& entry : dynamic)
    if (entry.d_tag == DT_STRTAB) strings = offset_of(entry.d_un.d_ptr, headers);
  std::vector<std::string> entries;
  for (const Elf64_Dyn& entry : dynamic) {
    if (entry.d_tag != DT_RUNPATH && entry.d_tag != DT_RPATH) continue;
    const auto parts = split(text_at(bytes, strings + entry.d_un.d_val));
    entries.insert(entries.end(), parts.begin(), parts.end());
  }
  return entries;
}

bool is_fixed(const std::string& entry) {
  return entry.starts_with('/') || entry == "$ORIGIN" || entry.starts_with("$ORIGIN/");
}

std::vector<fs::path> find_binaries(const fs::path& folder) {
  std::vector<fs::path> binaries;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (!entry.is_symlink() && entry.is_regular_file() && is_binary(entry.path()))
      binaries.push_back(entry.path());
  return binaries;
}

}  // namespace saccade
