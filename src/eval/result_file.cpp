#include "eval/result_file.hpp"

#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/frame.hpp"
#include "core/image_size.hpp"
#include "core/line_reader.hpp"
#include "eval/hit_ratio.hpp"
#include "output/json_text.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

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
  image.frame = integer_from(json.at("frame"), 0, kLastFrameIndex, "frame");
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

// Does something with a line; what is wrong with it becomes an Error that names the line.
template <typename Action>
void parse_line(const fs::path& path, std::size_t number, Action action) {
  const auto not_results = [&](const std::string& reason) {
    return unreadable("not the results of an evaluation: " + reason,
                      fmt::format("{}:{}", path.string(), number), "remove it to start again");
  };
  try {
    action();
  } catch (const Json::exception&) {  // whose text is not for users
    throw not_results("not JSON, or a field is missing or of another kind");
  } catch (const std::exception& error) {
    throw not_results(error.what());
  }
}

// The first line.
EvalPlan read_plan(LineReader& reader, const fs::path& path) {
  std::string_view line;
  const bool is_there = reader.next(line);
  EvalPlan plan;
  parse_line(path, 1, [&] {
    if (!is_there) throw std::runtime_error("no line with the parameters");
    plan = plan_from_json(Json::parse(line));
  });
  return plan;
}

// Results that have an end are complete.
void check_number(const ResultFile& file) {
  if (file.images != file.plan.positions_of_shard())
    throw std::runtime_error(
        fmt::format("the end after {} images of {}", file.images, file.plan.positions_of_shard()));
}

// Notes where the frames of a file begin to descend.
class RunFinder {
 public:
  explicit RunFinder(std::vector<FileRun>& runs) : runs_(runs) {}
  void add(std::int64_t frame, std::uintmax_t begin, std::uintmax_t end) {
    if (runs_.empty() || frame < last_) {
      if (runs_.size() == kMostRuns) throw std::runtime_error("the frames are not in order");
      runs_.push_back({begin, end});
    }
    runs_.back().end = end;
    last_ = frame;
  }

 private:
  static constexpr std::size_t kMostRuns = 10'000;  // each costs the memory of a reader
  std::vector<FileRun>& runs_;
  std::int64_t last_ = 0;
};

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

ImageResult parse_image(std::string_view line, const EvalPlan& plan) {
  return image_from(Json::parse(line), plan);
}

ResultFile scan_results(const fs::path& folder, const std::function<void(const ImageResult&)>& see) {
  ResultFile file;
  file.path = folder / kResultFile;
  std::error_code code;
  if (fs::exists(file.path, code) && !fs::is_regular_file(file.path, code))
    throw unreadable("not a regular file", file.path.string(), "is this the right folder?");
  LineReader reader(file.path);
  file.plan = read_plan(reader, file.path);
  RunFinder runs(file.runs);
  std::size_t number = 2;
  std::uintmax_t begin = reader.position();
  for (std::string_view line; reader.next(line); begin = reader.position(), ++number)
    parse_line(file.path, number, [&] {
      const Json json = Json::parse(line);
      if (file.complete) throw std::runtime_error("there are lines after its end");
      file.complete = json.contains("end");
      if (file.complete) return check_number(file);
      const ImageResult image = image_from(json, file.plan);
      runs.add(image.frame, begin, reader.position());
      ++file.images;
      if (see) see(image);
    });
  file.bytes = reader.position();
  return file;
}

ResumedResults resume_results(const fs::path& folder, const EvalPlan& plan) {
  const fs::path path = folder / kResultFile;
  std::error_code code;
  if (fs::is_symlink(path, code)) throw failed("it is a symbolic link", path.string(), "delete it");
  std::vector<bool> known(static_cast<std::size_t>(plan.positions));
  std::string_view line;
  if (!fs::exists(path, code) || !LineReader(path).next(line)) {
    LineFile(path).append(plan_line(plan));
    return {0, false, std::move(known)};
  }
  LineReader beginning(path);
  if (const auto other = difference(read_plan(beginning, path), plan))
    throw usage_error("there are results of another evaluation: " + *other, path.string(),
                      "choose another --out, or remove the file");
  const ResultFile file = scan_results(folder, [&](const ImageResult& image) {
    const auto position = plan.position_of(image.frame);
    if (!position) throw std::runtime_error(fmt::format("frame {} is not part of it", image.frame));
    if (known[static_cast<std::size_t>(*position)])
      throw std::runtime_error(fmt::format("frame {} is there twice", image.frame));
    known[static_cast<std::size_t>(*position)] = true;
  });
  if (file.bytes < fs::file_size(path)) fs::resize_file(path, file.bytes);
  return {file.images, file.complete, std::move(known)};
}

}  // namespace saccade
