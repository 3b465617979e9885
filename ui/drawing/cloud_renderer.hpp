#pragma once

#include <array>
#include <cstddef>
#include <span>

#include <opencv2/core.hpp>

#include "ui/session/cloud_vertices.hpp"
#include "ui/session/orbit_camera.hpp"

namespace saccade {

/// The look of the points.
struct CloudShading {
  bool lit = true;            ///< points with a normal are darker the more they turn away from the eye
  double point_mm_per_m = 2;  ///< side of a point for each metre of its depth; a pixel covers 1000 / fx
  std::array<float, 3> background = {0.08F, 0.09F, 0.11F};  ///< red, green, blue, 0..1
};

/// Draws points and lines by OpenGL 3.3 core into a texture. All calls, also the destructor's, with the same
/// context current on the calling thread. Of the context's state, the framebuffer and the viewport are left
/// as they were.
class CloudRenderer {
 public:
  /// Throws Error (failed) with the driver's message if the shaders cannot be built.
  CloudRenderer();
  ~CloudRenderer();
  CloudRenderer(const CloudRenderer&) = delete;
  CloudRenderer& operator=(const CloudRenderer&) = delete;

  /// Replaces the vertices; copied to the graphics card.
  void set_points(std::span<const CloudVertex> vertices) { points_.set(vertices); }
  void set_lines(std::span<const CloudVertex> vertices) { lines_.set(vertices); }  ///< two a line

  /// Draws, and returns the texture: RGBA, `size` (at least 1 x 1), bottom row first. It stays valid until
  /// the next draw().
  unsigned draw(const OrbitCamera& camera, cv::Size size, const CloudShading& look);

 private:
  // Vertices on the graphics card.
  class Buffer {
   public:
    Buffer();
    ~Buffer();
    Buffer(const Buffer&) = delete;
    Buffer& operator=(const Buffer&) = delete;
    void set(std::span<const CloudVertex> vertices);
    void draw(unsigned kind) const;

   private:
    unsigned array_ = 0, buffer_ = 0;
    int count_ = 0;
  };

  void resize(cv::Size size);
  int uniform(const char* name) const;

  unsigned program_ = 0, framebuffer_ = 0, colour_ = 0, depth_ = 0;
  cv::Size size_;
  Buffer points_, lines_;
};

}  // namespace saccade
