// The format is described on the pages "Azure Kinect DK: record file format" of its maker; the calibration
// holds what the firmware gives: focal lengths and centres as shares of the whole sensor's image, with (0, 0)
// in the corner of the first pixel, and lengths in metres.
#include "sources/azure_recording.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"

namespace saccade {
namespace {

using Json = nlohmann::json;

constexpr const char* kInfrared = "IR";
constexpr std::size_t kLargestCalibration = 1u << 20;  // bytes

// An image as a part of the sensor's image, which was reduced to `whole` before.
struct Cut {
  cv::Size whole;
  cv::Point corner;
};

Cut cut_of_depth(cv::Size size) {
  struct Mode {
    cv::Size size;
    Cut cut;
  };
  static const std::array<Mode, 4> kModes = {{
      {{640, 576}, {{1024, 1024}, {192, 180}}},  // narrow view
      {{320, 288}, {{512, 512}, {96, 90}}},      // narrow view, binned
      {{512, 512}, {{512, 512}, {0, 0}}},        // wide view, binned
      {{1024, 1024}, {{1024, 1024}, {0, 0}}},    // wide view
  }};
  const auto mode = std::ranges::find(kModes, size, &Mode::size);
  if (mode == kModes.end())
    throw std::runtime_error(
        fmt::format("no mode of the depth camera has {}x{} pixels", size.width, size.height));
  return mode->cut;
}

// The sensor is 4:3; images of 16:9 are the middle of it.
Cut cut_of_colour(cv::Size size) {
  const cv::Size whole(size.width, size.width * 3 / 4);
  if (size.height > whole.height)
    throw std::runtime_error(
        fmt::format("no mode of the colour camera has {}x{} pixels", size.width, size.height));
  return {whole, {0, (whole.height - size.height) / 2}};
}

// Numbers of a JSON list, all finite.
template <std::size_t N>
std::array<double, N> numbers(const Json& list, const char* what) {
  std::array<double, N> result{};
  if (!list.is_array() || list.size() < N) throw std::runtime_error(fmt::format("no {}", what));
  for (std::size_t i = 0; i < N; ++i) {
    if (!list[i].is_number()) throw std::runtime_error(fmt::format("{} that is not a number", what));
    result[i] = list[i].get<double>();
    if (!(std::abs(result[i]) < 1e6)) throw std::runtime_error(fmt::format("{} out of range", what));
  }
  return result;
}

const Json& find_camera(const Json& calibration, std::string_view location) {
  for (const Json& camera : calibration.at("CalibrationInformation").at("Cameras"))
    if (camera.at("Location").get<std::string>() == location) return camera;
  throw std::runtime_error(fmt::format("no camera {}", location));
}

// A side of a sensor in pixels. Any other number could not be converted to int.
int sensor_side(const Json& camera, const char* key) {
  const Json& side = camera.at(key);
  if (!side.is_number_integer() || side < 1 || side > 65536)
    throw std::runtime_error(fmt::format("{} that is not an integer from 1 to 65536", key));
  return side.get<int>();
}

LensCamera lens_camera(const Json& camera, cv::Size size, const Cut& cut) {
  const Json& intrinsics = camera.at("Intrinsics");
  const auto [cx, cy, fx, fy, k1, k2, k3, k4, k5, k6, unused1, unused2, p2, p1] =
      numbers<14>(intrinsics.at("ModelParameters"), "parameter of a camera");
  const int width = sensor_side(camera, "SensorWidth"), height = sensor_side(camera, "SensorHeight");
  // Early devices were calibrated for the 16:9 middle of a 4:3 sensor.
  const bool middle_only = width * 9 == height * 16;
  const double share = middle_only ? 0.75 : 1, above = middle_only ? 0.125 : 0;
  LensCamera result;
  result.size = size;
  result.pinhole = {fx * cut.whole.width, fy * share * cut.whole.height,
                    cx * cut.whole.width - cut.corner.x - 0.5,
                    (cy * share + above) * cut.whole.height - cut.corner.y - 0.5, IntrinsicsOrigin::file};
  result.distortion = {k1, k2, p1, p2, k3, k4, k5, k6};
  if (!result.pinhole.valid()) throw std::runtime_error("focal lengths that are not above 0");
  return result;
}

}  // namespace

AzureCalibration::AzureCalibration(std::string_view json, cv::Size depth_size, cv::Size colour_size) try {
  if (json.size() > kLargestCalibration) throw std::runtime_error("too long");
  // The firmware ends the text with a zero.
  const Json calibration = Json::parse(json.substr(0, json.find('\0')));
  const Json& depth_camera = find_camera(calibration, "CALIBRATION_CameraLocationD0");
  depth = lens_camera(depth_camera, depth_size, cut_of_depth(depth_size));
  const Json& colour_camera = find_camera(calibration, "CALIBRATION_CameraLocationPV0");
  colour = lens_camera(colour_camera, colour_size, cut_of_colour(colour_size));
  rotation = cv::Matx33d(numbers<9>(colour_camera.at("Rt").at("Rotation"), "rotation").data());
  const auto metres = numbers<3>(colour_camera.at("Rt").at("Translation"), "translation");
  translation_mm = 1000 * cv::Vec3d(metres.data());
} catch (const Json::exception&) {
  throw std::runtime_error("not the JSON of a calibration");
}

std::optional<AzureRecording> read_azure_recording(VideoFile& file) {
  const auto titles = file.titles();
  const auto has = [&](const char* title) { return std::ranges::count(titles, title) > 0; };
  if (!has(kAzureDepth)) {
    if (!has(kInfrared)) return std::nullopt;
    throw unreadable("this recording has infrared, but no depth", file.path().string(),
                     "record it in another mode of the depth camera than PASSIVE_IR");
  }
  file.choose(kAzureDepth);
  AzureRecording result;
  cv::Size colour_size(4, 3);  // without colour, any
  if (has(kAzureColour)) try {
      result.colour = std::make_unique<VideoFile>(file.path(), kAzureColour);
      colour_size = result.colour->size();
      result.colour_delay_us = result.colour->start_us() - file.start_us();
    } catch (const Error& error) {
      result.notes.push_back(fmt::format("no colour: {}", error.what()));
    }
  try {
    const auto json = file.attachment("calibration.json");
    if (!json) throw std::runtime_error("it is not in the file");
    const AzureCalibration calibration(*json, file.size(), colour_size);
    result.camera = calibration.depth.pinhole;
    if (result.colour)
      result.registration = std::make_unique<ColourRegistration>(
          calibration.depth, calibration.colour, calibration.rotation, calibration.translation_mm);
    result.notes.push_back(distortion_note(calibration.depth));
  } catch (const std::runtime_error& error) {
    result.notes.push_back(fmt::format("no calibration: {}", error.what()));
    if (result.colour)
      result.notes.emplace_back(
          "colour is of another camera and cannot be registered to depth; it is only scaled");
  }
  return result;
}

}  // namespace saccade
