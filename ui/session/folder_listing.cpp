#include "ui/session/folder_listing.hpp"

#include <algorithm>
#include <exception>
#include <filesystem>

#include "sources/open_source.hpp"
#include "sources/source_kind.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

bool is_folder(const fs::path& path) {
  std::error_code code;
  return fs::is_directory(path, code);
}

fs::path folder_of(const std::string& typed) {
  std::error_code code;
  fs::path folder = fs::absolute(typed.empty() ? "." : typed, code).lexically_normal();
  if (code) return "/";
  while (!is_folder(folder) && folder != folder.root_path()) folder = folder.parent_path();
  return folder.has_filename() || folder == folder.root_path() ? folder : folder.parent_path();
}

bool is_source(const fs::path& path) {
  try {
    return kind_of(SourceInput(path.string())) != nullptr;
  } catch (const std::exception&) {
    return false;  // it cannot be read, or its name is too long
  }
}

void add_entries(FolderContents& contents) {
  std::error_code code;
  fs::directory_iterator i(contents.folder, code);
  if (code) contents.error = "cannot list this folder: " + code.message();
  for (const fs::directory_iterator end; !code && i != end; i.increment(code)) {
    const std::string name = i->path().filename().string();
    if (name.starts_with('.')) continue;
    const bool folder = is_folder(i->path());
    if (!folder && !has_source_ending(i->path())) continue;
    if (contents.entries.size() == FolderContents::kMostEntries) {
      contents.more = true;
      break;
    }
    contents.entries.push_back({name, folder, !folder || is_source(i->path())});
  }
  std::ranges::sort(contents.entries, [](const auto& a, const auto& b) {
    return a.folder != b.folder ? a.folder : a.name < b.name;
  });
}

}  // namespace

FolderContents list_folder(const std::string& typed) {
  FolderContents contents;
  try {
    const fs::path folder = folder_of(typed);
    contents.folder = folder.string();
    if (folder != folder.root_path()) contents.parent = folder.parent_path().string();
    contents.source = is_source(folder);
    add_entries(contents);
  } catch (const std::exception& error) {
    contents.error = error.what();
  }
  return contents;
}

const FolderContents& FolderLister::poll(const std::string& typed) {
  constexpr std::chrono::seconds kPeriod{2};
  if (listing_.valid() && listing_.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
    contents_ = listing_.get();
  const auto now = std::chrono::steady_clock::now();
  if (listing_.valid() || (begun_ && typed == typed_ && now - begun_at_ < kPeriod)) return contents_;
  begun_ = true;
  begun_at_ = now;
  typed_ = typed;
  listing_ = std::async(std::launch::async, [typed, wake = wake_] {
    FolderContents contents = list_folder(typed);
    wake();
    return contents;
  });
  return contents_;
}

}  // namespace saccade
