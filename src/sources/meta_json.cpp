#include "sources/meta_json.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/file.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::json;

constexpr double kLargestUnit_mm = 1e4;

// One file's values, with errors that name it.
class MetaReader {
 public:
  explicit MetaReader(const fs::path& path) : path_(path) {
    const auto bytes = read_file(path, 1u << 20);
    json_ = Json::parse(bytes.begin(), bytes.end(), nullptr, /*allow_exceptions=*/false);
    if (!json_.is_object()) throw broken("not a JSON object");
  }

  FolderMeta read() const {
    FolderMeta meta;
    meta.camera = read_camera();
    meta.depth_unit_mm = positive("depth_unit_mm", kLargestUnit_mm);
    if (!meta.depth_unit_mm) read_depth_scale(meta);
    meta.rate_hz = positive("rate_hz", 1e6);
    if (meta.rate_hz && *meta.rate_hz < 1e-3) throw broken("rate_hz is below 0.001");
    if (const auto value = json_.find("sequence"); value != json_.end()) {
      if (!value->is_boolean()) throw broken("sequence is not true or false");
      meta.sequence = value->get<bool>();
    }
    return meta;
  }

 private:
  Error broken(const std::string& why) const {
    return unreadable(fmt::format("broken {}: {}", path_.filename().string(), why), path_.string(),
                      "fix or delete it; fx, fy, cx, cy in pixels and depth_unit_mm are expected");
  }

  std::optional<double> number(const char* key) const {
    const auto value = json_.find(key);
    if (value == json_.end()) return std::nullopt;
    if (!value->is_number()) throw broken(fmt::format("{} is not a number", key));
    return value->get<double>();
  }

  std::optional<double> positive(const char* key, double largest) const {
    const auto value = number(key);
    if (value && !(*value > 0 && *value <= largest))
      throw broken(fmt::format("{} is not above 0 and at most {}", key, largest));
    return value;
  }

  std::optional<Intrinsics> read_camera() const {
    Intrinsics camera;
    camera.origin = IntrinsicsOrigin::file;
    int found = 0;
    for (const auto& [key, field] : {std::pair{"fx", &Intrinsics::fx}, std::pair{"fy", &Intrinsics::fy},
                                     std::pair{"cx", &Intrinsics::cx}, std::pair{"cy", &Intrinsics::cy}}) {
      const auto value = number(key);
      if (!value) continue;
      camera.*field = *value;
      ++found;
    }
    if (found == 0) return std::nullopt;
    if (found < 4) throw broken("some of fx, fy, cx, cy are missing");
    if (!camera.valid()) throw broken("fx and fy must be above 0 and all four finite");
    return camera;
  }

  // The number is in use with three meanings, which do not overlap for the sensors that there are: units per
  // metre (Open3D: 1000), mm per unit (BOP: 0.1 .. 1), metres per unit (RealSense: 0.001).
  void read_depth_scale(FolderMeta& meta) const {
    constexpr double kUnitsPerMetre = 100, kMetresPerUnit = 0.02;
    const auto scale = positive("depth_scale", 1e7);
    if (!scale) return;
    const bool per_metre = *scale >= kUnitsPerMetre, metres = *scale < kMetresPerUnit;
    meta.depth_unit_mm = per_metre ? 1000 / *scale : metres ? *scale * 1000 : *scale;
    meta.notes.push_back(fmt::format("depth_scale {:.6g} is taken as {}: one unit is {:.6g} mm", *scale,
                                     per_metre ? "units per metre"
                                     : metres  ? "metres per unit"
                                               : "mm per unit",
                                     *meta.depth_unit_mm));
  }

  fs::path path_;
  Json json_;
};

}  // namespace

FolderMeta read_meta(const fs::path& folder) {
  const fs::path path = folder / "meta.json";
  std::error_code code;
  return fs::exists(path, code) ? read_meta_file(path) : FolderMeta{};
}

FolderMeta read_meta_file(const fs::path& file) { return MetaReader(file).read(); }

}  // namespace saccade
