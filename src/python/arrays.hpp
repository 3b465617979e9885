#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <opencv2/core.hpp>

namespace saccade::python {

/// The pixels of `image` as a numpy array, H x W or H x W x channels, without a copy: the array shares and
/// keeps them. `image` must own its memory.
[[nodiscard]] pybind11::array to_array(const cv::Mat& image);

/// A depth image, H x W: of uint16 in mm as a converted copy, with 0 for 65535 as in files; of float32 in mm
/// as a view, which is valid as long as `array` lives. Throws pybind11::type_error for another type or
/// anything but an array, pybind11::value_error for another shape, memory with gaps, or a bad value as
/// check_depth(); the text says what was expected.
[[nodiscard]] cv::Mat1f depth_image(const pybind11::object& array);

/// A colour image as a view, H x W x 3 of uint8, BGR. Throws likewise, also if the size is not `size`.
[[nodiscard]] cv::Mat3b colour_image(const pybind11::object& array, cv::Size size);

/// Throws pybind11::value_error if a value is negative or not finite, and names the first one.
void check_depth(const cv::Mat1f& depth);

}  // namespace saccade::python
