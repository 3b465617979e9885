#include "eval/report.hpp"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/version.hpp"
#include "eval/hit_ratio.hpp"

namespace saccade {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kDigits = 6;  // a Hit Ratio has no more to tell

double rounded(double value, int digits = kDigits) {
  const double scale = std::pow(10.0, digits);
  return std::round(value * scale) / scale + 0.0;  // no negative zero
}

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

Json curve_json(const Curve& curve) {
  Json points = Json::array();
  for (std::size_t i = 0; i < curve.mean.size(); ++i)
    points.push_back({{"n", i + 1},
                      {"mean", rounded(curve.mean[i])},
                      {"low", rounded(curve.interval[i].low)},
                      {"high", rounded(curve.interval[i].high)}});
  return points;
}

Json condition_json(const Condition& condition) {
  return {
      {"model", condition.model}, {"kernel", condition.kernel}, {"selector", to_string(condition.selector)}};
}

Json conditions_json(const EvalPlan& plan, const Statistics& statistics) {
  Json all = Json::array();
  const auto conditions = plan.conditions();
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    Json json = condition_json(conditions[i]);
    json["points_per_image"] = rounded(statistics.points_mean[i]);
    json["hr"] = curve_json(statistics.conditions[i]);
    json["times_ms"] = {{"map", rounded(statistics.map_ms[i], 3)},
                        {"select", rounded(statistics.select_ms[i], 3)}};
    all.push_back(json);
  }
  return all;
}

Json differences_json(const EvalPlan& plan, const Statistics& statistics) {
  Json all = Json::array();
  const auto conditions = plan.conditions();
  const auto counts = shown_counts(plan.points);
  for (const Difference& difference : statistics.differences) {
    Json hr = Json::array();
    for (std::size_t i = 0; i < counts.size(); ++i)
      hr.push_back({{"n", counts[i]},
                    {"mean", rounded(difference.mean[i])},
                    {"low", rounded(difference.interval[i].low)},
                    {"high", rounded(difference.interval[i].high)}});
    all.push_back({{"of", condition_json(conditions[difference.a])},
                   {"minus", condition_json(conditions[difference.b])},
                   {"hr", hr}});
  }
  return all;
}

Json left_out_json(const std::vector<ImageResult>& images) {
  Json all = Json::array();
  for (const ImageResult& image : images)
    if (!image.left_out.empty())
      all.push_back({{"frame", image.frame}, {"name", image.name}, {"reason", image.left_out}});
  return all;
}

std::string table_line(const std::string& name, const Curve& curve, const std::vector<int>& counts) {
  std::string line = fmt::format("{:<40}", name);
  for (const int n : counts) line += fmt::format(" {:6.3f}", curve.mean[static_cast<std::size_t>(n - 1)]);
  return line + "\n";
}

}  // namespace

std::string csv_text(const EvalPlan& plan, const std::vector<ImageResult>& images) {
  std::string text = "frame,name,model,kernel,selector,n,objects,found,hr,bound\n";
  const auto conditions = plan.conditions();
  for (const ImageResult& image : images) {
    if (!image.left_out.empty()) continue;
    const auto bound = hit_ratio_bound(image.objects, plan.points);
    for (std::size_t i = 0; i < conditions.size(); ++i) {
      std::vector<int> hits;
      for (const EvalPoint& point : image.conditions[i].points) hits.push_back(point.label);
      const auto found = objects_found(hits, plan.points);
      const std::string start =
          fmt::format("{},{},{},{},{}", image.frame, quoted(image.name), conditions[i].model,
                      conditions[i].kernel, to_string(conditions[i].selector));
      for (std::size_t n = 1; n <= found.size(); ++n)
        text += fmt::format("{},{},{},{},{:.6f},{:.6f}\n", start, n, image.objects, found[n - 1],
                            found[n - 1] / static_cast<double>(n), bound[n - 1]);
    }
  }
  return text;
}

Json report_json(const EvalPlan& plan, const std::vector<ImageResult>& images, const Statistics& statistics) {
  Json json = {{"program", "saccade"}, {"version", kVersion}};
  json["parameters"] = plan_json(plan);
  for (const char* key : {"format", "version", "shard", "shards"}) json["parameters"].erase(key);
  if (plan.shards > 1) json["shard"] = fmt::format("{}/{}", plan.shard, plan.shards);
  json["images"] = statistics.images;
  json["left_out"] = left_out_json(images);
  json["objects_per_image"] = {{"mean", rounded(statistics.objects_mean)},
                               {"least", statistics.objects_least},
                               {"most", statistics.objects_most},
                               {"images_without", statistics.without_objects}};
  json["interval"] = {{"share", 0.95},
                      {"method", "percentile bootstrap over images"},
                      {"resamples", kResamples},
                      {"seed", kBootstrapSeed}};
  json["bound"] = curve_json(statistics.bound);
  json["baselines"] = {{"random", curve_json(statistics.random)}, {"centre", curve_json(statistics.centre)}};
  json["conditions"] = conditions_json(plan, statistics);
  json["differences"] = differences_json(plan, statistics);
  return json;
}

std::string report_text(const EvalPlan& plan, const Statistics& statistics) {
  const auto counts = shown_counts(plan.points);
  std::string text = fmt::format("{:<40}", "Hit Ratio at n =");
  for (const int n : counts) text += fmt::format(" {:>6}", n);
  text += "\n" + table_line("upper bound", statistics.bound, counts);
  const auto conditions = plan.conditions();
  for (std::size_t i = 0; i < conditions.size(); ++i)
    text += table_line(describe(conditions[i]), statistics.conditions[i], counts);
  text += table_line("centre (expected)", statistics.centre, counts);
  return text + table_line("random (expected)", statistics.random, counts);
}

}  // namespace saccade
