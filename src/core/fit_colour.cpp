#include "core/fit_colour.hpp"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

namespace saccade {

void fit_colour(const cv::Mat& image, cv::Size size, cv::Mat3b& colour) {
  if (image.size() == size)
    image.copyTo(colour);
  else
    cv::resize(image, colour, size, 0, 0,
               image.size().area() > size.area() ? cv::INTER_AREA : cv::INTER_LINEAR);
}

std::string fitted_colour_note(cv::Size image, cv::Size depth) {
  return fmt::format("colour of {} x {} is scaled to the depth's {} x {}", image.width, image.height,
                     depth.width, depth.height);
}

}  // namespace saccade
