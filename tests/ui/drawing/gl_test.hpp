#pragma once

#include <cstdlib>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "tests/ui/support/x_server.hpp"

namespace saccade {

/// A test with an OpenGL 3.3 context on a display of its own; skipped where Xvfb is missing.
class GlTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!is_installed("Xvfb")) GTEST_SKIP() << "Xvfb is not installed";
    ASSERT_TRUE(server_.start()) << "Xvfb did not start";
    ::setenv("DISPLAY", server_.display().c_str(), 1);
    ::setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    ASSERT_EQ(glfwInit(), GLFW_TRUE);
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    window_ = glfwCreateWindow(64, 64, "test", nullptr, nullptr);
    ASSERT_NE(window_, nullptr) << "no OpenGL 3.3";
    glfwMakeContextCurrent(window_);
  }
  void TearDown() override {
    if (window_ != nullptr) glfwDestroyWindow(window_);
    glfwTerminate();
  }

 private:
  XServer server_;
  GLFWwindow* window_ = nullptr;
};

}  // namespace saccade
