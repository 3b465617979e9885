// No include runs upwards, and there are no circles.
#include "tests/house/layering.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/file.hpp"
#include "tests/support/folder_test.hpp"
#include "tests/support/places.hpp"

namespace saccade {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

const Floors kHouse = {
    {"src/core"},
    {"src/scene", "src/oni", "drivers/openni2", "src/saliency/simd", "src/attention/simd"},
    {"src/saliency"},
    {"src/models", "src/attention", "src/sources"},
    {"src/tracking"},
    {"src/pipeline", "drivers/modules"},
    {"src/output"},
    {"src/settings"},
    {"src/eval", "src/python", "ui/session"},
    {"ui/panels", "ui/drawing"},
    {"ui/window"},
    {"src/app"},
};

TEST(House, NoIncludeRunsUpwards) {
  const std::vector<Include> includes = find_includes(in_source(""));
  EXPECT_GT(includes.size(), 500U);
  EXPECT_THAT(find_upward(includes, kHouse), IsEmpty());
}

TEST(House, NoCircles) { EXPECT_THAT(find_circles(find_includes(in_source(""))), IsEmpty()); }

// The check itself, on a house of three rooms.
class Layering : public FolderTest {
 protected:
  void put(const std::string& name, std::string_view text) const {
    fs::create_directories((folder_ / name).parent_path());
    write_file(folder_ / name, text);
  }
  std::vector<std::string> upward() const { return find_upward(find_includes(folder_), kThree); }

  const Floors kThree = {{"src/core"}, {"src/a", "src/b"}, {"ui"}};
};

TEST_F(Layering, DownwardsAndInTheRoomIsAllowed) {
  put("src/core/x.hpp", "#include <vector>\n");
  put("src/a/y.hpp", "#include \"core/x.hpp\"\n#include \"core/generated.hpp\"\n");
  put("src/a/y.cpp", "#include \"a/y.hpp\"\n");
  put("ui/z.cpp", "  #  include \"a/y.hpp\"  // a comment\n#include \"ui/w.hpp\"\n");
  put("ui/w.hpp", "");
  EXPECT_THAT(find_includes(folder_), SizeIs(5));
  EXPECT_THAT(upward(), IsEmpty());
}

TEST_F(Layering, UpwardsSidewaysAndOutsideAreFound) {
  put("src/core/x.cpp", "\n#include \"a/y.hpp\"\n");
  put("src/a/y.hpp", "#include \"b/u.hpp\"\n");
  put("src/b/u.hpp", "#include \"tests/t.hpp\"\n");
  put("src/a/deep/v.hpp", "#include \"core/x.hpp\"\n");
  put("ui/w.hpp", "");
  put("src/a/w.hpp", "#include \"ui/w.hpp\"\n");
  EXPECT_THAT(
      upward(),
      ElementsAre("src/a/deep/v.hpp:1 includes src/core/x.hpp: src/a/deep/v.hpp is in none of the rooms",
                  "src/a/w.hpp:1 includes ui/w.hpp: ui is not below src/a",
                  "src/a/y.hpp:1 includes src/b/u.hpp: src/b is not below src/a",
                  "src/b/u.hpp:1 includes src/tests/t.hpp: src/tests/t.hpp is in none of the rooms",
                  "src/core/x.cpp:2 includes src/a/y.hpp: src/a is not below src/core"));
}

TEST_F(Layering, CirclesAreFound) {
  put("src/a/p.hpp", "#include \"a/q.hpp\"\n");
  put("src/a/q.hpp", "#include \"a/r.hpp\"\n#include \"core/x.hpp\"\n");
  put("src/a/r.hpp", "#include \"a/q.hpp\"\n");
  EXPECT_THAT(find_circles(find_includes(folder_)), ElementsAre("src/a/q.hpp -> src/a/r.hpp -> src/a/q.hpp"));
}

}  // namespace
}  // namespace saccade
