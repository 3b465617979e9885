#include "models/model.hpp"

#include <stdexcept>

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
  if (settings.model == "symmetry3d") return std::make_unique<Symmetry3dModel>(settings, pool);
  throw std::invalid_argument("make_model: unknown model " + settings.model);
}

}  // namespace saccade
