#include "displays.hpp"

#include <cmath>
#include <numbers>

#include <opencv2/imgproc.hpp>

namespace saccade {

ModelSettings settings_for(const std::string& model, int last_level) {
  ModelSettings settings;
  settings.model = model;
  settings.last_level = last_level;
  return settings;
}

Frame frame_of(const cv::Mat3b& colour) {
  Frame frame;
  frame.colour = colour;
  frame.depth_mm = cv::Mat1f(colour.size(), 0.0F);
  frame.intrinsics = Intrinsics::guess_for(colour.size());
  return frame;
}

cv::Mat1f map_of(const std::string& model, const Frame& frame, int workers, int last_level) {
  WorkerPool pool(workers);
  SaliencyMaps maps;
  StageTimes times;
  make_model(settings_for(model, last_level), pool)->compute(frame, {}, maps, times);
  return maps.master;
}

cv::Mat3b noise_image(cv::Size size, int seed) {
  cv::Mat3b image(size);
  cv::RNG random(static_cast<std::uint64_t>(seed));
  random.fill(image, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(image, image, {5, 5}, 1);
  return image;
}

cv::Mat3b BarDisplay::draw() const {
  cv::Mat3b image(size, cv::Vec3b(60, 60, 60));
  for (int i = 0; i * spacing < size.height; ++i)
    for (int j = 0; j * spacing < size.width; ++j) {
      const bool odd = i == odd_row && j == odd_col;
      const double angle = (odd ? odd_angle_deg : angle_deg) * std::numbers::pi / 180, half = spacing * 0.3;
      const cv::Point2d middle((j + 0.5) * spacing, (i + 0.5) * spacing);
      const cv::Point2d reach(half * std::cos(angle), half * std::sin(angle));
      cv::line(image, middle - reach, middle + reach, odd ? odd_colour : colour, spacing / 10, cv::LINE_AA);
    }
  return image;
}

double BarDisplay::miss(const cv::Mat1f& map) const {
  const cv::Point at = maximum_of(map);
  return std::hypot(at.x - (odd_col + 0.5) * spacing, at.y - (odd_row + 0.5) * spacing);
}

cv::Mat1d as_double(const cv::Mat& image, double scale) {
  cv::Mat1d out;
  image.convertTo(out, CV_64F, scale);
  return out;
}

cv::Point maximum_of(const cv::Mat1f& map) {
  cv::Point at;
  cv::minMaxLoc(map, nullptr, nullptr, nullptr, &at);
  return at;
}

}  // namespace saccade
