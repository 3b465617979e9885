#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/frame_source.hpp"
#include "scene/camera_path.hpp"
#include "scene/event.hpp"
#include "scene/kinect.hpp"
#include "scene/render.hpp"
#include "scene/scene.hpp"

namespace saccade {

/// The parts of `synthetic:NAME?key=value&...`.
struct SyntheticSpec {
  enum class Noise { none, kinect };

  std::string scene;          ///< cone, cube, cylinder, sphere, table, room
  std::uint64_t seed = 0;     ///< seed=0..2^53: placement, colours and noise
  Noise noise = Noise::none;  ///< noise=none (exact depth, fractions of mm) | kinect (whole mm)
  double missing = 0;         ///< missing=0..0.9: share without a reading, at least; upright strips
  std::int64_t frames = 90;   ///< frames=1..1000000
  std::int64_t scenes = 1;    ///< scenes=1..1000000: frame k shows the scene of seed + k mod scenes
  cv::Size size{640, 480};    ///< size=WxH, as check_image_size() allows
  scene::CameraPath camera = scene::CameraPath::still;  ///< camera=still | orbit | pan | walk
  scene::EventKind event = scene::EventKind::none;      ///< event=none | move | add | take | hide
  double at_s = 2;                                      ///< at=0..86400, s: when the event begins
  double rate_hz = 30;                ///< rate=0.1..1000, Hz: of the time stamps, and so of all motion
  std::optional<int> objects;         ///< objects=1..20, table only; default 5..9, by the seed
  std::optional<double> distance_mm;  ///< distance=400..10000, mm from the camera to the middle of the scene
};

/// Reads "synthetic:NAME?key=value&...". Throws Error (usage) for another scheme, an unknown scene or key, a
/// key given twice, or a value out of range; it names what is known.
SyntheticSpec parse_synthetic(const std::string& uri);

/// A ray-cast scene as a source of frames, with exact labels, normals and camera poses; these stay exact
/// where the depth is noisy. Labels keep their identity while camera and objects move. The intrinsics are the
/// camera's own: fx = fy = 525 at a width of 640, principal point in the middle. Frame k depends on the
/// specification and k alone, in whatever order frames are read. A still camera renders a scene in which
/// nothing happens once while it stays in view; noise is drawn for every frame, the missing strips for every
/// scene.
class SyntheticSource : public FrameSource {
 public:
  /// Throws as parse_synthetic().
  explicit SyntheticSource(const std::string& uri);

  const SourceInfo& info() const override { return info_; }
  ReadResult read(Frame& frame, std::chrono::milliseconds timeout) override;
  /// Throws std::invalid_argument for a negative index.
  void seek(std::int64_t index) override;

  const SyntheticSpec& spec() const { return spec_; }

 private:
  void make_scene(std::int64_t number);
  bool is_still() const;
  void look(double time_s);

  SyntheticSpec spec_;
  SourceInfo info_;
  scene::Scene scene_;
  scene::Event event_;
  scene::Pose pose_;  // of view_
  scene::SceneRender view_;
  scene::KinectModel kinect_;
  std::int64_t scene_number_ = 0;  // which of spec_.scenes scene_ is
  bool looked_ = false;            // view_ is of the still camera
  std::int64_t next_ = 0;
};

}  // namespace saccade
