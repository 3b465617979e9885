#include "models/model.hpp"

#include <stdexcept>

#include "models/baselines.hpp"
#include "models/itti.hpp"
#include "models/radial2d.hpp"
#include "models/symmetry2d.hpp"

namespace saccade {
namespace {

class Symmetry3dModel : public SaliencyModel {
 public:
  Symmetry3dModel(const Settings& settings, WorkerPool& pool)
      : operator_(Symmetry3dParams::from(settings), pool, settings.simd) {}

  void compute(const Frame& frame, SaliencyWants wants, SaliencyMaps& maps, StageTimes& times) override {
    operator_.compute(frame.depth_mm, frame.intrinsics, wants, maps, times);
  }

 private:
  Symmetry3d operator_;
};

}  // namespace

std::unique_ptr<SaliencyModel> make_model(const Settings& settings, WorkerPool& pool) {
  const std::string& name = settings.model;
  if (name == "symmetry3d") return std::make_unique<Symmetry3dModel>(settings, pool);
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
