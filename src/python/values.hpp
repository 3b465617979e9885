#pragma once

#include <array>
#include <optional>

#include <pybind11/pybind11.h>

#include "python/saliency.hpp"
#include "python/source.hpp"

namespace saccade::python {

/// A frame of a source as Python has it.
struct PythonFrame {
  SourceFrame source_frame;
  FrameOrigin origin;

  const Frame& frame() const { return source_frame.frame; }
};

/// Adds the classes Fixation, Result and Frame, whose members can be read only.
void define_values(pybind11::module_& module);

}  // namespace saccade::python
