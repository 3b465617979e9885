#include "core/line_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/file.hpp"
#include "tests/support/folder_test.hpp"

namespace saccade {
namespace {

using ::testing::ElementsAre;

class LineReaderTest : public FolderTest {
 protected:
  std::vector<std::string> lines(std::uintmax_t begin, std::uintmax_t end, std::size_t piece) const {
    LineReader reader(folder_ / "text", begin, end, piece);
    std::vector<std::string> lines;
    for (std::string_view line; reader.next(line);) lines.emplace_back(line);
    return lines;
  }
};

TEST_F(LineReaderTest, GivesTheCompleteLinesOfAnyPart) {
  write_file(folder_ / "text", std::string_view("one\n\nthree, which is longer\nfour\ncut"));
  for (const std::size_t piece : {1U, 2U, 3U, 5U, 1000U}) {
    EXPECT_THAT(lines(0, UINTMAX_MAX, piece), ElementsAre("one", "", "three, which is longer", "four"));
    EXPECT_THAT(lines(5, UINTMAX_MAX, piece), ElementsAre("three, which is longer", "four"));
    EXPECT_THAT(lines(4, 29, piece), ElementsAre("", "three, which is longer"));
    EXPECT_THAT(lines(0, 3, piece), ElementsAre());
    EXPECT_THAT(lines(100, 200, piece), ElementsAre());
  }
  LineReader reader(folder_ / "text", 0, UINTMAX_MAX, 4);
  std::string_view line;
  ASSERT_TRUE(reader.next(line) && reader.next(line));
  EXPECT_EQ(reader.position(), 5U);
}

TEST_F(LineReaderTest, WhatCannotBeReadIsNamed) {
  std::string_view line;
  EXPECT_THROW((void)LineReader(folder_ / "nowhere").next(line), Error);
  EXPECT_THROW((void)LineReader(folder_).next(line), Error);
}

}  // namespace
}  // namespace saccade
