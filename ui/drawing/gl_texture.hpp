#pragma once

#include <vector>

#include "ui/session/graphics.hpp"

namespace saccade {

/// PictureTexture by OpenGL. All calls, also the destructor's, with the same context current.
class GlTexture final : public PictureTexture {
 public:
  /// Adds its id to `renewed` whenever it looks different.
  explicit GlTexture(std::vector<TextureId>& renewed) : renewed_(renewed) {}
  ~GlTexture() override;
  GlTexture(const GlTexture&) = delete;
  GlTexture& operator=(const GlTexture&) = delete;

  void upload(const cv::Mat3b& picture) override;
  void set_sharp(bool sharp) override;
  [[nodiscard]] TextureId id() const override { return name_; }

 private:
  std::vector<TextureId>& renewed_;
  unsigned name_ = 0;
  cv::Size size_;
  cv::Mat4b pixels_;  // BGRA, kept for its memory
  bool sharp_ = false;
};

}  // namespace saccade
