#include "parsers.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>

#include <hdf5.h>

#include "core/file.hpp"
#include "core/png.hpp"
#include "drivers/modules/virtual_spec.hpp"
#include "eval/result_file.hpp"
#include "output/cloud_files.hpp"
#include "settings/settings.hpp"
#include "sources/azure_recording.hpp"
#include "sources/meta_json.hpp"
#include "sources/open_source.hpp"
#include "sources/pcd.hpp"
#include "sources/ply.hpp"
#include "sources/poses_file.hpp"
#include "sources/rvl.hpp"
#include "tests/eval/samples.hpp"
#include "tests/sources/azure_calibration.hpp"
#include "tests/sources/bag_writer.hpp"
#include "tests/sources/ffv1_writer.hpp"
#include "tests/sources/matroska_writer.hpp"
#include "tests/sources/nyu_writer.hpp"
#include "tests/sources/pcd_writer.hpp"
#include "tests/support/memory_file.hpp"
#include "tests/support/no_wait.hpp"
#include "tests/support/proper_error.hpp"

namespace saccade {
namespace {

namespace fs = std::filesystem;
using Input = std::span<const std::uint8_t>;

// A folder of this process, removed when it ends.
class Folder {
 public:
  explicit Folder(const std::string& name)
      : path_(fs::temp_directory_path() / ("saccade_fuzz_" + std::to_string(::getpid())) / name) {
    fs::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    fs::remove(path_.parent_path(), ignored);  // if this was its last folder
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  fs::path operator/(const char* name) const { return path_ / name; }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

Bytes bytes_of(std::string_view text) { return {text.begin(), text.end()}; }
std::string text_of(std::span<const std::uint8_t> bytes) { return {bytes.begin(), bytes.end()}; }

cv::Mat1w small_depth(int shift = 0) {
  cv::Mat1w depth(12, 16);
  for (int r = 0; r < depth.rows; ++r)
    for (int c = 0; c < depth.cols; ++c) depth(r, c) = static_cast<std::uint16_t>(800 + 20 * r + c + shift);
  return depth;
}

// Opens a source and reads its first frames, and the first one again.
bool play(const std::string& uri) {
  return proper_error_at_worst(ExitStatus::unreadable, [&] {
    const auto source = open_source(uri);
    Frame frame;
    const auto read = [&] {
      const ReadResult result = source->read(frame, kNoWait);
      if (result.status == ReadStatus::rejected && result.reason.find('\n') != std::string::npos)
        throw std::logic_error("a reason of several lines: " + result.reason);
      if (result.status != ReadStatus::frame) return;
      if (frame.size() != source->info().size) throw std::logic_error("a frame of another size");
      if (!frame.colour.empty() && frame.colour.size() != frame.size())
        throw std::logic_error("colour of another size");
    };
    for (int k = 0; k < 4; ++k) read();
    source->seek(0);
    read();
  });
}

// Bytes as a file of this name, by which its kind is recognised.
bool play_file(const char* name, std::span<const std::uint8_t> bytes) {
  static const Folder folder("file");
  write_file(folder / name, bytes);
  return play((folder / name).string());
}

// Decodes an image; a decoder may throw std::runtime_error with the reason, as its header says.
template <typename Decode>
bool decodes(const Decode& decode) {
  try {
    if (decode().empty()) throw std::logic_error("an empty image");
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}

// Writers of test files want a path.
template <typename Write>
Bytes written(const char* name, const Write& write) {
  const Folder folder("seeds");
  write(folder / name);
  return read_file(folder / name);
}

std::vector<Bytes> pcd_seeds() {
  cv::Mat1f depth;
  small_depth().convertTo(depth, CV_32F);
  depth(3, 4) = 0;
  std::vector<Bytes> seeds;
  for (const PcdEncoding encoding : {PcdEncoding::ascii, PcdEncoding::binary, PcdEncoding::compressed})
    seeds.push_back(
        write_pcd(depth, {20, 20, 7.5, 5.5}, encoding, cv::Mat3b(depth.size(), cv::Vec3b(1, 2, 3))));
  return seeds;
}

std::vector<Bytes> mat_seeds() {
  const auto seed = [](NyuWriter::Storage depths, NyuWriter::Storage images) {
    return written("seed.mat", [&](const fs::path& path) {
      NyuWriter file(path);
      file.set_storage(depths);
      file.put<float>("depths", H5T_NATIVE_FLOAT, [](int i, int r, int c, int) {
        return static_cast<float>(1 + i) + 0.01F * static_cast<float>(r + c);
      });
      file.set_storage(images);
      file.put<std::uint8_t>(
          "images", H5T_NATIVE_UINT8, [](int i, int r, int c, int k) { return 50 * k + i + r + c; }, 3);
      file.put<std::uint16_t>("labels", H5T_NATIVE_UINT16,
                              [](int, int r, int, int) { return r < 4 ? 7 : 0; });
      file.put<std::uint8_t>("instances", H5T_NATIVE_UINT8,
                             [](int, int, int c, int) { return c < 4 ? 1 : 2; });
    });
  };
  return {seed({}, {}),
          seed({.chunked = false, .deflated = false, .compact = true}, {.chunked = false, .deflated = false}),
          seed({.chunk = {2, 5, 7}, .shuffled = true}, {})};
}

std::vector<Bytes> png_seeds() {
  std::vector<Bytes> seeds = {encode_png(small_depth())};
  cv::Mat1b grey;
  small_depth().convertTo(grey, CV_8U, 0.1);
  seeds.push_back(encode_png(grey));
  cv::Mat3b colour;
  cv::merge(std::vector<cv::Mat>{grey, grey, grey}, colour);
  seeds.push_back(encode_png(colour));
  return seeds;
}

std::vector<Bytes> tum_seeds() {
  return {bytes_of("# timestamp filename\n1305031102.160407 depth/1.png\n1305031102.194330 depth/2.png\n"),
          bytes_of("0.1 depth/1.png\n0.1 depth/2.png\n\n-5 depth/3.png\n1e9 depth/1.png\n")};
}

// A TUM folder whose list of depth images is given.
bool read_any_tum_list(std::span<const std::uint8_t> bytes) {
  static const Folder folder("tum");
  static const bool once = [] {
    fs::create_directories(folder / "depth");
    for (const char* name : {"depth/1.png", "depth/2.png"})
      write_file(folder / name, encode_png(small_depth()));
    write_file(folder / "rgb.txt", std::string_view("1305031102.175304 rgb/1.png\n"));
    return true;
  }();
  static_cast<void>(once);
  write_file(folder / "depth.txt", bytes);
  return play(folder.path().string());
}

std::vector<Bytes> azure_seeds() { return {bytes_of(calibration_json())}; }

// The calibration in a recording of Azure Kinect, and colours registered by it.
bool read_any_calibration(Input bytes) {
  return decodes([&] {
    const AzureCalibration calibration(text_of(bytes), {320, 288}, {16, 12});
    LensCamera depth = calibration.depth;
    depth.size = {16, 12};
    ColourRegistration registration(depth, calibration.colour, calibration.rotation,
                                    calibration.translation_mm);
    cv::Mat1f depth_mm;
    small_depth().convertTo(depth_mm, CV_32F);
    depth_mm(3, 4) = 0;
    cv::Mat3b registered;
    registration.apply(depth_mm, cv::Mat3b(12, 16, cv::Vec3b(1, 2, 3)), registered);
    return registered;
  });
}

std::vector<Bytes> rvl_seeds() { return {encode_rvl(small_depth())}; }

cv::Mat1w read_any_rvl(Input bytes) {
  cv::Mat1w depth(12, 16);
  decode_rvl(bytes, depth);
  return depth;
}

std::vector<Bytes> meta_seeds() {
  return {bytes_of(R"({"fx": 525.0, "fy": 525.0, "cx": 319.5, "cy": 239.5})"),
          bytes_of(R"({"depth_unit_mm": 0.1, "rate_hz": 30, "sequence": true})"),
          bytes_of(R"({"depth_scale": 1000})"),
          bytes_of(R"({"note": "a\u00e9", "list": [1, {"a": []}, true]})")};
}

bool read_any_meta(std::span<const std::uint8_t> bytes) {
  static const Folder folder("meta");
  write_file(folder / "meta.json", bytes);
  return proper_error_at_worst(ExitStatus::unreadable, [&] {
    const FolderMeta meta = read_meta(folder.path());
    if (meta.camera && !(meta.camera->fx > 0 && meta.camera->fy > 0))
      throw std::logic_error("a camera without focal length");
    if (meta.depth_unit_mm && !(*meta.depth_unit_mm > 0)) throw std::logic_error("a unit of no size");
  });
}

std::vector<Bytes> poses_seeds() {
  return {bytes_of("1 0 0 0.5 0 1 0 -0.25 0 0 1 2 0 0 0 1\n1 0 0 0 0 0 -1 0 0 1 0 0 0 0 0 1\n")};
}

bool read_any_poses(std::span<const std::uint8_t> bytes) {
  static const Folder folder("poses");
  write_file(folder / "poses.txt", bytes);
  return proper_error_at_worst(ExitStatus::unreadable, [&] { static_cast<void>(read_poses(folder.path())); });
}

std::vector<Bytes> toml_seeds() {
  std::string all;
  const Settings defaults;
  for (const SettingSpec& spec : setting_specs())
    all += std::string(spec.key) + " = \"" + spec.print(defaults) + "\"\n";
  return {bytes_of(
              "model = \"combined\"\nkernel = 31 # px\nlevels = \"0..4\"\nmap-opacity = 0.5\nquiet = true\n"),
          bytes_of(all)};
}

bool read_any_toml(std::span<const std::uint8_t> bytes) {
  const MemoryFile file(bytes);
  return proper_error_at_worst(ExitStatus::usage, [&] {
    Settings settings;
    load_settings(settings, file.path());
  });
}

std::vector<Bytes> results_seeds() {
  const EvalPlan plan = sample_plan();
  std::string lines = plan_line(plan) + "\n";
  for (const ImageResult& image : sample_images()) lines += image_line(image) + "\n";
  return {bytes_of(lines), bytes_of(lines + end_line() + "\n")};
}

bool read_any_results(std::span<const std::uint8_t> bytes) {
  static const Folder folder("results");
  write_file(folder / kResultFile, bytes);
  return proper_error_at_worst(ExitStatus::unreadable,
                               [&] { static_cast<void>(read_all({scan_results(folder.path())})); });
}

std::vector<Bytes> virtual_seeds() {
  return {
      bytes_of("a.oni?loss_after=30&loss=silent&back_after_ms=500&rate=15"),
      bytes_of(
          "synthetic:table?seed=3&late_ms=20&stall_ms=100&stall_after=5&short_frame=7&ignores_settings=1")};
}

bool read_any_virtual(std::span<const std::uint8_t> bytes) {
  return proper_error_at_worst(ExitStatus::usage, [&] { static_cast<void>(parse_virtual(text_of(bytes))); });
}

std::vector<Bytes> uri_seeds() {
  return {bytes_of("table?seed=4&frames=30&camera=orbit&noise=kinect"),
          bytes_of("table?seed=1&size=320x240&event=add&at=1.5")};
}

// The text behind "synthetic:", which nobody plays here: rendering takes long.
bool read_any_synthetic(std::span<const std::uint8_t> bytes) {
  return proper_error_at_worst(ExitStatus::usage,
                               [&] { static_cast<void>(open_source("synthetic:" + text_of(bytes))); });
}

std::vector<Bytes> mkv_seeds() {
  const std::vector<cv::Mat1w> images = {small_depth(), small_depth(3), small_depth(9)};
  std::vector<Bytes> seeds;
  for (const int level : {1, 3})
    seeds.push_back(
        written("seed.mkv", [&](const fs::path& path) { write_ffv1(path, images, {.level = level}); }));
  seeds.push_back(written("seed.mkv", [&](const fs::path& path) {
    std::vector<Bytes> packets;
    for (const cv::Mat1w& image : images) packets.emplace_back(image.datastart, image.dataend);
    write_raw_matroska(path, images[0].size(), 33, packets);
  }));
  seeds.push_back(written("seed.mkv", [&](const fs::path& path) {
    MatroskaTrack depth{"DEPTH", kB16g, images[0].size(), 16, 0, 33, {}};
    for (const cv::Mat1w& image : images) depth.packets.emplace_back(image.datastart, image.dataend);
    MatroskaTrack colour = depth;  // of grey, whose size is the same
    colour.title = "COLOR";
    write_matroska(path, {colour, depth}, {{"calibration.json", calibration_json()}});
  }));
  return seeds;
}

// Depth of two frames, the colour of one, and the camera.
std::vector<TestMessage> bag_messages(bool cdr) {
  const MessageWriter writer(cdr);
  return {writer.camera("/depth/camera_info", 1, {16, 12}, {20, 20, 7.5, 5.5}),
          writer.image("/depth/image", 1'000, small_depth(), "16UC1"),
          writer.image("/rgb/image", 2'000, cv::Mat3b(12, 16, cv::Vec3b(1, 2, 3)), "rgb8"),
          writer.image("/depth/image", 33'000'000, small_depth(3), "16UC1")};
}

std::vector<Bytes> bag_seeds() {
  std::vector<Bytes> seeds;
  for (const char* compression : {"none", "bz2", "lz4"})
    seeds.push_back(written(
        "seed.bag", [&](const fs::path& path) { write_ros1_bag(path, bag_messages(false), compression); }));
  return seeds;
}

std::vector<Bytes> mcap_seeds() {
  std::vector<Bytes> seeds = {
      written("seed.mcap", [](const fs::path& path) { write_plain_mcap(path, bag_messages(true)); })};
  for (const char* compression : {"", "lz4", "zstd"})
    seeds.push_back(written(
        "seed.mcap", [&](const fs::path& path) { write_mcap(path, bag_messages(true), compression); }));
  return seeds;
}

std::vector<Bytes> db3_seeds() {
  return {written("seed.db3", [](const fs::path& path) { write_db3(path, bag_messages(true)); })};
}

std::vector<Bytes> ply_seeds() {
  Frame frame;
  small_depth().convertTo(frame.depth_mm, CV_32F);
  frame.intrinsics = {20, 20, 7.5, 5.5};
  return {encode_ply(frame), encode_ply(frame, cv::Mat3f(12, 16, cv::Vec3f(0, 0, -1)))};
}

constexpr std::array kParsers = {
    FuzzedParser{"azure", azure_seeds, read_any_calibration},
    FuzzedParser{"bag", bag_seeds, [](Input bytes) { return play_file("seed.bag", bytes); }},
    FuzzedParser{"db3", db3_seeds, [](Input bytes) { return play_file("seed.db3", bytes); }},
    FuzzedParser{"mat", mat_seeds, [](Input bytes) { return play_file("seed.mat", bytes); }},
    FuzzedParser{"mcap", mcap_seeds, [](Input bytes) { return play_file("seed.mcap", bytes); }},
    FuzzedParser{"meta", meta_seeds, read_any_meta},
    FuzzedParser{"mkv", mkv_seeds, [](Input bytes) { return play_file("seed.mkv", bytes); }},
    FuzzedParser{"pcd", pcd_seeds,
                 [](Input bytes) { return decodes([&] { return read_pcd(bytes).depth_mm; }); }},
    FuzzedParser{"ply", ply_seeds,
                 [](Input bytes) { return decodes([&] { return read_ply(bytes).depth_mm; }); }},
    FuzzedParser{"png", png_seeds, [](Input bytes) { return decodes([&] { return decode_png(bytes); }); }},
    FuzzedParser{"poses", poses_seeds, read_any_poses},
    FuzzedParser{"results", results_seeds, read_any_results},
    FuzzedParser{"rvl", rvl_seeds, [](Input bytes) { return decodes([&] { return read_any_rvl(bytes); }); }},
    FuzzedParser{"synthetic", uri_seeds, read_any_synthetic},
    FuzzedParser{"toml", toml_seeds, read_any_toml},
    FuzzedParser{"tum", tum_seeds, read_any_tum_list},
    FuzzedParser{"virtual", virtual_seeds, read_any_virtual},
};

}  // namespace

std::span<const FuzzedParser> fuzzed_parsers() { return kParsers; }

const FuzzedParser& fuzzed_parser(std::string_view name) {
  const auto found = std::ranges::find(kParsers, name, &FuzzedParser::name);
  if (found == kParsers.end()) throw std::invalid_argument("no such parser: " + std::string(name));
  return *found;
}

}  // namespace saccade
