// What the files of a frame cost: the parts of `run --dump overlay,maps` on one thread, processor time. The
// frames are a synthetic table with a Kinect's noise and the first one of the bundled recording.

#include <unistd.h>

#include <filesystem>
#include <string>

#include <benchmark/benchmark.h>

#include "core/file.hpp"
#include "core/png.hpp"
#include "frames.hpp"
#include "output/colour_map.hpp"
#include "output/frame_writer.hpp"
#include "output/overlay.hpp"
#include "output/tiff.hpp"
#include "pipeline/processor.hpp"
#include "register.hpp"

namespace saccade {
namespace {

namespace fs = std::filesystem;

/// A frame of `uri` with its saliency and proto-objects.
Result result_of(const std::string& uri) {
  Result result;
  result.frame = read_frames(uri, 1).at(0);
  const auto processor = make_processor({});
  processor->process(result);
  return result;
}

/// A folder that goes when it is no longer needed.
class Folder {
 public:
  Folder() { fs::create_directories(path_); }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_ = fs::temp_directory_path() / ("saccade_output_bench_" + std::to_string(::getpid()));
};

/// Times function(), which returns the bytes of a file, or 0.
template <typename Function>
void add(const std::string& name, Function function) {
  benchmark::RegisterBenchmark(name.c_str(), [function](benchmark::State& state) {
    std::size_t bytes = 0;
    for (auto _ : state) bytes = function();
    state.counters["kB"] = static_cast<double>(bytes) / 1e3;
  })->Unit(benchmark::kMillisecond);
}

void add_frame(const std::string& name, const std::string& uri) {
  const Result result = result_of(uri);
  const Frame& frame = result.frame;
  const cv::Mat1f& map = result.maps.master;
  const cv::Mat1f smooth = smooth_for_looking(map);
  const cv::Mat1b strength = shown_strength(smooth, {}), grey = to_grey(map);
  const cv::Mat3b plain = draw_background(frame, {}), overlay = draw_overlay(frame, map, result.attention);
  add(name + "/overlay/background", [=] { return draw_background(frame, {}).total() * 0; });
  add(name + "/overlay/smooth", [=] { return smooth_for_looking(map).total() * 0; });
  add(name + "/overlay/strength", [=] { return shown_strength(smooth, {}).total() * 0; });
  add(name + "/overlay/blend", [=] {
    cv::Mat3b picture = plain;
    blend_map(picture, strength, {});
    return std::size_t{0};
  });
  add(name + "/overlay/attention", [=] {
    cv::Mat3b picture = plain;
    draw_attention(picture, result.attention, {});
    return std::size_t{0};
  });
  add(name + "/overlay/png", [=] { return encode_png(overlay).size(); });
  add(name + "/maps/grey", [=] { return to_grey(map).total() * 0; });
  add(name + "/maps/png", [=] { return encode_png(grey).size(); });
  add(name + "/maps/tiff", [=] { return encode_tiff(map).size(); });
  add(name + "/depth/png", [=] {
    cv::Mat1w depth;
    frame.depth_mm.convertTo(depth, CV_16U);
    return encode_png(depth).size();
  });
  const auto write = [=](const std::set<std::string>& dump) {
    const Folder folder;
    DatasetWriter dataset(folder.path(), SourceInfo{});
    write_frame(folder.path(), result, dump, 0, dataset);
    return std::size_t{0};
  };
  add(name + "/files/maps", [=] { return write({"maps"}); });
  add(name + "/files/overlay", [=] { return write({"overlay"}); });
  add(name + "/files/default", [=] { return write({"maps", "overlay"}); });
}

}  // namespace

void register_benchmarks() {
  cv::setNumThreads(1);
  add_frame("synthetic", kBenchTable);
  add_frame("recording", SACCADE_RECORDING);
}

}  // namespace saccade
