#include "eval/contact_sheet.hpp"

#include <algorithm>
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

std::vector<Example> ranked(const EvalPlan& plan, const std::vector<ImageResult>& images,
                            std::size_t condition) {
  std::vector<Example> all;
  for (const ImageResult& image : images)
    if (!image.left_out && image.objects > 0)
      all.push_back({condition, &image, share_of_bound(plan, image, condition), false, ""});
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.share > b.share; });
  return all;
}

double sum_of_shares(const std::vector<Example>& examples) {
  double sum = 0;
  for (const Example& example : examples) sum += example.share;
  return sum;
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

std::vector<Example> choose_examples(const EvalPlan& plan, const std::vector<ImageResult>& images) {
  const auto conditions = plan.conditions();
  std::vector<Example> chosen;
  for (const std::string& model : plan.models) {
    std::vector<Example> best;
    for (std::size_t i = 0; i < conditions.size(); ++i) {
      if (conditions[i].model != model) continue;
      std::vector<Example> all = ranked(plan, images, i);
      if (best.empty() || sum_of_shares(all) > sum_of_shares(best)) best = std::move(all);
    }
    const std::size_t good = std::min(kExamples, (best.size() + 1) / 2);
    const std::size_t bad = std::min(kExamples, best.size() - good);
    for (std::size_t i = 0; i < best.size(); ++i) {
      if (i >= good && i < best.size() - bad) continue;
      best[i].best = i < good;
      best[i].file = fmt::format("examples/{}_{:06}.jpg", model, best[i].image->frame);
      chosen.push_back(best[i]);
    }
  }
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
    source.seek(example.image->frame);
    const ReadResult read = source.read(frame, std::chrono::seconds(1));
    if (read.status != ReadStatus::frame)
      throw unreadable("a frame cannot be read again", fmt::format("frame {}", example.image->frame),
                       "did the data set change?");
    if (plan.settings.intrinsics) frame.intrinsics = *plan.settings.intrinsics;
    const auto& points = example.image->conditions[example.condition].points;
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
