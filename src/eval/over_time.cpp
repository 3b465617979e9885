#include "eval/over_time.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "eval/hit_ratio.hpp"

namespace saccade {
namespace {

using Point = WatchedFrame::Point;

// Parts of a frame that is watched from its neighbours.
struct Place {
  int id;
  cv::Point3d world_mm;
};

std::vector<Place> places_of(const WatchedFrame& frame) {
  std::vector<Place> places;
  for (const Point& point : frame.points)
    if (point.position_mm.z > 0) places.push_back({point.id, *frame.camera_to_world * point.position_mm});
  return places;
}

bool in_view(const WatchedFrame& frame, const cv::Point3d& world_mm) {
  constexpr double kNearest_mm = 300, kBorder_px = 10;
  const cv::Point3d p = frame.camera_to_world->inv() * world_mm;
  if (p.z <= kNearest_mm) return false;
  const double col = frame.camera.fx * p.x / p.z + frame.camera.cx,
               row = frame.camera.fy * p.y / p.z + frame.camera.cy;
  return col > kBorder_px && col < frame.size.width - kBorder_px && row > kBorder_px &&
         row < frame.size.height - kBorder_px;
}

bool same_place(const cv::Point3d& a, const cv::Point3d& b) {
  return cv::norm(a - b) < OverTime::kSamePlace_mm;
}

using AllPlaces = std::vector<std::vector<Place>>;

std::optional<double> held(const std::vector<WatchedFrame>& frames, const AllPlaces& places,
                           std::size_t first, std::size_t lag) {
  double sum = 0;
  int counted = 0;
  for (std::size_t t = 0; t + lag < frames.size(); ++t) {
    const auto& now = places[t];
    const auto& later = places[t + lag];
    int wanted = 0, hits = 0;
    for (std::size_t i = 0; i < std::min(first, now.size()); ++i) {
      if (!in_view(frames[t + lag], now[i].world_mm)) continue;
      ++wanted;
      hits += std::any_of(later.begin(), later.end(), [&](const Place& place) {
        return place.id == now[i].id && same_place(place.world_mm, now[i].world_mm);
      });
    }
    if (wanted == 0) continue;
    sum += static_cast<double>(hits) / wanted;
    ++counted;
  }
  return counted > 0 ? std::optional(sum / counted) : std::nullopt;
}

std::optional<double> first_stays(const std::vector<WatchedFrame>& frames) {
  int pairs = 0, stays = 0;
  for (std::size_t t = 0; t + 1 < frames.size(); ++t) {
    if (frames[t].points.empty() || frames[t + 1].points.empty()) continue;
    ++pairs;
    stays += frames[t].points.front().id == frames[t + 1].points.front().id;
  }
  return pairs > 0 ? std::optional(static_cast<double>(stays) / pairs) : std::nullopt;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

cv::Point3d median_place(const std::vector<cv::Point3d>& places) {
  std::array<std::vector<double>, 3> axes;
  for (const cv::Point3d& p : places) {
    axes[0].push_back(p.x);
    axes[1].push_back(p.y);
    axes[2].push_back(p.z);
  }
  return {median(axes[0]), median(axes[1]), median(axes[2])};
}

std::optional<double> ids_per_place(const AllPlaces& places) {
  constexpr std::size_t kFirst = 10, kFrames = 5;
  std::map<int, std::vector<cv::Point3d>> of_id;
  for (const auto& frame : places)
    for (std::size_t i = 0; i < std::min(kFirst, frame.size()); ++i)
      of_id[frame[i].id].push_back(frame[i].world_mm);
  std::vector<cv::Point3d> different;
  int ids = 0;
  for (const auto& [id, seen] : of_id) {
    if (seen.size() < kFrames) continue;
    ++ids;
    const cv::Point3d place = median_place(seen);
    if (std::none_of(different.begin(), different.end(),
                     [&](const auto& other) { return same_place(place, other); }))
      different.push_back(place);
  }
  return different.empty() ? std::nullopt
                           : std::optional(static_cast<double>(ids) / static_cast<double>(different.size()));
}

// Numbers the values of a set from 0.
std::map<int, int> numbered(const std::set<int>& values) {
  std::map<int, int> numbers;
  for (int value : values) numbers.emplace(value, static_cast<int>(numbers.size()));
  return numbers;
}

// WatchedFrame::covered_by. masks: rank of the point, 0 = none; empty = not known.
std::vector<int> covering_points(const cv::Mat1w& labels, const std::vector<int>& in_view,
                                 const cv::Mat1w& masks) {
  if (masks.empty() || labels.empty()) return {};
  std::map<int, std::map<int, int>> pixels;  // by label and rank
  for (int r = 0; r < labels.rows; ++r)
    for (int c = 0; c < labels.cols; ++c)
      if (labels(r, c) != 0) ++pixels[labels(r, c)][masks(r, c)];
  std::vector<int> covering;
  for (const int label : in_view) {
    int all = 0;
    for (const auto& [rank, count] : pixels[label]) all += count;
    const auto most = std::find_if(pixels[label].begin(), pixels[label].end(), [&](const auto& of_rank) {
      return of_rank.first != 0 && 2 * of_rank.second > all;
    });
    covering.push_back(most == pixels[label].end() ? -1 : most->first - 1);
  }
  return covering;
}

// Adds a frame to the counts. id_of: the best id of each label.
void count_identity(const WatchedFrame& frame, const std::map<int, int>& id_of, OverTime& result) {
  for (std::size_t i = 0; i < frame.labels.size(); ++i) {
    const int label = frame.labels[i];
    const auto best = id_of.find(label);
    IdentityCounts& counts = result.of_label[label];
    int points = 0;
    bool right = false;
    for (const Point& point : frame.points) {
      if (point.label != label) continue;
      ++points;
      right = right || (best != id_of.end() && point.id == best->second);
    }
    ++counts.in_view;
    counts.more_points += std::max(0, points - 1);
    const bool in_other = i < frame.covered_by.size() && frame.covered_by[i] >= 0;
    ++(right ? counts.right : points > 0 ? counts.other_id : in_other ? counts.in_other : counts.without);
  }
  result.points_on_nothing +=
      static_cast<int>(std::count_if(frame.points.begin(), frame.points.end(), [&](const Point& point) {
        return !std::binary_search(frame.labels.begin(), frame.labels.end(), point.label);
      }));
}

// Sets all that is known of identities but the switches.
void measure_identity(const std::vector<WatchedFrame>& frames, OverTime& result) {
  std::set<int> labels, ids;
  double objects = 0, fixations = 0, on_objects = 0;
  for (const WatchedFrame& frame : frames) {
    labels.insert(frame.labels.begin(), frame.labels.end());
    objects += static_cast<double>(frame.labels.size());
    fixations += static_cast<double>(frame.points.size());
    for (const Point& point : frame.points) ids.insert(point.id);
  }
  if (labels.empty()) return;
  const std::map<int, int> row_of = numbered(labels), col_of = numbered(ids);
  cv::Mat1d hits(static_cast<int>(labels.size()), static_cast<int>(ids.size()), 0.0);
  for (const WatchedFrame& frame : frames)
    for (const Point& point : frame.points)
      if (std::binary_search(frame.labels.begin(), frame.labels.end(), point.label)) {
        ++hits(row_of.at(point.label), col_of.at(point.id));
        ++on_objects;
      }
  double right = 0;
  std::map<int, int> id_of;
  const std::vector<int> column = best_assignment(hits);
  for (const auto& [label, row] : row_of)
    if (const int col = column[static_cast<std::size_t>(row)]; col >= 0 && hits(row, col) > 0) {
      right += hits(row, col);
      id_of[label] = *std::next(ids.begin(), col);
    }
  for (const WatchedFrame& frame : frames) count_identity(frame, id_of, result);
  result.identity_f1 = 2 * right / (objects + on_objects);
  result.identity_f1_all = 2 * right / (objects + fixations);
}

int id_switches(const std::vector<WatchedFrame>& frames) {
  std::map<int, int> id_of;  // the last of each label
  int switches = 0;
  for (const WatchedFrame& frame : frames) {
    std::map<int, std::vector<int>> now;
    for (const Point& point : frame.points)
      if (point.label != 0) now[point.label].push_back(point.id);
    for (const auto& [label, ids] : now) {
      const auto before = id_of.find(label);
      if (before != id_of.end() && std::count(ids.begin(), ids.end(), before->second) > 0) continue;
      switches += before != id_of.end();
      id_of[label] = ids.front();
    }
  }
  return switches;
}

}  // namespace

IdentityCounts& IdentityCounts::operator+=(const IdentityCounts& other) {
  in_view += other.in_view;
  right += other.right;
  other_id += other.other_id;
  in_other += other.in_other;
  without += other.without;
  more_points += other.more_points;
  return *this;
}

WatchedFrame watched_frame(const Frame& frame, const Attention& attention) {
  WatchedFrame watched;
  const cv::Mat1w& labels = frame.truth.labels;
  for (const Fixation& fixation : attention.fixations)
    watched.points.push_back(
        {fixation.id, labels.empty() ? 0 : labels(fixation.row, fixation.col), fixation.position_mm});
  if (!labels.empty())
    for (const auto& [label, pixels] : object_areas(labels))
      if (pixels >= kFewestPixels) watched.labels.push_back(label);
  watched.covered_by = covering_points(labels, watched.labels, attention.masks);
  watched.camera_to_world = frame.truth.camera_to_world;
  watched.camera = frame.intrinsics;
  watched.size = frame.size();
  return watched;
}

std::optional<double> best_identity_f1(const std::vector<WatchedFrame>& frames) {
  std::size_t objects = 0, hit = 0, on_objects = 0;
  for (const WatchedFrame& frame : frames) {
    objects += frame.labels.size();
    for (const int label : frame.labels) {
      const auto points =
          static_cast<std::size_t>(std::count_if(frame.points.begin(), frame.points.end(),
                                                 [&](const Point& point) { return point.label == label; }));
      hit += points > 0;
      on_objects += points;
    }
  }
  if (objects == 0) return std::nullopt;
  return 2 * static_cast<double>(hit) / static_cast<double>(objects + on_objects);
}

OverTime measure_over_time(const std::vector<WatchedFrame>& frames) {
  OverTime result;
  const bool poses = !frames.empty() &&
                     std::all_of(frames.begin(), frames.end(),
                                 [](const WatchedFrame& frame) { return frame.camera_to_world.has_value(); });
  if (poses) {
    AllPlaces places;
    for (const WatchedFrame& frame : frames) places.push_back(places_of(frame));
    for (std::size_t i = 0; i < OverTime::kFirst.size(); ++i) {
      const auto first = static_cast<std::size_t>(OverTime::kFirst[i]);
      result.held_next[i] = held(frames, places, first, 1);
      result.held_later[i] = held(frames, places, first, OverTime::kLag);
    }
    result.ids_per_place = ids_per_place(places);
  }
  result.first_stays = first_stays(frames);
  measure_identity(frames, result);
  result.best_identity_f1 = best_identity_f1(frames);
  result.id_switches = id_switches(frames);
  return result;
}

// The Hungarian method with potentials, on cost = largest gain - gain, rows added one by one; the wider side
// is columns.
std::vector<int> best_assignment(const cv::Mat1d& gain) {
  if (gain.empty()) return std::vector<int>(static_cast<std::size_t>(gain.rows), -1);
  if (gain.rows > gain.cols) {
    const std::vector<int> row_of = best_assignment(cv::Mat1d(gain.t()));
    std::vector<int> column(static_cast<std::size_t>(gain.rows), -1);
    for (std::size_t col = 0; col < row_of.size(); ++col)
      column[static_cast<std::size_t>(row_of[col])] = static_cast<int>(col);
    return column;
  }
  const double largest = *std::max_element(gain.begin(), gain.end());
  const auto rows = static_cast<std::size_t>(gain.rows), cols = static_cast<std::size_t>(gain.cols);
  std::vector<double> row_potential(rows + 1, 0), col_potential(cols + 1, 0);
  std::vector<std::size_t> row_at(cols + 1, 0);  // of each column, from 1; 0 = free
  for (std::size_t row = 1; row <= rows; ++row) {
    // A shortest path from the row to a free column.
    std::vector<double> slack(cols + 1, std::numeric_limits<double>::infinity());
    std::vector<std::size_t> from(cols + 1, 0);
    std::vector<bool> visited(cols + 1, false);
    row_at[0] = row;
    std::size_t col = 0;
    while (row_at[col] != 0) {
      visited[col] = true;
      const std::size_t r = row_at[col];
      std::size_t next = 0;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t c = 1; c <= cols; ++c) {
        if (visited[c]) continue;
        const double cost = largest - gain(static_cast<int>(r) - 1, static_cast<int>(c) - 1) -
                            row_potential[r] - col_potential[c];
        if (cost < slack[c]) slack[c] = cost, from[c] = col;
        if (slack[c] < least) least = slack[c], next = c;
      }
      for (std::size_t c = 0; c <= cols; ++c) {
        if (visited[c])
          row_potential[row_at[c]] += least, col_potential[c] -= least;
        else
          slack[c] -= least;
      }
      col = next;
    }
    for (; col != 0; col = from[col]) row_at[col] = row_at[from[col]];
  }
  std::vector<int> column(rows, -1);
  for (std::size_t c = 1; c <= cols; ++c)
    if (row_at[c] != 0) column[row_at[c] - 1] = static_cast<int>(c) - 1;
  return column;
}

}  // namespace saccade
