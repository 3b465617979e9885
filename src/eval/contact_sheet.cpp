#include "eval/contact_sheet.hpp"

#include <algorithm>
#include <functional>
#include <set>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "core/error.hpp"
#include "core/file.hpp"
#include "eval/hit_ratio.hpp"
#include "eval/statistics.hpp"
#include "oni/jpeg.hpp"
#include "output/overlay.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kExamples = 4;  // best ones, and as many worst ones
constexpr int kPoints = 10;           // drawn in a picture
constexpr int kWidth = 480;           // of a picture, px

// Adds an example behind those whose share is not smaller.
void insert(std::vector<Example>& ranking, const Example& example) {
  const auto place = std::ranges::upper_bound(ranking, example.share, std::greater<>(), &Example::share);
  ranking.insert(place, example);
}

// Contours of the objects, a light line on a dark one: white where a point hit, red where none did.
void draw_objects(cv::Mat3b& picture, const cv::Mat1w& labels, const std::vector<EvalPoint>& points) {
  std::set<int> hit;
  for (const EvalPoint& point : points) hit.insert(point.label);
  const cv::Scalar kHit(255, 255, 255), kMissed(60, 60, 255), kShadow(0, 0, 0);
  for (const auto& [label, area] : object_areas(labels)) {
    cv::Mat1b mask;
    cv::compare(labels, label, mask, cv::CMP_EQ);
    std::vector<std::vector<cv::Point>> contours;
    cv::findContours(mask, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_SIMPLE);
    cv::drawContours(picture, contours, -1, kShadow, 4, cv::LINE_AA);
    cv::drawContours(picture, contours, -1, hit.contains(label) ? kHit : kMissed, 2, cv::LINE_AA);
  }
}

}  // namespace

ExampleChooser::ExampleChooser(const EvalPlan& plan)
    : plan_(plan), conditions_(plan.conditions()), rankings_(conditions_.size()) {}

void ExampleChooser::add(const ImageResult& image) {
  if (image.left_out || image.objects == 0) return;
  for (std::size_t i = 0; i < conditions_.size(); ++i) {
    Ranking& ranking = rankings_[i];
    const double share = share_of_bound(plan_, image, i);
    ++ranking.images;
    ranking.shares += share;
    const bool is_full = ranking.best.size() == kExamples;
    const bool is_good = !is_full || share > ranking.best.back().share;
    const bool is_bad = !is_full || share <= ranking.worst.front().share;
    if (!is_good && !is_bad) continue;
    const Example example{i, image.frame, image.name, image.objects, image.conditions[i], share};
    if (is_good) insert(ranking.best, example);
    if (is_bad) insert(ranking.worst, example);
    if (ranking.best.size() > kExamples) ranking.best.pop_back();
    if (ranking.worst.size() > kExamples) ranking.worst.erase(ranking.worst.begin());
  }
}

std::vector<Example> ExampleChooser::choose() const {
  std::vector<Example> chosen;
  for (const std::string& model : plan_.models) {
    const Ranking* highest = nullptr;
    for (std::size_t i = 0; i < conditions_.size(); ++i)
      if (conditions_[i].model == model && (highest == nullptr || rankings_[i].shares > highest->shares))
        highest = &rankings_[i];
    if (highest == nullptr) continue;
    const std::size_t good = std::min(kExamples, (highest->images + 1) / 2);
    const std::size_t bad = std::min(kExamples, highest->images - good);
    for (std::size_t i = 0; i < good; ++i) chosen.push_back(highest->best[i]);
    for (std::size_t i = 0; i < good; ++i) chosen[chosen.size() - 1 - i].best = true;
    chosen.insert(chosen.end(), highest->worst.end() - static_cast<std::ptrdiff_t>(bad),
                  highest->worst.end());
  }
  for (Example& example : chosen)
    example.file = fmt::format("examples/{}_{:06}.jpg", conditions_[example.condition].model, example.frame);
  return chosen;
}

cv::Mat3b draw_example(const Frame& frame, const SaliencyMaps& maps, const std::vector<EvalPoint>& points) {
  Attention shown;
  for (const EvalPoint& point : points) {
    if (shown.fixations.size() == kPoints) break;
    shown.fixations.push_back({.row = point.row, .col = point.col, .position_mm = {}, .proto_object = {}});
  }
  Frame outlined = frame;
  outlined.colour = draw_overlay(frame, maps.master, {}, {.outlines = false, .marks = false, .path = false});
  draw_objects(outlined.colour, frame.truth.labels,
               {points.begin(), points.begin() + static_cast<std::ptrdiff_t>(shown.fixations.size())});
  cv::Mat3b picture = draw_overlay(outlined, maps.master, shown, {.map = {.opacity = 0}, .outlines = false});
  if (picture.cols > kWidth)
    cv::resize(picture, picture, {kWidth, std::max(1, picture.rows * kWidth / picture.cols)}, 0, 0,
               cv::INTER_AREA);
  return picture;
}

void write_examples(const std::vector<Example>& examples, const EvalPlan& plan, FrameSource& source,
                    WorkerPool& pool, const fs::path& folder, const std::function<bool()>& stop) {
  constexpr int kQuality = 88;
  Evaluator evaluator(plan, pool);
  JpegCodec codec;
  Frame frame;
  for (const Example& example : examples) {
    if (stop()) return;
    source.seek(example.frame);
    const ReadResult read = source.read(frame, std::chrono::seconds(1));
    if (read.status != ReadStatus::frame)
      throw unreadable("a frame cannot be read again", fmt::format("frame {}", example.frame),
                       "did the data set change?");
    if (plan.settings.intrinsics) frame.intrinsics = *plan.settings.intrinsics;
    const auto& points = example.result.points;
    std::vector<std::uint8_t> jpeg;
    codec.encode(draw_example(frame, evaluator.compute(frame, example.condition).maps, points), kQuality,
                 jpeg);
    const fs::path path = folder / example.file;
    std::error_code code;
    fs::create_directories(path.parent_path(), code);  // if it fails, writing names the reason
    write_file(path, jpeg);
  }
}

}  // namespace saccade
