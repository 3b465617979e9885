#include "eval/result_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <set>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/image_size.hpp"
#include "eval/hit_ratio.hpp"
#include "output/json_text.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uintmax_t kLargestFile = std::uintmax_t{8} << 30;
constexpr double kMostFrames = 1e15;  // of a source, so that doubles hold them exactly
constexpr int kMostLabel = 65535;

Json condition_json(const ConditionResult& condition) {
  Json points = Json::array();
  for (const EvalPoint& p : condition.points) {
    Json point = {p.row, p.col, p.label};
    if (p.confidence) point.push_back(*p.confidence);
    points.push_back(std::move(point));
  }
  return {{"points", points}, {"map_ms", condition.map_ms}, {"select_ms", condition.select_ms}};
}

// The number in `json`, which may be somebody else's. Throws std::runtime_error unless it is in low..high.
double number_from(const Json& json, double low, double high, std::string_view what) {
  const double value = json.is_number() ? json.get<double>() : std::nan("");
  if (!(value >= low && value <= high))
    throw std::runtime_error(fmt::format("{} is not a number from {} to {}", what, low, high));
  return value;
}

std::int64_t integer_from(const Json& json, double low, double high, std::string_view what) {
  if (!json.is_number_integer()) throw std::runtime_error(fmt::format("{} is not an integer", what));
  return static_cast<std::int64_t>(number_from(json, low, high, what));
}

double ms_from(const Json& json, std::string_view what) { return number_from(json, 0, 1e9, what); }

EvalPoint point_from(const Json& json) {
  const auto field = [&](std::size_t i, int low, int high, const char* what) {
    return static_cast<int>(integer_from(json.at(i), low, high, what));
  };
  EvalPoint point{field(0, 0, kLargestSide - 1, "row"), field(1, 0, kLargestSide - 1, "column"),
                  field(2, kVoid, kMostLabel, "label")};
  if (json.size() > 3) point.confidence = static_cast<float>(number_from(json[3], 0, 1, "confidence"));
  return point;
}

ConditionResult condition_from(const Json& json, const EvalPlan& plan) {
  ConditionResult condition{
      {}, ms_from(json.at("map_ms"), "map_ms"), ms_from(json.at("select_ms"), "select_ms")};
  const Json& points = json.at("points");
  if (points.size() > static_cast<std::size_t>(plan.points) * kVoidReserve)
    throw std::runtime_error("too many points");
  for (const auto& point : points) condition.points.push_back(point_from(point));
  return condition;
}

// The expected Hit Ratios of a baseline.
std::vector<double> ratios_from(const Json& json, std::string_view what) {
  if (!json.is_array() || json.size() > kMostPoints)
    throw std::runtime_error(fmt::format("{} is not a list of ratios", what));
  std::vector<double> ratios;
  for (const auto& value : json) ratios.push_back(number_from(value, 0, 1, what));
  return ratios;
}

ImageResult image_from(const Json& json, const EvalPlan& plan) {
  ImageResult image;
  image.frame = integer_from(json.at("frame"), 0, kMostFrames, "frame");
  image.name = json.at("name");
  if (json.contains("left_out")) {
    image.left_out = json.at("left_out").get<std::string>();
    return image;
  }
  image.objects = static_cast<int>(integer_from(json.at("objects"), 0, kMostLabel, "objects"));
  image.void_known = json.at("void_known");
  image.random = ratios_from(json.at("random"), "random");
  image.centre = ratios_from(json.at("centre"), "centre");
  for (const auto& condition : json.at("conditions"))
    image.conditions.push_back(condition_from(condition, plan));
  const auto points = static_cast<std::size_t>(plan.points);
  if (image.random.size() != points || image.centre.size() != points ||
      image.conditions.size() != plan.conditions().size())
    throw std::runtime_error("not the numbers of points and conditions of the first line");
  return image;
}

struct Lines {
  std::vector<std::string_view> complete;
  std::uintmax_t complete_bytes = 0;  // up to the last line feed
};

Lines split_lines(std::string_view text) {
  Lines lines;
  for (std::size_t end; (end = text.find('\n', lines.complete_bytes)) != std::string_view::npos;) {
    lines.complete.push_back(text.substr(lines.complete_bytes, end - lines.complete_bytes));
    lines.complete_bytes = end + 1;
  }
  return lines;
}

StoredResults parse_results(const Lines& lines, const fs::path& path) {
  StoredResults results;
  std::set<std::int64_t> frames;
  std::size_t number = 1;
  const auto not_results = [&](const std::string& reason) {
    return unreadable("not the results of an evaluation: " + reason,
                      fmt::format("{}:{}", path.string(), number), "remove it to start again");
  };
  try {
    if (lines.complete.empty()) throw std::runtime_error("no line with the parameters");
    for (const std::string_view line : lines.complete) {
      const Json json = Json::parse(line);
      if (number == 1) {
        results.plan = plan_from_json(json);
      } else if (json.contains("end")) {
        results.complete = true;
      } else {
        const ImageResult& image = results.images.emplace_back(image_from(json, results.plan));
        if (!frames.insert(image.frame).second)
          throw std::runtime_error(fmt::format("frame {} is there twice", image.frame));
      }
      ++number;
    }
  } catch (const Json::exception&) {  // whose text is not for users
    throw not_results("not JSON, or a field is missing or of another kind");
  } catch (const std::exception& error) {
    throw not_results(error.what());
  }
  return results;
}

// "kernels is [15], not [10]" for the first difference of two plans; none if they are the same.
std::optional<std::string> difference(const Json& stored, const Json& wanted) {
  for (const auto& [key, value] : wanted.items()) {
    const auto other = stored.find(key);
    if (other == stored.end()) return fmt::format("{} is missing", key);
    if (*other == value) continue;
    if (value.is_object()) return difference(*other, value);
    return fmt::format("{} is {}, not {}", key, dump(*other), dump(value));
  }
  return std::nullopt;
}

std::string read_text(const fs::path& path) {
  const auto bytes = read_file(path, kLargestFile);
  return {bytes.begin(), bytes.end()};
}

void sort_by_frame(std::vector<ImageResult>& images) {
  std::sort(images.begin(), images.end(), [](const auto& a, const auto& b) { return a.frame < b.frame; });
}

}  // namespace

std::string plan_line(const EvalPlan& plan) { return dump(plan_json(plan)); }

std::string image_line(const ImageResult& image) {
  Json json = {{"frame", image.frame}, {"name", image.name}};
  if (image.left_out) {
    json["left_out"] = *image.left_out;
  } else {
    json["objects"] = image.objects;
    json["void_known"] = image.void_known;
    json["random"] = image.random;
    json["centre"] = image.centre;
    json["conditions"] = Json::array();
    for (const ConditionResult& condition : image.conditions)
      json["conditions"].push_back(condition_json(condition));
  }
  return dump(json);
}

std::string end_line() { return Json({{"end", true}}).dump(); }

StoredResults read_results(const fs::path& folder) {
  const fs::path path = folder / kResultFile;
  const std::string text = read_text(path);
  return parse_results(split_lines(text), path);
}

StoredResults resume_results(const fs::path& folder, const EvalPlan& plan) {
  const fs::path path = folder / kResultFile;
  std::string text;
  std::error_code code;
  if (fs::is_symlink(path, code)) throw failed("it is a symbolic link", path.string(), "delete it");
  if (fs::exists(path, code)) text = read_text(path);
  const Lines lines = split_lines(text);
  if (lines.complete.empty()) {
    LineFile(path).append(plan_line(plan));
    return {plan, {}, false};
  }
  StoredResults results = parse_results(lines, path);
  if (const auto other = difference(plan_json(results.plan), plan_json(plan)))
    throw usage_error("there are results of another evaluation: " + *other, path.string(),
                      "choose another --out, or remove the file");
  if (lines.complete_bytes < text.size()) fs::resize_file(path, lines.complete_bytes);
  return results;
}

StoredResults merge_results(const std::vector<fs::path>& folders) {
  if (folders.empty()) throw std::invalid_argument("merge_results: no folders");
  StoredResults merged;
  std::set<int> seen;
  for (const fs::path& folder : folders) {
    StoredResults part = read_results(folder);
    const int shard = part.plan.shard;
    if (!part.complete)
      throw usage_error(fmt::format("shard {}/{} is not complete", shard, part.plan.shards), folder.string(),
                        "repeat its command: it continues from there");
    if (!seen.insert(shard).second)
      throw usage_error(fmt::format("shard {}/{} is given twice", shard, part.plan.shards), folder.string(),
                        "name each shard's folder once");
    part.plan.shard = 1;
    if (seen.size() == 1) merged.plan = part.plan;
    if (const auto other = difference(plan_json(merged.plan), plan_json(part.plan)))
      throw usage_error("the shards are of different evaluations: " + *other, folder.string(),
                        "merge shards of one evaluation only");
    std::move(part.images.begin(), part.images.end(), std::back_inserter(merged.images));
  }
  for (int shard = 1; shard <= merged.plan.shards; ++shard)
    if (!seen.contains(shard))
      throw usage_error(fmt::format("shard {}/{} is missing", shard, merged.plan.shards),
                        folders.front().string(), "name the folders of all shards");
  merged.plan.shards = 1;
  merged.complete = true;
  sort_by_frame(merged.images);
  return merged;
}

void write_results(const fs::path& folder, const StoredResults& results) {
  std::string text = plan_line(results.plan) + "\n";
  for (const ImageResult& image : results.images) text += image_line(image) + "\n";
  write_file(folder / kResultFile, text + end_line() + "\n");
}

}  // namespace saccade
