#include "core/text.hpp"

#include <cstdint>

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace saccade {
namespace {

TEST(Printable, LettersOfAnyLanguageStay) {
  for (const char* text : {"", "a b/c.png", "Größe", "深度", "😀"}) EXPECT_EQ(printable(text), text);
}

TEST(Printable, ControlCharactersAreEscaped) {
  EXPECT_EQ(printable("a\x1b[31mb"), "a\\x1b[31mb");
  EXPECT_EQ(printable("a\nb\rc\td\x7f"), "a\\x0ab\\x0dc\\x09d\\x7f");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\xc2\\x9b31m")
      << "CSI as one character";
  EXPECT_EQ(printable("\xe2\x80\xae"), "\\xe2\\x80\\xae") << "turns the direction of writing";
  EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a\\x00b");
}

TEST(Printable, BytesThatAreNotUtf8AreEscaped) {
  EXPECT_EQ(printable("\xff\xfe"), "\\xff\\xfe");
  EXPECT_EQ(printable("caf\xe9"), "caf\\xe9") << "Latin-1";
  EXPECT_EQ(printable("\xc3"), "\\xc3") << "cut";
  EXPECT_EQ(printable("\xc0\xaf"), "\\xc0\\xaf") << "too long a form";
  EXPECT_EQ(printable("\xe0\x80\xaf"), "\\xe0\\x80\\xaf");
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "half of a pair of UTF-16";
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80") << "beyond Unicode";
}

TEST(Printable, LinesKeepTheirBreaks) { EXPECT_EQ(printable_lines("a\nb\x1b\n"), "a\nb\\x1b\n"); }

TEST(Counted, OneHasNoS) {
  EXPECT_EQ(counted(1, "frame"), "1 frame");
  EXPECT_EQ(counted(std::uint64_t{0}, "depth frame"), "0 depth frames");
  EXPECT_EQ(counted(std::int64_t{-1}, "byte"), "-1 bytes");
  EXPECT_EQ(counted(12345678901, "byte"), "12345678901 bytes");
}

TEST(ErrorText, IsOnePrintableLine) {
  EXPECT_STREQ(failed("cannot\nread", "a\x1b[2Jb", "try").what(), "cannot read: a\\x1b[2Jb (try)");
}

}  // namespace
}  // namespace saccade
