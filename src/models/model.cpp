#include "models/model.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include "models/baselines.hpp"
#include "models/combined.hpp"
#include "models/itti.hpp"
#include "models/radial2d.hpp"
#include "models/symmetry2d.hpp"

namespace saccade {
namespace {

class Symmetry3dModel : public SaliencyModel {
 public:
  Symmetry3dModel(const ModelSettings& settings, WorkerPool& pool)
      : operator_(settings, pool, settings.simd) {}

  void compute(const Frame& frame, RequestedOutputs outputs, SaliencyMaps& maps, StageTimes& times) override {
    operator_.compute(frame.depth_mm, frame.intrinsics, outputs, maps, times);
  }

 private:
  Symmetry3d operator_;
};

template <typename Model>
std::unique_ptr<SaliencyModel> make(const ModelSettings& settings, WorkerPool& pool) {
  return std::make_unique<Model>(settings, pool);
}

template <typename Model>
std::unique_ptr<SaliencyModel> make_plain(const ModelSettings&, WorkerPool& pool) {
  return std::make_unique<Model>(pool);
}

constexpr std::array<ModelInfo, 9> kModels = {{
    {"symmetry3d", "3D symmetry of the depth image, the paper's model", true, make<Symmetry3dModel>},
    {"combined", "3D symmetry together with itti and symmetry2d", true, make<CombinedModel>},
    {"symmetry2d", "symmetry of the grey image (Reisfeld, Kootstra)", false,
     [](const ModelSettings&, WorkerPool& pool) -> std::unique_ptr<SaliencyModel> {
       return make_symmetry2d(pool);
     }},
    {"colour_symmetry2d", "symmetry of the colour image (Heidemann)", false,
     [](const ModelSettings&, WorkerPool& pool) -> std::unique_ptr<SaliencyModel> {
       return make_colour_symmetry2d(pool);
     }},
    {"radial2d", "fast radial symmetry of the grey image (Loy and Zelinsky)", false,
     make_plain<Radial2dModel>},
    {"itti", "intensity, colour and orientation contrast (Itti, Koch and Niebur)", false,
     [](const ModelSettings&, WorkerPool& pool) -> std::unique_ptr<SaliencyModel> {
       return std::make_unique<IttiModel>("itti", false, pool);
     }},
    {"itti_orientation", "the orientation channel of itti alone", false,
     [](const ModelSettings&, WorkerPool& pool) -> std::unique_ptr<SaliencyModel> {
       return std::make_unique<IttiModel>("itti_orientation", true, pool);
     }},
    {"random", "baseline: a random value at each pixel", false, make_plain<RandomModel>},
    {"centre", "baseline: the centre of the image", false, make_plain<CentreModel>},
}};

const ModelInfo& find_model(std::string_view name) {
  const auto found = std::find_if(kModels.begin(), kModels.end(),
                                  [&](const ModelInfo& model) { return model.name == name; });
  if (found == kModels.end()) throw std::invalid_argument("unknown model " + std::string(name));
  return *found;
}

}  // namespace

std::span<const ModelInfo> models() { return kModels; }

std::vector<std::string_view> model_names(bool needs_depth) {
  std::vector<std::string_view> names;
  for (const ModelInfo& model : kModels)
    if (model.needs_depth == needs_depth) names.push_back(model.name);
  return names;
}

bool needs_depth(std::string_view model) { return find_model(model).needs_depth; }

void check_model(const ModelSettings& settings, cv::Size image) {
  if (needs_depth(settings.model)) check_levels(image, settings);
}

std::unique_ptr<SaliencyModel> make_model(const ModelSettings& settings, WorkerPool& pool) {
  return find_model(settings.model).make(settings, pool);
}

}  // namespace saccade
