#include "eval/sequence_evaluation.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "attention/attention.hpp"
#include "core/error.hpp"
#include "eval/chart.hpp"
#include "eval/hit_ratio.hpp"
#include "models/model.hpp"
#include "tracking/attention_tracker.hpp"
#include "tracking/frame_follower.hpp"

namespace saccade {
namespace {

// One model with both ways to choose points.
class Watcher {
 public:
  Watcher(const Settings& settings, WorkerPool& pool)
      : points_(settings.fixations),
        model_(make_model(settings, pool)),
        tracker_(settings.fixations, settings.min_confidence, settings),
        selector_(make_selector(settings)) {
    result_.model = settings.model;
  }

  void see(const Frame& frame) {
    StageTimes times;
    follower_.start(frame);
    try {
      model_->compute(frame, {}, maps_, times);
    } catch (...) {
      follower_.wait();
      throw;
    }
    follower_.wait();
    tracker_.attend(frame, maps_.master, follower_.surfaces(), follower_.step(), attention_);
    watched_.push_back(watched_frame(frame, attention_));
    result_.cuts += attention_.sequence->cut;
    ++result_.frames;
    if (frame.truth.labels.empty()) return;
    add(result_.hit_ratio, frame);
    selector_->select(maps_.master, frame.depth_mm, frame.intrinsics, attention_);
    add(result_.hit_ratio_alone, frame);
    watched_alone_.push_back(watched_frame(frame, attention_));
  }

  SequenceResult finish() {
    result_.over_time = measure_over_time(watched_);
    result_.best_identity_f1_alone = best_identity_f1(watched_alone_);
    for (auto* ratio : {&result_.hit_ratio, &result_.hit_ratio_alone})
      for (double& value : *ratio) value /= static_cast<double>(result_.frames);
    return std::move(result_);
  }

 private:
  void add(std::vector<double>& sum, const Frame& frame) const {
    std::vector<int> hits;
    for (const Fixation& fixation : attention_.fixations)
      hits.push_back(frame.truth.labels(fixation.row, fixation.col));
    const std::vector<double> ratio = hit_ratio(hits, points_);
    sum.resize(ratio.size(), 0);
    for (std::size_t i = 0; i < ratio.size(); ++i) sum[i] += ratio[i];
  }

  int points_;
  std::unique_ptr<SaliencyModel> model_;
  FrameFollower follower_;
  AttentionTracker tracker_;
  std::unique_ptr<AttentionSelector> selector_;
  SaliencyMaps maps_;
  Attention attention_;
  std::vector<WatchedFrame> watched_, watched_alone_;
  SequenceResult result_;
};

// A measure of the table and the figure.
struct Measure {
  std::string name;
  std::function<std::optional<double>(const SequenceResult&)> value;
};

std::optional<double> ratio_at(const std::vector<double>& ratio, std::size_t n) {
  return n <= ratio.size() ? std::optional(ratio[n - 1]) : std::nullopt;
}

// Shares, 0..1.
std::vector<Measure> measures() {
  std::vector<Measure> all;
  for (std::size_t i = 0; i < OverTime::kFirst.size(); ++i)
    all.push_back({fmt::format("held-1, n = {}", OverTime::kFirst[i]),
                   [i](const SequenceResult& r) { return r.over_time.held_next[i]; }});
  for (std::size_t i = 0; i < OverTime::kFirst.size(); ++i)
    all.push_back({fmt::format("held-{}, n = {}", OverTime::kLag, OverTime::kFirst[i]),
                   [i](const SequenceResult& r) { return r.over_time.held_later[i]; }});
  all.push_back({"first stays", [](const SequenceResult& r) { return r.over_time.first_stays; }});
  all.push_back({"IDF1", [](const SequenceResult& r) { return r.over_time.identity_f1; }});
  all.push_back({"IDF1, all points", [](const SequenceResult& r) { return r.over_time.identity_f1_all; }});
  all.push_back(
      {"best IDF1, over time", [](const SequenceResult& r) { return r.over_time.best_identity_f1; }});
  all.push_back(
      {"best IDF1, frame by frame", [](const SequenceResult& r) { return r.best_identity_f1_alone; }});
  for (const std::size_t n : {3U, 5U, 10U}) {
    all.push_back({fmt::format("HR at {}, over time", n),
                   [n](const SequenceResult& r) { return ratio_at(r.hit_ratio, n); }});
    all.push_back({fmt::format("HR at {}, frame by frame", n),
                   [n](const SequenceResult& r) { return ratio_at(r.hit_ratio_alone, n); }});
  }
  return all;
}

std::string shown(std::optional<double> value) { return value ? fmt::format("{:.3f}", *value) : "-"; }

nlohmann::ordered_json json_of(std::optional<double> value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json json_of(const IdentityCounts& counts) {
  return {{"in_view", counts.in_view},       {"right_id", counts.right},
          {"other_id", counts.other_id},     {"in_other", counts.in_other},
          {"without_point", counts.without}, {"more_points", counts.more_points}};
}

IdentityCounts all_objects(const OverTime& over_time) {
  IdentityCounts all;
  for (const auto& [label, counts] : over_time.of_label) all += counts;
  return all;
}

nlohmann::ordered_json identity_json(const OverTime& over_time) {
  nlohmann::ordered_json json = json_of(all_objects(over_time));
  json["points_on_nothing"] = over_time.points_on_nothing;
  for (const auto& [label, counts] : over_time.of_label)
    json["objects"][std::to_string(label)] = json_of(counts);
  return json;
}

// The counts of all objects in the order of IdentityCounts, as rows of the text.
struct IdentityRow {
  std::string name;
  int IdentityCounts::*count;
};
const std::vector<IdentityRow> kIdentityRows = {{"objects in view", &IdentityCounts::in_view},
                                                {"  under the right id", &IdentityCounts::right},
                                                {"  under another id", &IdentityCounts::other_id},
                                                {"  in another's mask", &IdentityCounts::in_other},
                                                {"  without a point", &IdentityCounts::without},
                                                {"more points on objects", &IdentityCounts::more_points}};

}  // namespace

SequenceResult watch_sequence(FrameSource& source, const Settings& settings, WorkerPool& pool,
                              const std::function<bool(std::int64_t)>& go_on) {
  Watcher watcher(settings, pool);
  Frame frame;
  const std::int64_t count = selected_frames(settings, source.info().frame_count.value_or(0));
  std::int64_t used = 0;
  for (std::int64_t i = 0; i < count && go_on(i); ++i) {
    source.seek(settings.start + i * settings.every);
    const ReadResult read = source.read(frame, std::chrono::seconds(1));
    if (read.status == ReadStatus::end) break;
    if (read.status != ReadStatus::frame) continue;
    if (settings.intrinsics) frame.intrinsics = *settings.intrinsics;
    if (frame.truth.labels.empty() && !frame.truth.camera_to_world)
      throw unreadable("a frame has neither labels nor a camera pose", source.info().uri,
                       "over time, one of them must be known; see src/eval/README.md");
    watcher.see(frame);
    ++used;
  }
  if (used == 0)
    throw unreadable("no frame can be used", source.info().uri,
                     "saccade run lists the reasons in manifest.json");
  return watcher.finish();
}

nlohmann::ordered_json over_time_json(const std::vector<SequenceResult>& results) {
  auto models = nlohmann::ordered_json::array();
  for (const SequenceResult& result : results) {
    nlohmann::ordered_json json = {{"model", result.model}, {"frames", result.frames}, {"cuts", result.cuts}};
    for (std::size_t i = 0; i < OverTime::kFirst.size(); ++i) {
      const std::string n = std::to_string(OverTime::kFirst[i]);
      json["held_1"][n] = json_of(result.over_time.held_next[i]);
      json[fmt::format("held_{}", OverTime::kLag)][n] = json_of(result.over_time.held_later[i]);
    }
    json["first_stays"] = json_of(result.over_time.first_stays);
    json["ids_per_place"] = json_of(result.over_time.ids_per_place);
    json["identity_f1"] = json_of(result.over_time.identity_f1);
    json["identity_f1_all"] = json_of(result.over_time.identity_f1_all);
    json["best_identity_f1"] = {{"over_time", json_of(result.over_time.best_identity_f1)},
                                {"frame_by_frame", json_of(result.best_identity_f1_alone)}};
    json["id_switches"] = result.over_time.id_switches;
    if (!result.over_time.of_label.empty()) json["identity"] = identity_json(result.over_time);
    json["hit_ratio"] = {{"over_time", result.hit_ratio}, {"frame_by_frame", result.hit_ratio_alone}};
    models.push_back(std::move(json));
  }
  return models;
}

std::string over_time_text(const std::vector<SequenceResult>& results) {
  std::string text = fmt::format("{:<26}", "");
  for (const SequenceResult& result : results) text += fmt::format(" {:>14}", result.model);
  const auto row = [&](const std::string& name, const auto& value) {
    text += fmt::format("\n{:<26}", name);
    for (const SequenceResult& result : results) text += fmt::format(" {:>14}", value(result));
  };
  for (const Measure& measure : measures())
    row(measure.name, [&](const SequenceResult& result) { return shown(measure.value(result)); });
  row("ids per place", [](const SequenceResult& result) { return shown(result.over_time.ids_per_place); });
  row("id switches",
      [](const SequenceResult& result) { return std::to_string(result.over_time.id_switches); });
  for (const IdentityRow& identity : kIdentityRows)
    row(identity.name, [&](const SequenceResult& result) {
      return result.over_time.of_label.empty()
                 ? "-"
                 : std::to_string(all_objects(result.over_time).*identity.count);
    });
  row("points on no object",
      [](const SequenceResult& result) { return std::to_string(result.over_time.points_on_nothing); });
  row("cuts", [](const SequenceResult& result) { return std::to_string(result.cuts); });
  return text + "\n";
}

// A group of bars for each measure that any model has, a bar for each model.
Drawing draw_over_time(const std::vector<SequenceResult>& results) {
  constexpr double kLeft = 190, kTop = 40, kLength = 420, kBar = 11, kGap = 9, kSize = 12;
  constexpr std::array<Colour, 6> kPalette = {
      {{0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}, {230, 159, 0}, {86, 180, 233}}};
  Drawing drawing;
  std::vector<std::variant<Line, Area, Text>> bars;
  double y = kTop;
  for (const Measure& measure : measures()) {
    const auto has = [&](const SequenceResult& result) { return measure.value(result).has_value(); };
    if (std::none_of(results.begin(), results.end(), has)) continue;
    const double height = kBar * static_cast<double>(results.size());
    bars.emplace_back(Text{{kLeft - 8, y + height / 2 + kSize / 3}, measure.name, kSize, Anchor::end, kInk});
    for (std::size_t i = 0; i < results.size(); ++i, y += kBar) {
      const double value = measure.value(results[i]).value_or(0), right = kLeft + kLength * value;
      bars.emplace_back(Area{{{kLeft, y}, {right, y}, {right, y + kBar - 1}, {kLeft, y + kBar - 1}},
                             kPalette[i % kPalette.size()],
                             1});
      bars.emplace_back(
          Text{{right + 4, y + kBar - 2}, shown(measure.value(results[i])), kSize - 2, Anchor::start, kInk});
    }
    y += kGap;
  }
  for (int tenth = 0; tenth <= 10; tenth += 2) {
    const double x = kLeft + kLength * tenth / 10;
    drawing.shapes.emplace_back(Line{{{x, kTop - 4}, {x, y}}, kGrid, 1});
    drawing.shapes.emplace_back(
        Text{{x, y + kSize + 2}, fmt::format("{:.1f}", tenth / 10.0), kSize, Anchor::middle, kInk});
  }
  for (std::size_t i = 0; i < results.size(); ++i)
    drawing.shapes.emplace_back(Text{{kLeft + 130 * static_cast<double>(i), kTop - 18},
                                     results[i].model,
                                     kSize + 1,
                                     Anchor::start,
                                     kPalette[i % kPalette.size()]});
  drawing.shapes.insert(drawing.shapes.end(), bars.begin(), bars.end());
  drawing.width = kLeft + std::max(kLength + 60, 130.0 * static_cast<double>(results.size()));
  drawing.height = y + 2 * kSize + 6;
  return drawing;
}

}  // namespace saccade
