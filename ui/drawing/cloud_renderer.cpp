#include "ui/drawing/cloud_renderer.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

#include <epoxy/gl.h>

#include "core/error.hpp"

namespace saccade {
namespace {

// A point's side is set by its depth in the sensor's frame, since a pixel covers more of what is far, and
// then by its distance from the eye. A normal of length 0 means none.
constexpr const char* kVertexShader = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 colour;
layout(location = 2) in vec3 normal;
uniform mat4 view, projection;
uniform float focal_px, point_mm_per_m;
uniform bool lit;
out vec3 shaded;
void main() {
  vec4 eye = view * vec4(position, 1.0);
  gl_Position = projection * eye;
  gl_PointSize = clamp(focal_px * point_mm_per_m * position.z / 1000.0 / max(-eye.z, 1.0), 1.0, 64.0);
  float light = 1.0;
  if (lit && dot(normal, normal) > 0.0)
    light = 0.4 + 0.6 * abs(dot(normalize(mat3(view) * normal), normalize(eye.xyz)));
  shaded = colour.rgb * light;
}
)";

constexpr const char* kFragmentShader = R"(#version 330 core
in vec3 shaded;
out vec4 colour;
void main() { colour = vec4(shaded, 1.0); }
)";

[[noreturn]] void fail(const char* what, const std::string& message) {
  throw failed(what, message.substr(0, message.find('\n')),
               "update the graphics driver, or try LIBGL_ALWAYS_SOFTWARE=1");
}

unsigned compile(GLenum kind, const char* source) {
  const unsigned shader = glCreateShader(kind);
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  int good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good == 0) {
    std::array<char, 512> message{};
    glGetShaderInfoLog(shader, static_cast<int>(message.size()), nullptr, message.data());
    glDeleteShader(shader);
    fail("cannot compile the point cloud's shader", message.data());
  }
  return shader;
}

unsigned link_program() {
  const unsigned vertex = compile(GL_VERTEX_SHADER, kVertexShader);
  const unsigned fragment = compile(GL_FRAGMENT_SHADER, kFragmentShader);
  const unsigned program = glCreateProgram();
  glAttachShader(program, vertex);
  glAttachShader(program, fragment);
  glLinkProgram(program);
  glDeleteShader(vertex);
  glDeleteShader(fragment);
  int good = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &good);
  if (good == 0) {
    std::array<char, 512> message{};
    glGetProgramInfoLog(program, static_cast<int>(message.size()), nullptr, message.data());
    glDeleteProgram(program);
    fail("cannot link the point cloud's shaders", message.data());
  }
  return program;
}

void set_matrix(int location, const cv::Matx44d& matrix) {
  const cv::Matx44f m(matrix);
  glUniformMatrix4fv(location, 1, GL_TRUE, m.val);  // transposed: ours are row by row
}

// OpenGL takes an offset within the buffer in the shape of a pointer.
const void* offset(std::size_t bytes) {
  return reinterpret_cast<const void*>(bytes);  // NOLINT(performance-no-int-to-ptr)
}

// Puts framebuffer and viewport back.
class SavedTarget {
 public:
  SavedTarget() {
    glGetIntegerv(GL_FRAMEBUFFER_BINDING, &framebuffer_);
    glGetIntegerv(GL_VIEWPORT, viewport_.data());
  }
  ~SavedTarget() {
    glBindFramebuffer(GL_FRAMEBUFFER, static_cast<unsigned>(framebuffer_));
    glViewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
  }
  SavedTarget(const SavedTarget&) = delete;
  SavedTarget& operator=(const SavedTarget&) = delete;

 private:
  int framebuffer_ = 0;
  std::array<int, 4> viewport_{};
};

}  // namespace

CloudRenderer::Buffer::Buffer() {
  constexpr int kStride = sizeof(CloudVertex);
  glGenVertexArrays(1, &array_);
  glGenBuffers(1, &buffer_);
  glBindVertexArray(array_);
  glBindBuffer(GL_ARRAY_BUFFER, buffer_);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, kStride, offset(offsetof(CloudVertex, position_mm)));
  glVertexAttribPointer(1, 4, GL_UNSIGNED_BYTE, GL_TRUE, kStride, offset(offsetof(CloudVertex, colour)));
  glVertexAttribPointer(2, 3, GL_BYTE, GL_TRUE, kStride, offset(offsetof(CloudVertex, normal)));
  for (unsigned i = 0; i < 3; ++i) glEnableVertexAttribArray(i);
  glBindVertexArray(0);
}

CloudRenderer::Buffer::~Buffer() {
  glDeleteBuffers(1, &buffer_);
  glDeleteVertexArrays(1, &array_);
}

void CloudRenderer::Buffer::set(std::span<const CloudVertex> vertices) {
  glBindBuffer(GL_ARRAY_BUFFER, buffer_);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size_bytes()), vertices.data(),
               GL_STREAM_DRAW);
  count_ = static_cast<int>(vertices.size());
}

void CloudRenderer::Buffer::draw(unsigned kind) const {
  glBindVertexArray(array_);
  glDrawArrays(kind, 0, count_);
}

CloudRenderer::CloudRenderer() : program_(link_program()) {
  glGenFramebuffers(1, &framebuffer_);
  glGenTextures(1, &colour_);
  glGenRenderbuffers(1, &depth_);
}

CloudRenderer::~CloudRenderer() {
  glDeleteProgram(program_);
  glDeleteFramebuffers(1, &framebuffer_);
  glDeleteTextures(1, &colour_);
  glDeleteRenderbuffers(1, &depth_);
}

int CloudRenderer::uniform(const char* name) const { return glGetUniformLocation(program_, name); }

// With framebuffer_ bound.
void CloudRenderer::resize(cv::Size size) {
  if (size == size_) return;
  size_ = size;
  glBindTexture(GL_TEXTURE_2D, colour_);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size.width, size.height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glBindRenderbuffer(GL_RENDERBUFFER, depth_);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, size.width, size.height);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour_, 0);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_);
}

unsigned CloudRenderer::draw(const OrbitCamera& camera, cv::Size size, const CloudShading& look) {
  const SavedTarget saved;
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  resize({std::max(size.width, 1), std::max(size.height, 1)});
  glViewport(0, 0, size_.width, size_.height);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_BLEND);
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_PROGRAM_POINT_SIZE);
  glClearColor(look.background[0], look.background[1], look.background[2], 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glUseProgram(program_);
  set_matrix(uniform("view"), camera.view());
  set_matrix(uniform("projection"), camera.projection(size_));
  glUniform1f(uniform("focal_px"), static_cast<float>(camera.focal_px(size_)));
  glUniform1f(uniform("point_mm_per_m"), static_cast<float>(look.point_mm_per_m));
  glUniform1i(uniform("lit"), look.lit ? 1 : 0);
  points_.draw(GL_POINTS);
  lines_.draw(GL_LINES);
  glBindVertexArray(0);
  glUseProgram(0);
  glDisable(GL_DEPTH_TEST);
  return colour_;
}

}  // namespace saccade
