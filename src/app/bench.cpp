#include "app/bench.hpp"

#include <array>
#include <chrono>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "app/standard_output.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "pipeline/processor.hpp"
#include "pipeline/stage_statistics.hpp"
#include "saliency/reference.hpp"
#include "saliency/simd/simd_stages.hpp"
#include "sources/synthetic_source.hpp"

namespace saccade {
namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

/// A size of depth sensors, and their frame rates at it.
struct SensorSize {
  cv::Size size;
  std::vector<int> rates_hz;
};

const std::array<SensorSize, 4> kSensorSizes = {
    {{{320, 240}, {30, 60}}, {{640, 480}, {30, 60}}, {{1280, 1024}, {15, 30}}, {{1920, 1080}, {15, 30}}}};

struct Measurement {
  SensorSize sensor;
  double valid = 0;  ///< share of pixels with depth
  StageStatistics stages;
  DurationHistogram frame;  ///< from depth to fixations
  double reference_ms = 0;  ///< the same map by the reference; 0 = not measured
};

/// A table as a Kinect sees it; a fifth of the depth is missing, as is usual indoors.
Frame table_frame(cv::Size size) {
  SyntheticSource source(fmt::format("synthetic:table?seed=1&noise=kinect&missing=0.2&frames=1&size={}x{}",
                                     size.width, size.height));
  Frame frame;
  if (source.read(frame, std::chrono::milliseconds(0)).status != ReadStatus::frame)
    throw std::logic_error("bench: the synthetic table has no frame");
  return frame;
}

Measurement measure(const SensorSize& sensor, const Settings& settings, double seconds) {
  constexpr int kLeastFrames = 5;
  Measurement measurement;
  measurement.sensor = sensor;
  const auto processor = make_processor({settings, settings, {}, {}, worker_count(settings)});
  Result result;
  result.frame = table_frame(sensor.size);
  measurement.valid = static_cast<double>(cv::countNonZero(result.frame.depth_mm)) / sensor.size.area();
  processor->process(result);  // allocates memory
  const auto begin = Clock::now();
  while (measurement.frame.count() < kLeastFrames || milliseconds_since(begin) < 1000 * seconds) {
    result.times = {};
    const auto frame_begin = Clock::now();
    processor->process(result);
    measurement.frame.add(milliseconds_since(frame_begin));
    measurement.stages.add(result.times);
  }
  if (sensor.size == cv::Size(640, 480) && settings.model == "symmetry3d") {
    const auto reference_begin = Clock::now();
    reference::symmetry3d(result.frame.depth_mm, result.frame.intrinsics, settings);
    measurement.reference_ms = milliseconds_since(reference_begin);
  }
  return measurement;
}

double map_ms(const Measurement& m) {
  return m.stages[Stage::points].percentile_ms(0.5) + m.stages[Stage::symmetry].percentile_ms(0.5) +
         m.stages[Stage::master_map].percentile_ms(0.5);
}

bool sustains(const Measurement& m, int rate_hz) { return m.frame.percentile_ms(0.95) * rate_hz < 1000; }

nlohmann::ordered_json as_json(const Measurement& m) {
  nlohmann::ordered_json json = {{"width", m.sensor.size.width},
                                 {"height", m.sensor.size.height},
                                 {"valid", m.valid},
                                 {"frames", m.frame.count()},
                                 {"map_ms", map_ms(m)},
                                 {"attention_ms", m.stages[Stage::attention].percentile_ms(0.5)},
                                 {"frame_p50_ms", m.frame.percentile_ms(0.5)},
                                 {"frame_p95_ms", m.frame.percentile_ms(0.95)}};
  for (const int rate : m.sensor.rates_hz) json["sustains"][fmt::format("{} Hz", rate)] = sustains(m, rate);
  if (m.reference_ms > 0) json["reference_ratio"] = m.reference_ms / map_ms(m);
  return json;
}

std::string to_text(const Measurement& m) {
  std::string modes;
  for (const int rate : m.sensor.rates_hz)
    modes += fmt::format("{}{} Hz {}", modes.empty() ? "" : ", ", rate, sustains(m, rate) ? "yes" : "no");
  std::string text = fmt::format("{:>4}x{:<4}  {:7.0f}  {:8.2f}  {:9.2f}  {:8.2f}  {:8.1f}   {}\n",
                                 m.sensor.size.width, m.sensor.size.height, 100 * m.valid, map_ms(m),
                                 m.stages[Stage::attention].percentile_ms(0.5), m.frame.percentile_ms(0.95),
                                 1000 / m.frame.percentile_ms(0.5), modes);
  if (m.reference_ms > 0)
    text += fmt::format(
        "           the map is {:.0f} times faster than the reference, one thread, scalar ({:.0f} ms)\n",
        m.reference_ms / map_ms(m), m.reference_ms);
  return text;
}

}  // namespace

void bench(const Settings& settings, double seconds) {
  cv::setNumThreads(1);
  const std::string_view instructions = choose_simd_stages(settings.simd).name;
  const int workers = worker_count(settings);
  const cv::Size largest = kSensorSizes.back().size;
  check_levels(largest, settings);
  if (!settings.json)
    print_text(
        fmt::format("{}, k = {}, levels {}..{}, {}, {}\n"
                    "     size  valid %    map ms  points ms    p95 ms  frames/s   sustains\n",
                    settings.model, settings.kernel, settings.first_level, settings.last_level,
                    counted(workers, "worker"), instructions));
  nlohmann::ordered_json json = {{"model", settings.model},
                                 {"kernel", settings.kernel},
                                 {"workers", workers},
                                 {"simd", instructions},
                                 {"sizes", nlohmann::ordered_json::array()}};
  for (const SensorSize& sensor : kSensorSizes) {
    const cv::Size last = level_size(sensor.size, settings.last_level);
    if (std::min(last.width, last.height) < 8) continue;  // too small for the levels
    const Measurement measurement = measure(sensor, settings, seconds);
    if (settings.json)
      json["sizes"].push_back(as_json(measurement));
    else
      print_text(to_text(measurement));
  }
  if (settings.json) print_json(json);
}

}  // namespace saccade
