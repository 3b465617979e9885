#pragma once

#include <cstdint>
#include <memory>

#include <opencv2/core.hpp>

#include "output/overlay.hpp"
#include "ui/session/cloud_vertices.hpp"
#include "ui/session/orbit_camera.hpp"

namespace saccade {

// What the panels need of the graphics card. The panels know these interfaces only; ui/drawing implements
// them with OpenGL, tests with nothing at all. Everything is called on the thread that draws.

/// Names a picture on the graphics card; 0 = none.
using TextureId = std::uintptr_t;

/// A picture on the graphics card.
class PictureTexture {
 public:
  virtual ~PictureTexture() = default;

  /// BGR, at least 1 x 1; replaces the picture that was there.
  virtual void upload(const cv::Mat3b& picture) = 0;

  /// Enlarged pixels become squares (true) or are blended (false, as at first).
  virtual void set_sharp(bool sharp) = 0;

  /// 0 before the first upload().
  [[nodiscard]] virtual TextureId id() const = 0;
};

/// A computed frame as its point cloud shows it. Nothing is kept of it but `serial`.
struct CloudFrame {
  const Frame& frame;
  const cv::Mat1f& smooth;   ///< smooth_for_looking() of the map; may be empty
  const cv::Mat3f& normals;  ///< the operator's, which are better than rough ones; may be empty
  const OverlayStyle& style;
  std::int64_t serial;  ///< differs for each frame and map
};

/// The picture of a point cloud on the graphics card.
class CloudPicture {
 public:
  virtual ~CloudPicture() = default;

  /// Draws the cloud of `frame` in `size` pixels (at least 1 x 1), unless that is what was drawn last.
  /// Returns its texture, bottom row first, which stays valid until the next call.
  virtual TextureId render(const CloudFrame& frame, const CloudStyle& style, const OrbitCamera& camera,
                           cv::Size size, bool light_theme) = 0;
};

/// Makes pictures on the graphics card.
class Graphics {
 public:
  virtual ~Graphics() = default;
  [[nodiscard]] virtual std::unique_ptr<PictureTexture> make_texture() = 0;

  /// Throws Error (failed) with the driver's message if the shaders cannot be built.
  [[nodiscard]] virtual std::unique_ptr<CloudPicture> make_cloud_picture() = 0;
};

}  // namespace saccade
