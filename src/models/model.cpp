#include "models/model.hpp"

#include <stdexcept>

#include <fmt/format.h>

#include "core/error.hpp"
#include "models/baselines.hpp"
#include "models/combined.hpp"
#include "models/itti.hpp"
#include "models/radial2d.hpp"
#include "models/symmetry2d.hpp"

namespace saccade {
namespace {

class Symmetry3dModel : public SaliencyModel {
 public:
  Symmetry3dModel(const Settings& settings, WorkerPool& pool)
      : operator_(Symmetry3dParams::from(settings), pool, settings.simd) {}

  void compute(const Frame& frame, RequestedOutputs outputs, SaliencyMaps& maps, StageTimes& times) override {
    operator_.compute(frame.depth_mm, frame.intrinsics, outputs, maps, times);
  }

 private:
  Symmetry3d operator_;
};

}  // namespace

bool needs_depth(std::string_view model) { return model == "symmetry3d" || model == "combined"; }

void check_model(const Settings& settings, cv::Size image) {
  if (needs_depth(settings.model)) return check_levels(image, Symmetry3dParams::from(settings));
  for (const char* part : {"levels", "normals"})
    if (settings.dump.contains(part))
      throw usage_error(fmt::format("model {} has no {} to dump", settings.model, part),
                        "--dump " + fmt::format("{}", fmt::join(settings.dump, ",")),
                        fmt::format("leave {} out, or use --model symmetry3d or combined", part));
}

std::unique_ptr<SaliencyModel> make_model(const Settings& settings, WorkerPool& pool) {
  const std::string& name = settings.model;
  if (name == "symmetry3d") return std::make_unique<Symmetry3dModel>(settings, pool);
  if (name == "combined") return std::make_unique<CombinedModel>(settings, pool);
  if (name == "symmetry2d") return make_symmetry2d(pool);
  if (name == "colour_symmetry2d") return make_colour_symmetry2d(pool);
  if (name == "radial2d") return std::make_unique<Radial2dModel>(pool);
  if (name == "itti") return std::make_unique<IttiModel>("itti", false, pool);
  if (name == "itti_orientation") return std::make_unique<IttiModel>("itti_orientation", true, pool);
  if (name == "random") return std::make_unique<RandomModel>(pool);
  if (name == "centre") return std::make_unique<CentreModel>(pool);
  throw std::invalid_argument("make_model: unknown model " + name);
}

}  // namespace saccade
