// The extension module saccade._saccade; package/__init__.pyi has its types, and its texts are the help.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/version.hpp"
#include "python/arrays.hpp"
#include "python/saliency.hpp"
#include "python/source.hpp"
#include "python/values.hpp"

namespace py = pybind11;
using namespace py::literals;

namespace saccade::python {
namespace {

using WithoutGil = py::call_guard<py::gil_scoped_release>;

bool changes_results(const SettingSpec& spec) {
  return spec.scope == SettingScope::model || spec.scope == SettingScope::attention ||
         spec.scope == SettingScope::tracking || spec.key == "workers";
}

bool describes_source(const SettingSpec& spec) {
  if (spec.scope == SettingScope::sensor) return true;
  const auto inputs = input_setting_specs();
  return std::ranges::any_of(inputs, [&](const auto& input) { return input.key == spec.key; });
}

// The settings that keyword arguments name: `length_scale` is the setting length-scale.
Settings read_settings(const py::kwargs& values, bool (*is_accepted)(const SettingSpec&)) {
  Settings settings;
  for (const auto& [name, value] : values) {
    std::string key = py::str(name);
    std::ranges::replace(key, '_', '-');
    if (!is_accepted(setting_spec(key)))
      throw usage_error("this setting has no effect here", key, "see help(saccade)");
    const std::string text = py::isinstance<py::bool_>(value) ? (value.cast<bool>() ? "true" : "false")
                                                              : std::string(py::str(value));
    apply_setting(settings, key, text);
  }
  return settings;
}

// (fx, fy, cx, cy), or None.
std::optional<Intrinsics> read_camera(const py::object& camera) {
  if (camera.is_none()) return std::nullopt;
  Intrinsics intrinsics;
  try {
    const auto v = camera.cast<std::array<double, 4>>();
    intrinsics = {v[0], v[1], v[2], v[3], IntrinsicsOrigin::option};
  } catch (const py::cast_error&) {
    intrinsics = {};  // not valid
  }
  if (!intrinsics.valid())
    throw py::value_error("camera must be (fx, fy, cx, cy) in pixels, with fx and fy above 0");
  return intrinsics;
}

FrameResult compute_without_gil(Saliency& saliency, const Frame& frame, const FrameOrigin& origin) {
  const py::gil_scoped_release release;
  return saliency.compute(frame, origin);
}

FrameResult compute_frame(Saliency& saliency, const PythonFrame& frame) {
  check_depth(frame.frame().depth_mm);  // its user may have written to the array
  return compute_without_gil(saliency, frame.frame(), frame.origin);
}

FrameResult compute_arrays(Saliency& saliency, const py::object& depth, const py::object& colour,
                           const py::object& camera, std::optional<std::int64_t> timestamp_us) {
  if (timestamp_us && *timestamp_us < 0) throw py::value_error("timestamp_us must not be negative");
  Frame frame;
  frame.index = -1;  // the next one
  frame.timestamp_us = timestamp_us.value_or(-1);
  frame.depth_mm = depth_image(depth);
  if (!colour.is_none()) frame.colour = colour_image(colour, frame.size());
  frame.intrinsics = read_camera(camera).value_or(Intrinsics::guess_for(frame.size()));
  return compute_without_gil(saliency, frame, {});
}

std::unique_ptr<Source> open(const py::object& source, std::int64_t start, std::int64_t every,
                             std::int64_t frames, const py::object& camera, const py::kwargs& options) {
  if (start < 0 || every < 1 || frames < 0)
    throw py::value_error("start and frames must be at least 0, every at least 1");
  const FrameSettings selection{start, every, frames, read_camera(camera)};
  const auto uri = py::module_::import("os").attr("fsdecode")(source).cast<std::string>();
  const Settings settings = read_settings(options, describes_source);
  const py::gil_scoped_release release;
  return std::make_unique<Source>(uri, selection, SourceOptions{settings.sensor, settings});
}

PythonFrame next_frame(Source& source) {
  auto frame = source.next();
  if (!frame) throw py::stop_iteration();
  return {std::move(*frame), {source.info().has_depth, source.info().sequence}};
}

std::int64_t frame_count(const Source& source) {
  const auto count = source.frame_count();
  if (!count) throw py::type_error("this source does not know how many frames there will be");
  return *count;
}

void define_source(py::module_& module) {
  py::class_<Source>(module, "Source", "A source that gives its frames when it is iterated.")
      .def("__iter__", [](py::object self) { return self; })
      .def("__next__", &next_frame)
      .def("__len__", &frame_count)
      .def("__enter__", [](py::object self) { return self; })
      .def("__exit__", [](Source& source, const py::args&) { source.close(); })
      .def("close", &Source::close, "Releases the file or sensor.")
      .def_property_readonly(
          "uri", [](const Source& s) { return s.info().uri; }, "As it was named.")
      .def_property_readonly(
          "kind", [](const Source& s) { return s.info().kind; }, "Such as 'oni', 'folder', 'openni2'.")
      .def_property_readonly(
          "live", [](const Source& s) { return s.info().live; }, "Whether it is a sensor.")
      .def_property_readonly(
          "sequence", [](const Source& s) { return s.info().sequence; },
          "Whether each frame shows the scene of the one before it a moment later.")
      .def_property_readonly(
          "notes", [](const Source& s) { return s.info().notes; }, "Gaps and guesses, a line each.")
      .def_property_readonly("rejected", &Source::rejected,
                             "(index, reason) of each frame that could not be used.");
  module.def(
      "open", &open, "source"_a, py::kw_only(), "start"_a = 0, "every"_a = 1, "frames"_a = 0,
      "camera"_a = py::none(),
      "Opens a recording, a folder, a data set, a sensor or a synthetic scene, as SOURCE of `saccade\n"
      "run`.\n\n"
      "start, every, frames: which frames to give; frames = 0: all. camera: (fx, fy, cx, cy) instead of\n"
      "the source's. Other keyword arguments are the settings depth_unit and topics, and those of a live\n"
      "sensor.");
}

void define_saliency(py::module_& module) {
  py::class_<Saliency>(
      module, "Saliency",
      "A model with attention. Keyword arguments are settings of `saccade run`, with _ for -:\n"
      "model, kernel, levels, length_scale, selector, fixations, tracking, workers, ...\n"
      "level_maps, normals: also give these of each frame.")
      .def(py::init([](bool level_maps, bool normals, const py::kwargs& settings) {
             return std::make_unique<Saliency>(read_settings(settings, changes_results),
                                               RequestedOutputs{level_maps, normals});
           }),
           py::kw_only(), "level_maps"_a = false, "normals"_a = false)
      .def("compute", &compute_arrays, "depth"_a, "colour"_a = py::none(), py::kw_only(),
           "camera"_a = py::none(), "timestamp_us"_a = py::none(),
           "Map and fixations of a depth image, (H, W) of uint16 or float32, in mm, 0 = no reading.\n\n"
           "colour: (H, W, 3) of uint8, BGR. camera: (fx, fy, cx, cy) in pixels; without it, a guess.\n"
           "With tracking='on' each image follows the last one, at timestamp_us or 1/30 s later.\n"
           "Other threads run meanwhile; calls for one object wait for one another.")
      .def("compute", &compute_frame, "frame"_a,
           "Map and fixations of a frame of saccade.open(). Frames of a sequence are followed over time\n"
           "(objects keep their ids) unless tracking='off'.",
           py::prepend())
      .def("reset", &Saliency::reset, WithoutGil(),
           "Forgets the frames so far: the next one begins a sequence.");
}

void define_error(py::module_& module) {
  static const py::exception<Error> error_type(module, "Error", PyExc_RuntimeError);
  error_type.attr("__doc__") = "Something that cannot be read or computed; the text says what to try.";
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      if (pointer) std::rethrow_exception(std::move(pointer));
    } catch (const Error& error) {
      PyErr_SetString(error.status() == ExitStatus::usage ? PyExc_ValueError : error_type.ptr(),
                      error.what());
    }
  });
}

}  // namespace

PYBIND11_MODULE(_saccade, module) {
  module.attr("__version__") = kVersion;
  define_error(module);
  define_values(module);
  define_source(module);
  define_saliency(module);
}

}  // namespace saccade::python
