#include "tests/house/layering.hpp"

#include <algorithm>
#include <fstream>
#include <functional>
#include <map>
#include <regex>
#include <set>

namespace saccade {
namespace fs = std::filesystem;
namespace {

std::string resolve(const fs::path& root, const std::string& named) {
  return !fs::exists(root / "src" / named) && fs::exists(root / named) ? named : "src/" + named;
}

void add_includes(const fs::path& root, const fs::path& file, std::vector<Include>& includes) {
  static const std::regex pattern("\\s*#\\s*include\\s*\"([^\"]+)\".*");
  std::ifstream text(file);
  std::smatch match;
  int number = 0;
  for (std::string line; std::getline(text, line);) {
    ++number;
    if (std::regex_match(line, match, pattern))
      includes.push_back({fs::relative(file, root).string(), number, resolve(root, match[1])});
  }
}

// 0 = the ground floor; -1 = no room.
int floor_of(const std::string& room, const Floors& floors) {
  for (std::size_t i = 0; i < floors.size(); ++i)
    if (std::ranges::count(floors[i], room) > 0) return static_cast<int>(i);
  return -1;
}

}  // namespace

std::vector<Include> find_includes(const fs::path& root) {
  std::vector<Include> includes;
  for (const char* top : {"src", "drivers", "ui"}) {
    if (!fs::exists(root / top)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / top))
      if (entry.path().extension() == ".hpp" || entry.path().extension() == ".cpp")
        add_includes(root, entry.path(), includes);
  }
  std::ranges::sort(includes, {}, [](const Include& i) { return std::tie(i.from, i.line); });
  return includes;
}

std::string room_of(const std::string& file, const Floors& floors) {
  const std::string folder = fs::path(file).parent_path().string();
  return floor_of(folder, floors) < 0 ? "" : folder;
}

std::vector<std::string> find_upward(const std::vector<Include>& includes, const Floors& floors) {
  std::vector<std::string> lines;
  for (const Include& include : includes) {
    const std::string from = room_of(include.from, floors), to = room_of(include.to, floors);
    const std::string line = include.from + ":" + std::to_string(include.line) + " includes " + include.to;
    if (from.empty() || to.empty())
      lines.push_back(line + ": " + (from.empty() ? include.from : include.to) + " is in none of the rooms");
    else if (from != to && floor_of(from, floors) <= floor_of(to, floors))
      lines.push_back(line + ": " + to + " is not below " + from);
  }
  return lines;
}

std::vector<std::string> find_circles(const std::vector<Include>& includes) {
  std::map<std::string, std::set<std::string>> graph;
  for (const Include& include : includes) graph[include.from].insert(include.to);
  std::vector<std::string> circles, path;
  std::set<std::string> done;
  const std::function<void(const std::string&)> visit = [&](const std::string& file) {
    const auto begin = std::ranges::find(path, file);
    if (begin != path.end()) {
      std::string circle;
      for (auto step = begin; step != path.end(); ++step) circle += *step + " -> ";
      circles.push_back(circle + file);
      return;
    }
    if (!done.insert(file).second) return;
    path.push_back(file);
    if (const auto targets = graph.find(file); targets != graph.end())
      for (const std::string& target : targets->second) visit(target);
    path.pop_back();
  };
  for (const auto& [file, targets] : graph) visit(file);
  return circles;
}

}  // namespace saccade
