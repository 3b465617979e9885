#include "python/values.hpp"

#include <pybind11/stl.h>

#include <fmt/format.h>

#include "python/arrays.hpp"

namespace saccade::python {
namespace py = pybind11;
namespace {

py::tuple triple(const cv::Point3f& p) { return py::make_tuple(p.x, p.y, p.z); }

py::object optional_array(const cv::Mat& image) {
  return image.empty() ? py::object(py::none()) : py::object(to_array(image));
}

std::optional<int> optional_id(const Fixation& f) { return f.id > 0 ? std::optional(f.id) : std::nullopt; }

std::string fixation_text(const Fixation& f) {
  return fmt::format("<Fixation {}row={} col={} saliency={:.4g} z={:.0f} mm>",
                     f.id > 0 ? fmt::format("id={} ", f.id) : "", f.row, f.col, f.saliency, f.position_mm.z);
}

void define_fixation(py::module_& module) {
  py::class_<Fixation>(module, "Fixation", "One attention point.")
      .def_readonly("row", &Fixation::row, "Of the pixel, from the top, from 0.")
      .def_readonly("col", &Fixation::col, "Of the pixel, from the left, from 0.")
      .def_readonly("saliency", &Fixation::saliency,
                    "The map at that pixel; in a sequence, that of its object.")
      .def_property_readonly(
          "position_mm", [](const Fixation& f) { return triple(f.position_mm); },
          "(x, y, z) in camera frame: right, down, forward; (0, 0, 0) = no reading there.")
      .def_readonly("confidence", &Fixation::confidence,
                    "Probability that the point lies on an object; None for the selector wta.")
      .def_property_readonly(
          "id", &optional_id,
          "Number of the object, the same in all frames of a sequence; None for single frames.")
      .def_readonly("age_frames", &Fixation::age_frames,
                    "In how many frames of the sequence the object has been seen; 0 for single frames.")
      .def_property_readonly(
          "world_mm",
          [](const Fixation& f) {
            return f.id > 0 ? py::object(triple(f.world_mm)) : py::object(py::none());
          },
          "The point in the world of Result.camera_to_world; None for single frames.")
      .def_property_readonly(
          "pixels", [](const Fixation& f) { return f.proto_object.pixels; },
          "Size of the object's mask; 0 = the selector grew none.")
      .def_property_readonly(
          "centroid_mm", [](const Fixation& f) { return triple(f.proto_object.centroid_mm); },
          "Mean of the object's points, camera frame.")
      .def_property_readonly(
          "extent_mm", [](const Fixation& f) { return triple(f.proto_object.extent_mm); },
          "Sides of the object's box, parallel to the axes of the camera.")
      .def("__repr__", &fixation_text);
}

py::list level_maps(const FrameResult& result) {
  py::list list;
  for (const cv::Mat1f& level : result.maps.levels) list.append(to_array(level));
  return list;
}

std::optional<int> gaze(const FrameResult& result) {
  return result.attention.sequence ? result.attention.sequence->gaze : std::nullopt;
}

bool is_cut(const FrameResult& result) { return result.attention.sequence && result.attention.sequence->cut; }

// A 4 x 4 matrix, or None.
py::object camera_to_world(const FrameResult& result) {
  if (!result.attention.sequence) return py::none();
  return py::array_t<double>({4, 4}, result.attention.sequence->camera_to_world.matrix.val);
}

void define_result(py::module_& module) {
  py::class_<FrameResult>(module, "Result", "What was computed for one frame. Its images are not copied.")
      .def_property_readonly(
          "map", [](const FrameResult& r) { return to_array(r.maps.master); },
          "Saliency, (H, W) of float32, >= 0.")
      .def_property_readonly("level_maps", &level_maps,
                             "The map of each level at its own size, if requested.")
      .def_property_readonly(
          "normals", [](const FrameResult& r) { return optional_array(r.maps.normals); },
          "Unit normals, (H, W, 3) of float32, 0 = none, if requested; else None.")
      .def_property_readonly(
          "masks", [](const FrameResult& r) { return to_array(r.attention.masks); },
          "(H, W) of uint16: rank of the fixation whose object holds the pixel, 0 = none.")
      .def_property_readonly(
          "fixations", [](const FrameResult& r) { return r.attention.fixations; }, "Most salient first.")
      .def_property_readonly(
          "ended_early", [](const FrameResult& r) { return r.attention.ended_early; },
          "Why there are fewer fixations than requested; empty = there are not.")
      .def_property_readonly(
          "gaze", &gaze, "id of the object that is looked at; None if there is none, or for single frames.")
      .def_property_readonly(
          "cut", &is_cut,
          "Whether nothing links the frame to those before it, so that the memory began again.")
      .def_property_readonly(
          "camera_to_world", &camera_to_world,
          "4 x 4, mm; the world is the camera of the first frame, or of the first after a cut. None for\n"
          "single frames.");
}

std::array<double, 4> camera_of(const PythonFrame& f) {
  const Intrinsics& camera = f.frame().intrinsics;
  return {camera.fx, camera.fy, camera.cx, camera.cy};
}

void define_frame(py::module_& module) {
  py::class_<PythonFrame>(module, "Frame", "One frame of a source. Its images are not copied.")
      .def_property_readonly(
          "index", [](const PythonFrame& f) { return f.frame().index; }, "Position in the source, from 0.")
      .def_property_readonly(
          "timestamp_us", [](const PythonFrame& f) { return f.frame().timestamp_us; },
          "Of the sensor or the recording; 30 frames a second where there are no times.")
      .def_property_readonly(
          "name", [](const PythonFrame& f) { return f.frame().name; }, "Such as the file's; may be empty.")
      .def_property_readonly(
          "depth", [](const PythonFrame& f) { return to_array(f.frame().depth_mm); },
          "(H, W) of float32, mm, 0 = no reading.")
      .def_property_readonly(
          "colour", [](const PythonFrame& f) { return optional_array(f.frame().colour); },
          "(H, W, 3) of uint8, BGR; None if there is none.")
      .def_property_readonly(
          "labels", [](const PythonFrame& f) { return optional_array(f.frame().truth.labels); },
          "(H, W) of uint16, 0 = no object; None if they are not known.")
      .def_property_readonly("camera", &camera_of, "(fx, fy, cx, cy) in pixels.")
      .def_property_readonly(
          "problem", [](const PythonFrame& f) { return f.source_frame.problem; },
          "Why its colour or labels are missing; empty = they are not.");
}

}  // namespace

void define_values(py::module_& module) {
  define_fixation(module);
  define_result(module);
  define_frame(module);
}

}  // namespace saccade::python
