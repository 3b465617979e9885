#pragma once

#include <cstdint>
#include <string>

#include <fmt/format.h>

namespace saccade {

constexpr std::uint32_t kB16g =
    'b' | '1' << 8 | '6' << 16 | 'g' << 24;  ///< codec of its depth: 16 bits, big-endian

/// A calibration of Azure Kinect as the firmware writes it, with rounded numbers of a usual device.
inline std::string calibration_json(const std::string& depth_fx = "0.492", int colour_height = 3072) {
  return fmt::format(
      R"({{"CalibrationInformation":{{"Cameras":[{{"Intrinsics":{{"ModelParameterCount":14,"ModelParameters":)"
      R"([0.5014,0.4970,{},0.4919,4.72,3.21,0.17,5.06,4.78,0.886,0,0,0.00012,0.000006],"ModelType":"BC"}},)"
      R"("Location":"CALIBRATION_CameraLocationD0","MetricRadius":1.74,"Rt":{{"Rotation":[1,0,0,0,1,0,0,0,1],)"
      R"("Translation":[0,0,0]}},"SensorHeight":1024,"SensorWidth":1024}},{{"Intrinsics":{{)"
      R"("ModelParameterCount":14,"ModelParameters":[0.5067,0.5146,0.4789,0.6385,0.404,-2.603,1.512,0.284,)"
      R"(-2.421,1.435,0,0,-0.00004,0.00089]}},"Location":"CALIBRATION_CameraLocationPV0","Rt":{{"Rotation":)"
      R"([0.999999,0.00118,-0.00045,-0.00114,0.99628,0.08616,0.00055,-0.08616,0.99628],)"
      R"("Translation":[-0.0321,-0.0022,0.0039]}},"SensorHeight":{},"SensorWidth":4096}}]}}}})",
      depth_fx, colour_height);
}

}  // namespace saccade
