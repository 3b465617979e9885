#include "python/arrays.hpp"

#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/image_size.hpp"

namespace saccade::python {
namespace py = pybind11;
namespace {

py::dtype dtype_of(int depth) {
  switch (depth) {
    case CV_8U:
      return py::dtype::of<std::uint8_t>();
    case CV_16U:
      return py::dtype::of<std::uint16_t>();
    default:
      return py::dtype::of<float>();
  }
}

std::string text_of(const py::handle& object) { return py::str(object); }

std::string shape_text(const py::array& array) { return text_of(array.attr("shape")); }

// The checks that all images share: an array of a type that is_type() accepts, `wanted` in words, whose
// pixels lie in one piece of memory.
py::array image_array(const py::object& object, const std::string& name, const std::string& wanted,
                      bool (*is_type)(const py::array&)) {
  if (!py::isinstance<py::array>(object))
    throw py::type_error(fmt::format("{} must be a numpy array ({}), not {}", name, wanted,
                                     text_of(py::type::of(object).attr("__name__"))));
  auto array = py::reinterpret_borrow<py::array>(object);
  if (py::isinstance(array, py::module_::import("numpy.ma").attr("MaskedArray")))
    throw py::type_error(fmt::format("{} is a masked array; pass {}.filled(0)", name, name));
  if (!is_type(array))
    throw py::type_error(fmt::format("{} must be {}, not {}", name, wanted, text_of(array.dtype())));
  const bool is_contiguous = (array.flags() & py::array::c_style) != 0;
  if (!is_contiguous || !array.attr("flags").attr("aligned").cast<bool>())
    throw py::value_error(
        fmt::format("{} is not contiguous and aligned in memory; pass {}.copy()", name, name));
  if (array.size() == 0) throw py::value_error(name + " is empty");
  return array;
}

bool is_depth(const py::array& array) {
  return py::isinstance<py::array_t<float>>(array) || py::isinstance<py::array_t<std::uint16_t>>(array);
}

bool is_bytes(const py::array& array) { return py::isinstance<py::array_t<std::uint8_t>>(array); }

bool is_good(float depth) { return depth >= 0 && depth <= std::numeric_limits<float>::max(); }

}  // namespace

py::array to_array(const cv::Mat& image) {
  auto owner = std::make_unique<cv::Mat>(image);
  const py::capsule base(owner.get(), [](void* mat) { delete static_cast<cv::Mat*>(mat); });
  const cv::Mat& kept = *owner.release();
  std::vector<py::ssize_t> shape = {kept.rows, kept.cols};
  std::vector<py::ssize_t> strides = {static_cast<py::ssize_t>(kept.step[0]),
                                      static_cast<py::ssize_t>(kept.elemSize())};
  if (kept.channels() > 1) {
    shape.push_back(kept.channels());
    strides.push_back(static_cast<py::ssize_t>(kept.elemSize1()));
  }
  return {dtype_of(kept.depth()), shape, strides, kept.data, base};
}

cv::Mat1f depth_image(const py::object& object) {
  const py::array array = image_array(object, "depth", "of dtype uint16 or float32, in mm", is_depth);
  if (array.ndim() != 2)
    throw py::value_error("depth must have the shape (height, width), not " + shape_text(array));
  try {
    check_image_size(array.shape(1), array.shape(0));
  } catch (const std::runtime_error& error) {
    throw py::value_error(std::string("depth is too large: ") + error.what());
  }
  const int rows = static_cast<int>(array.shape(0)), cols = static_cast<int>(array.shape(1));
  void* pixels = const_cast<void*>(array.data());  // read only: cv::Mat has no other way to view them
  if (py::isinstance<py::array_t<float>>(array)) {
    cv::Mat1f view(rows, cols, static_cast<float*>(pixels));
    check_depth(view);
    return view;
  }
  constexpr std::uint16_t kNoReading = 65535;
  const cv::Mat1w stored(rows, cols, static_cast<std::uint16_t*>(pixels));
  cv::Mat1f depth;
  stored.convertTo(depth, CV_32F);
  depth.setTo(0, stored == kNoReading);
  return depth;
}

cv::Mat3b colour_image(const py::object& object, cv::Size size) {
  const py::array array = image_array(object, "colour", "of dtype uint8, in the order BGR", is_bytes);
  if (array.ndim() != 3 || array.shape(0) != size.height || array.shape(1) != size.width ||
      array.shape(2) != 3)
    throw py::value_error(fmt::format("colour must have the shape ({}, {}, 3) of the depth, not {}",
                                      size.height, size.width, shape_text(array)));
  return {size.height, size.width, static_cast<cv::Vec3b*>(const_cast<void*>(array.data()))};
}

void check_depth(const cv::Mat1f& depth) {
  for (int row = 0; row < depth.rows; ++row)
    for (int col = 0; col < depth.cols; ++col)
      if (!is_good(depth(row, col)))
        throw py::value_error(
            fmt::format("depth has the value {} at row {}, column {}; where there is no reading it must be 0 "
                        "(numpy.nan_to_num(depth, nan=0, posinf=0, neginf=0))",
                        depth(row, col), row, col));
}

}  // namespace saccade::python
