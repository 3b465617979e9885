#include "ui/session/typed_path.hpp"

#include <climits>
#include <cstdlib>

#include <gtest/gtest.h>

namespace saccade {
namespace {

TEST(TypedPath, IsTheTextWithoutWhatSurroundsIt) {
  EXPECT_EQ(typed_path("/data/table.oni"), "/data/table.oni");
  EXPECT_EQ(typed_path("  /data/a b.oni \r\n"), "/data/a b.oni");
  EXPECT_EQ(typed_path("'/data/a b.oni'"), "/data/a b.oni");
  EXPECT_EQ(typed_path("\"a.oni\""), "a.oni");
  EXPECT_EQ(typed_path("'a.oni\""), "'a.oni\"") << "not a pair";
  EXPECT_EQ(typed_path("\n\n/first\n/second\n"), "/first");
  EXPECT_EQ(typed_path("synthetic:table?noise=kinect"), "synthetic:table?noise=kinect");
}

TEST(TypedPath, AUriOfAFileIsItsPath) {
  EXPECT_EQ(typed_path("file:///data/a%20b%C3%A4.oni"), "/data/a b\xC3\xA4.oni");
  EXPECT_EQ(typed_path("file://localhost/data/a.oni"), "/data/a.oni");
  EXPECT_EQ(typed_path("file:///100%/a%2"), "/100%/a%2") << "not encoded";
  EXPECT_EQ(typed_path("file:///a%zz"), "/a%zz");
  EXPECT_EQ(typed_path("file://nowhere"), "");
  EXPECT_EQ(typed_path("https://example.org/a.oni"), "https://example.org/a.oni");
}

TEST(TypedPath, ATildeIsTheHomeFolder) {
  ::setenv("HOME", "/home/ada", 1);
  EXPECT_EQ(typed_path("~/a.oni"), "/home/ada/a.oni");
  EXPECT_EQ(typed_path("~"), "/home/ada");
  EXPECT_EQ(typed_path("~b/a.oni"), "~b/a.oni");
}

TEST(TypedPath, WhatCannotBeAPathIsNone) {
  EXPECT_EQ(typed_path(""), "");
  EXPECT_EQ(typed_path(" \n\t "), "");
  EXPECT_EQ(typed_path("''"), "");
  EXPECT_EQ(typed_path("a\x1b[31mb"), "");
  EXPECT_EQ(typed_path("file:///a%0Ab"), "");
  EXPECT_EQ(typed_path(std::string(PATH_MAX, 'x')), "");
  EXPECT_EQ(typed_path(std::string(PATH_MAX - 1, 'x')).size(), PATH_MAX - 1u);
}

}  // namespace
}  // namespace saccade
