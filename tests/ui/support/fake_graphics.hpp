#pragma once

#include <memory>

#include "ui/session/graphics.hpp"

namespace saccade::test {

/// Graphics that keep what they are given and draw nothing.
class FakeGraphics final : public Graphics {
 public:
  class Texture final : public PictureTexture {
   public:
    void upload(const cv::Mat3b& picture) override { picture.copyTo(uploaded); }
    void set_sharp(bool is_sharp) override { sharp = is_sharp; }
    [[nodiscard]] TextureId id() const override { return uploaded.empty() ? 0 : 2; }

    cv::Mat3b uploaded;
    bool sharp = false;
  };

  [[nodiscard]] std::unique_ptr<PictureTexture> make_texture() override {
    auto made = std::make_unique<Texture>();
    texture = made.get();
    return made;
  }
  [[nodiscard]] std::unique_ptr<CloudPicture> make_cloud_picture() override {
    return std::make_unique<Cloud>();
  }

  Texture* texture = nullptr;  ///< made last

 private:
  class Cloud final : public CloudPicture {
   public:
    TextureId render(const CloudFrame&, const CloudStyle&, const OrbitCamera&, cv::Size, bool) override {
      return 3;
    }
  };
};

}  // namespace saccade::test
