#pragma once

#include <filesystem>
#include <memory>

#include "core/frame_source.hpp"
#include "core/input_settings.hpp"

namespace saccade {

/// Opens the labelled data set NYU Depth V2, a MATLAB 7.3 file (HDF5): /depths (m), optionally /images (3
/// colours of 8 bits) and /labels (16-bit classes) with /instances (8 bits, of the class). MATLAB stores H x
/// W x N as N x W x H; each image is read by itself. An object is one instance of one class, numbered in the
/// order of class and instance; 0 in either is no object. Without /instances each class is an object. Depth
/// that is not in 0..10 km is no reading. The camera of 640 x 480 images is the colour camera of the data
/// set's own calibration; that of others is a guess. Throws Error (unreadable): no such file, not HDF5, an
/// array is missing or has another shape.
std::unique_ptr<FrameSource> open_nyu(const std::filesystem::path& file, const InputSettings& settings = {});

}  // namespace saccade
