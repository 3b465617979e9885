#pragma once

#include <cstdint>
#include <string>

#include "core/frame.hpp"
#include "scene/camera_path.hpp"
#include "scene/event.hpp"
#include "scene/kinect.hpp"
#include "scene/render.hpp"

namespace saccade {

/// A made-up scene that is watched at 30 frames a second, with exact labels and a made-up saliency.
class WatchedScene {
 public:
  struct Options {
    std::string scene = "table";
    std::uint64_t seed = 3;
    scene::CameraPath camera = scene::CameraPath::still;
    scene::EventKind event = scene::EventKind::none;
    double at_s = 1;
    bool noise = true;  ///< of a Kinect
    cv::Size size{320, 240};
  };

  explicit WatchedScene(const Options& options);

  /// Frame k, 320 x 240.
  const Frame& frame(std::int64_t k);

  /// A map for the frame made last: a hill over the middle of what is seen of each object, the higher the
  /// larger its label, by `step`; 0 elsewhere. `jitter`: the heights vary at random from frame to frame by up
  /// to this part.
  cv::Mat1f saliency(float step = 0.1F, double jitter = 0) const;

  /// Label of the object that the event happens to.
  int label() const { return event_.label; }
  int objects() const { return scene_.objects; }

 private:
  Options options_;
  scene::Scene scene_;
  scene::Event event_;
  scene::SceneRender view_;
  scene::KinectModel kinect_;
  Frame frame_;
};

}  // namespace saccade
