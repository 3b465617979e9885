#include "sources/meta_json.hpp"

#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/file.hpp"

namespace saccade {

std::optional<Intrinsics> read_meta(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "meta.json";
  std::error_code code;
  if (!std::filesystem::exists(path, code)) return std::nullopt;
  const auto broken = [&](const std::string& why) {
    return unreadable("broken meta.json: " + why, path.string(),
                      "fix or delete it; fx, fy, cx, cy in pixels are expected");
  };
  const auto bytes = read_file(path, 1u << 20);
  const auto meta = nlohmann::json::parse(bytes.begin(), bytes.end(), nullptr, /*allow_exceptions=*/false);
  if (!meta.is_object()) throw broken("not a JSON object");
  Intrinsics camera;
  camera.origin = IntrinsicsOrigin::file;
  int found = 0;
  for (const auto& [key, field] : {std::pair{"fx", &Intrinsics::fx}, std::pair{"fy", &Intrinsics::fy},
                                   std::pair{"cx", &Intrinsics::cx}, std::pair{"cy", &Intrinsics::cy}}) {
    const auto value = meta.find(key);
    if (value == meta.end()) continue;
    if (!value->is_number()) throw broken(fmt::format("{} is not a number", key));
    camera.*field = value->get<double>();
    ++found;
  }
  if (found == 0) return std::nullopt;
  if (found < 4) throw broken("some of fx, fy, cx, cy are missing");
  if (!camera.valid()) throw broken("fx and fy must be above 0 and all four finite");
  return camera;
}

}  // namespace saccade
