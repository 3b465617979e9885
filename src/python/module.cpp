// The extension module saccade._saccade; saccade/__init__.pyi has its types, and its texts are the help.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/version.hpp"
#include "python/arrays.hpp"
#include "python/saliency.hpp"
#include "python/source.hpp"

namespace py = pybind11;
using namespace py::literals;

namespace saccade::python {
namespace {

// A frame as Python has it: also whether its source has depth.
struct PythonFrame {
  Frame frame;
  bool has_depth = true;
};

// The settings that keyword arguments name: `length_scale` is the setting length-scale.
Settings read_settings(const py::kwargs& values, std::initializer_list<SettingScope> scopes) {
  Settings settings;
  for (const auto& [name, value] : values) {
    std::string key = py::str(name);
    std::ranges::replace(key, '_', '-');
    if (std::ranges::count(scopes, setting_spec(key).scope) == 0)
      throw usage_error("this setting has no effect here", key, "see help(saccade)");
    const std::string text = py::isinstance<py::bool_>(value) ? (value.cast<bool>() ? "true" : "false")
                                                              : std::string(py::str(value));
    apply_setting(settings, key, text);
  }
  return settings;
}

Intrinsics read_camera(const std::array<double, 4>& camera) {
  const Intrinsics intrinsics{camera[0], camera[1], camera[2], camera[3], IntrinsicsOrigin::option};
  if (!intrinsics.valid())
    throw py::value_error("camera must be (fx, fy, cx, cy) in pixels, with fx and fy above 0");
  return intrinsics;
}

using Camera = std::optional<std::array<double, 4>>;

std::array<double, 4> camera_of(const Frame& frame) {
  const Intrinsics& camera = frame.intrinsics;
  return {camera.fx, camera.fy, camera.cx, camera.cy};
}

py::tuple triple(const cv::Point3f& p) { return py::make_tuple(p.x, p.y, p.z); }

py::object optional_array(const cv::Mat& image) {
  return image.empty() ? py::object(py::none()) : py::object(to_array(image));
}

FrameResult compute_without_gil(Saliency& saliency, const Frame& frame, bool has_depth,
                                RequestedOutputs outputs) {
  const py::gil_scoped_release release;
  return saliency.compute(frame, has_depth, outputs);
}

FrameResult compute_arrays(Saliency& saliency, const py::object& depth, const py::object& colour,
                           const Camera& camera, bool level_maps, bool normals) {
  Frame frame;
  frame.depth_mm = depth_image(depth);
  if (!colour.is_none()) frame.colour = colour_image(colour, frame.size());
  frame.intrinsics = camera ? read_camera(*camera) : Intrinsics::guess_for(frame.size());
  return compute_without_gil(saliency, frame, true, {level_maps, normals});
}

void define_results(py::module_& module) {
  py::class_<Fixation>(module, "Fixation", "One attention point.")
      .def_readonly("row", &Fixation::row)
      .def_readonly("col", &Fixation::col)
      .def_readonly("saliency", &Fixation::saliency, "The map at that pixel.")
      .def_property_readonly(
          "position_mm", [](const Fixation& f) { return triple(f.position_mm); },
          "(x, y, z) in camera frame: right, down, forward; (0, 0, 0) = no reading there.")
      .def_property_readonly(
          "pixels", [](const Fixation& f) { return f.proto_object.pixels; },
          "Size of the object's mask; 0 = the selector grew none.")
      .def_property_readonly("centroid_mm",
                             [](const Fixation& f) { return triple(f.proto_object.centroid_mm); })
      .def_property_readonly("extent_mm", [](const Fixation& f) { return triple(f.proto_object.extent_mm); })
      .def("__repr__", [](const Fixation& f) {
        return fmt::format("<Fixation row={} col={} saliency={:.4g} z={:.0f} mm>", f.row, f.col, f.saliency,
                           f.position_mm.z);
      });
  py::class_<FrameResult>(module, "Result", "What was computed for one frame. Its arrays are not copied.")
      .def_property_readonly(
          "map", [](const FrameResult& r) { return to_array(r.maps.master); },
          "Saliency, (H, W) of float32, >= 0.")
      .def_property_readonly(
          "level_maps",
          [](const FrameResult& r) {
            py::list list;
            for (const cv::Mat1f& level : r.maps.levels) list.append(to_array(level));
            return list;
          },
          "The map of each level at its own size, if requested.")
      .def_property_readonly(
          "normals", [](const FrameResult& r) { return optional_array(r.maps.normals); },
          "Unit normals (H, W, 3) of float32, 0 = none, if requested; else None.")
      .def_property_readonly(
          "masks", [](const FrameResult& r) { return to_array(r.attention.masks); },
          "(H, W) of uint16: rank of the fixation whose object holds the pixel, 0 = none.")
      .def_property_readonly(
          "fixations", [](const FrameResult& r) { return r.attention.fixations; }, "Most salient first.")
      .def_property_readonly(
          "ended_early", [](const FrameResult& r) { return r.attention.ended_early; },
          "Why there are fewer fixations than requested; empty = there are not.");
}

void define_frames(py::module_& module) {
  py::class_<PythonFrame>(module, "Frame", "One frame of a source. Its arrays are not copied.")
      .def_property_readonly(
          "index", [](const PythonFrame& f) { return f.frame.index; }, "Position in the source, from 0.")
      .def_property_readonly("timestamp_us", [](const PythonFrame& f) { return f.frame.timestamp_us; })
      .def_property_readonly("name", [](const PythonFrame& f) { return f.frame.name; })
      .def_property_readonly(
          "depth", [](const PythonFrame& f) { return to_array(f.frame.depth_mm); },
          "(H, W) of float32, mm, 0 = no reading.")
      .def_property_readonly(
          "colour", [](const PythonFrame& f) { return optional_array(f.frame.colour); },
          "(H, W, 3) of uint8, BGR; None if there is none.")
      .def_property_readonly(
          "labels", [](const PythonFrame& f) { return optional_array(f.frame.truth.labels); },
          "(H, W) of uint16, 0 = no object; None if they are not known.")
      .def_property_readonly(
          "camera", [](const PythonFrame& f) { return camera_of(f.frame); }, "(fx, fy, cx, cy) in pixels.");
  py::class_<Source>(module, "Source", "A source that gives its frames when it is iterated.")
      .def("__iter__", [](py::object self) { return self; })
      .def("__next__",
           [](Source& source) {
             auto frame = source.next();
             if (!frame) throw py::stop_iteration();
             return PythonFrame{std::move(*frame), source.info().has_depth};
           })
      .def("__len__",
           [](const Source& source) {
             const auto count = source.frame_count();
             if (!count) throw py::type_error("this source does not know how many frames there will be");
             return *count;
           })
      .def_property_readonly("uri", [](const Source& s) { return s.info().uri; })
      .def_property_readonly("kind", [](const Source& s) { return s.info().kind; })
      .def_property_readonly("live", [](const Source& s) { return s.info().live; })
      .def_property_readonly(
          "notes", [](const Source& s) { return s.info().notes; }, "Gaps and guesses, a line each.")
      .def_property_readonly("rejected", &Source::rejected,
                             "(index, reason) of each frame that could not be used.");
  module.def(
      "open",
      [](const std::string& source, std::int64_t start, std::int64_t every, std::int64_t frames,
         const Camera& camera, const py::kwargs& sensor) {
        if (start < 0 || every < 1 || frames < 0)
          throw py::value_error("start and frames must be at least 0, every at least 1");
        FrameSettings selection{start, every, frames};
        if (camera) selection.intrinsics = read_camera(*camera);
        return Source(source, selection, read_settings(sensor, {SettingScope::sensor}).sensor);
      },
      "source"_a, py::kw_only(), "start"_a = 0, "every"_a = 1, "frames"_a = 0, "camera"_a = py::none(),
      "Opens a recording, a folder, a data set, a sensor or a synthetic scene, as SOURCE of `saccade "
      "run`.\n\n"
      "start, every, frames: which frames to give; frames = 0: all. camera: (fx, fy, cx, cy) instead of the\n"
      "source's. Other keyword arguments are settings of a live sensor.");
}

}  // namespace

PYBIND11_MODULE(_saccade, module) {
  cv::setNumThreads(1);  // OpenCV must not start threads besides ours
  module.attr("__version__") = kVersion;
  static const py::exception<Error> error_type(module, "Error", PyExc_RuntimeError);
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      if (pointer) std::rethrow_exception(pointer);
    } catch (const Error& error) {
      PyErr_SetString(error.status() == ExitStatus::usage ? PyExc_ValueError : error_type.ptr(),
                      error.what());
    }
  });
  define_results(module);
  define_frames(module);
  py::class_<Saliency>(
      module, "Saliency",
      "A model and a selector. Keyword arguments are settings of `saccade run`, with _ for -:\n"
      "model, kernel, levels, length_scale, selector, fixations, workers, ...")
      .def(py::init([](const py::kwargs& settings) {
        return std::make_unique<Saliency>(
            read_settings(settings, {SettingScope::model, SettingScope::attention, SettingScope::program}));
      }))
      .def("compute", &compute_arrays, "depth"_a, "colour"_a = py::none(), py::kw_only(),
           "camera"_a = py::none(), "level_maps"_a = false, "normals"_a = false,
           "Map and fixations of a depth image, (H, W) of uint16 or float32, in mm, 0 = no reading.\n\n"
           "colour: (H, W, 3) of uint8, BGR. camera: (fx, fy, cx, cy) in pixels; without it, a guess.\n"
           "Other threads run meanwhile; calls for one object wait for one another.")
      .def(
          "compute",
          [](Saliency& saliency, const PythonFrame& frame, bool level_maps, bool normals) {
            return compute_without_gil(saliency, frame.frame, frame.has_depth, {level_maps, normals});
          },
          "frame"_a, py::kw_only(), "level_maps"_a = false, "normals"_a = false,
          "Map and fixations of a frame of saccade.open().", py::prepend());
}

}  // namespace saccade::python
