#include "eval/report.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "attention/confidence.hpp"
#include "core/text.hpp"
#include "core/version.hpp"
#include "eval/evaluation_format.hpp"
#include "eval/hit_ratio.hpp"

namespace saccade {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kDigits = 6;  // more than enough for a Hit Ratio

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

Json points_on_json(const std::vector<PointShares>& shares, bool void_known) {
  Json points = Json::array();
  for (std::size_t i = 0; i < shares.size(); ++i) {
    Json at_n = {{"n", i + 1},
                 {"new_object", rounded(shares[i].new_object)},
                 {"same_object", rounded(shares[i].same_object)},
                 {"structure", rounded(shares[i].structure)}};
    if (void_known) at_n["void"] = rounded(shares[i].unlabelled);
    at_n["missing"] = rounded(shares[i].missing);
    points.push_back(at_n);
  }
  return points;
}

Json halves_json(const std::array<std::vector<double>, 2>& halves, const std::vector<int>& counts) {
  Json json = Json::object();
  for (const std::size_t half : {0U, 1U}) {
    Json means = Json::array();
    for (const int n : counts)
      if (!halves[half].empty())
        means.push_back({{"n", n}, {"mean", rounded(halves[half][static_cast<std::size_t>(n - 1)])}});
    json[half == 0 ? "even" : "odd"] = means;
  }
  return json;
}

Json cross_validation_json(const EvalPlan& plan, const Statistics& statistics) {
  Json all = Json::array();
  const auto conditions = plan.conditions();
  for (const CrossValidation& c : statistics.cross_validations)
    all.push_back({{"model", c.model},
                   {"even_images_under", condition_json(conditions[c.used[0]])},
                   {"odd_images_under", condition_json(conditions[c.used[1]])},
                   {"hr", curve_json(c.curve)}});
  return all;
}

Json reliability_json(const Reliability& reliability) {
  Json bins = Json::array();
  for (std::size_t i = 0; i < reliability.bins.size(); ++i) {
    const Reliability::Bin& bin = reliability.bins[i];
    bins.push_back({{"from", rounded(static_cast<double>(i) / Reliability::kBins)},
                    {"to", rounded(static_cast<double>(i + 1) / Reliability::kBins)},
                    {"points", bin.points},
                    {"confidence", rounded(bin.confidence)},
                    {"on_object", rounded(bin.on_object)}});
  }
  return {{"points", reliability.points},
          {"brier", rounded(reliability.brier)},
          {"threshold", kProbablyObject},
          {"points_above", reliability.sure},
          {"precision", rounded(reliability.precision)},
          {"recall", rounded(reliability.recall)},
          {"bins", bins}};
}

Json conditions_json(const EvalPlan& plan, const Statistics& statistics) {
  Json all = Json::array();
  const auto conditions = plan.conditions();
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    Json json = condition_json(conditions[i]);
    json["points_per_image"] = rounded(statistics.points_mean[i]);
    json["hr"] = curve_json(statistics.conditions[i]);
    const bool void_known = statistics.void_known > 0;
    if (void_known) json["hr_void_neutral"] = curve_json(statistics.void_neutral[i]);
    json["points_on"] = points_on_json(statistics.points_on[i], void_known);
    if (statistics.reliability[i]) json["confidence"] = reliability_json(*statistics.reliability[i]);
    json["halves"] = halves_json(statistics.halves[i], shown_counts(plan.points));
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

Json left_out_json(const std::vector<LeftOut>& images) {
  Json all = Json::array();
  for (const LeftOut& image : images)
    all.push_back({{"frame", image.frame}, {"name", image.name}, {"reason", image.reason}});
  return all;
}

// The lines of one image and condition; `start` is the same in all of them.
std::string condition_csv(const EvalPlan& plan, const ImageResult& image, const std::vector<int>& hits,
                          const std::string& start) {
  const auto ratio = hit_ratio(hits, plan.points), neutral = hit_ratio(without_void(hits), plan.points);
  const auto bound = hit_ratio_bound(image.objects, plan.points);
  const auto kinds = point_kinds(hits, plan.points);
  std::string text;
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    const std::string on_void = image.void_known ? std::to_string(kinds[i].unlabelled) : "";
    const std::string hr_void_neutral = image.void_known ? fmt::format("{:.6f}", neutral[i]) : "";
    text += fmt::format("{},{},{},{},{:.6f},{:.6f},{},{},{},{},{}\n", start, i + 1, image.objects,
                        kinds[i].new_object, ratio[i], bound[i], kinds[i].same_object, kinds[i].structure,
                        on_void, kinds[i].missing, hr_void_neutral);
  }
  return text;
}

std::string table_line(const std::string& name, const Curve& curve, const std::vector<int>& counts) {
  std::string line = fmt::format("{:<40}", name);
  for (const int n : counts) line += fmt::format(" {:6.3f}", curve.mean[static_cast<std::size_t>(n - 1)]);
  return line + "\n";
}

// What the first ten points, or fewer, lie on.
std::string points_on_text(const EvalPlan& plan, const Statistics& statistics) {
  const int n = std::min(plan.points, 10);
  const bool void_known = statistics.void_known > 0;
  std::string text =
      fmt::format("{:<40} {:>6} {:>6} {:>6}{} {:>6}\n", fmt::format("Share of {} on", counted(n, "point")),
                  "new", "same", "none", void_known ? "   void" : "", "missing");
  const auto conditions = plan.conditions();
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    const PointShares& share = statistics.points_on[i][static_cast<std::size_t>(n - 1)];
    text += fmt::format("{:<40} {:6.3f} {:6.3f} {:6.3f}{} {:6.3f}\n", describe(conditions[i]),
                        share.new_object, share.same_object, share.structure,
                        void_known ? fmt::format(" {:6.3f}", share.unlabelled) : "", share.missing);
  }
  return text;
}

std::string reliability_text(const EvalPlan& plan, const Statistics& statistics) {
  std::string lines;
  const auto conditions = plan.conditions();
  for (std::size_t i = 0; i < conditions.size(); ++i)
    if (const auto& r = statistics.reliability[i])
      lines += fmt::format("{:<40} {:6} {:6} {:9.3f} {:6.3f} {:6.3f}\n", describe(conditions[i]), r->points,
                           r->sure, r->precision, r->recall, r->brier);
  if (lines.empty()) return lines;
  return fmt::format("{:<40} {:>6} {:>6} {:>9} {:>6} {:>6}\n",
                     fmt::format("Points of a confidence >= {}", kProbablyObject), "of", "number",
                     "precision", "recall", "Brier") +
         lines;
}

}  // namespace

std::string csv_head() {
  return "frame,name,model,kernel,selector,n,objects,found,hr,bound,same_object,structure,void,missing,"
         "hr_void_neutral\n";
}

std::string csv_lines(const EvalPlan& plan, const ImageResult& image) {
  std::string text;
  const auto conditions = plan.conditions();
  for (std::size_t i = 0; i < image.conditions.size(); ++i) {
    const std::string start =
        fmt::format("{},{},{},{},{}", image.frame, quoted(image.name), conditions[i].model,
                    conditions[i].kernel, to_string(conditions[i].selector));
    text += condition_csv(plan, image, image.conditions[i].hits(), start);
  }
  return text;
}

Json report_json(const EvalPlan& plan, const Statistics& statistics) {
  Json json = {{"program", "saccade"}, {"version", kVersion}, {"format", kEvaluationFormat}};
  json["parameters"] = plan_json(plan);
  for (const char* key : {"format", "version", "shard", "shards"}) json["parameters"].erase(key);
  if (!plan.missing.empty()) json["partial"] = plan.missing;
  if (plan.shards > 1) json["shard"] = fmt::format("{}/{}", plan.shard, plan.shards);
  json["images"] = statistics.images;
  json["images_with_classes"] = statistics.void_known;
  json["images_left_out"] = statistics.images_left_out;
  json["left_out"] = left_out_json(statistics.left_out);
  json["objects_per_image"] = {{"mean", rounded(statistics.objects_mean)},
                               {"least", statistics.objects_least},
                               {"most", statistics.objects_most},
                               {"images_without", statistics.without_objects}};
  json["interval"] = {{"share", 0.95}};
  if (statistics.images <= kMostResampled) {
    json["interval"]["method"] = "percentile bootstrap over images";
    json["interval"]["resamples"] = kResamples;
    json["interval"]["seed"] = kBootstrapSeed;
  } else {
    json["interval"]["method"] = "normal distribution of the mean over images";
  }
  json["bound"] = curve_json(statistics.bound);
  json["baselines"] = {{"random", curve_json(statistics.random)}, {"centre", curve_json(statistics.centre)}};
  json["conditions"] = conditions_json(plan, statistics);
  json["differences"] = differences_json(plan, statistics);
  json["cross_validation"] = cross_validation_json(plan, statistics);
  return json;
}

std::string report_text(const EvalPlan& plan, const Statistics& statistics) {
  const auto counts = shown_counts(plan.points);
  std::string text = plan.missing.empty() ? "" : "PARTIAL: " + plan.missing + "\n";
  text += fmt::format("{:<40}", "Hit Ratio at n =");
  for (const int n : counts) text += fmt::format(" {:>6}", n);
  text += "\n" + table_line("upper bound", statistics.bound, counts);
  const auto conditions = plan.conditions();
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    text += table_line(describe(conditions[i]), statistics.conditions[i], counts);
    if (statistics.void_known > 0) text += table_line("  void-neutral", statistics.void_neutral[i], counts);
  }
  for (const CrossValidation& c : statistics.cross_validations)
    if (plan.kernels.size() * plan.selectors.size() > 1)
      text += table_line(c.model + ", cross-validated", c.curve, counts);
  text += table_line("centre (expected)", statistics.centre, counts);
  text += table_line("random (expected)", statistics.random, counts);
  return text + points_on_text(plan, statistics) + reliability_text(plan, statistics);
}

}  // namespace saccade
