// Driver modules of other makers: which files are taken, and why one cannot be used.
#include "drivers/openni2/module_file.hpp"

#include <elf.h>

#include <algorithm>
#include <fstream>

#include <gmock/gmock.h>

#include "core/file.hpp"
#include "tests/support/folder_test.hpp"

namespace saccade {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class ModuleFileTest : public FolderTest {
 protected:
  fs::path put(const std::string& name, std::string_view text = "") const {
    fs::create_directories((folder_ / name).parent_path());
    write_file(folder_ / name, text);
    return folder_ / name;
  }

  // A copy of a good module with some of its bytes replaced.
  fs::path altered(const std::string& name, const std::string& from, const std::string& to) const {
    const auto bytes = read_file(VIRTUAL_MODULE, 1u << 30);
    std::string text(bytes.begin(), bytes.end());
    const auto at = text.find(from);
    EXPECT_LT(at, text.size());
    return put(name, text.replace(at, to.size(), to));
  }

  static std::string problem(const fs::path& file) {
    const auto trouble = trouble_with_module(file);
    if (!trouble) return "";
    EXPECT_NE(trouble->remedy, "");
    return trouble->problem;
  }
};

TEST_F(ModuleFileTest, AGoodModuleHasNoProblemWhateverItIsCalled) {
  fs::copy(VIRTUAL_MODULE, folder_ / "libAcme.so");
  EXPECT_EQ(problem(folder_ / "libAcme.so"), "");
  EXPECT_EQ(problem(VIRTUAL_MODULE), "");
}

TEST_F(ModuleFileTest, SaysWhatIsWrong) {
  EXPECT_EQ(problem(folder_ / "libNone.so"), "the file cannot be read");
  EXPECT_EQ(problem(put("libText.so", "a text")), "it is not a shared library of Linux");
  EXPECT_THAT(problem(ACME_NEEDS_MORE), AllOf(HasSubstr("it needs acme_start"), HasSubstr("none of its")));
  EXPECT_EQ(problem(ACME_LACKS_FUNCTIONS),
            "it is not an OpenNI2 driver module: it lacks oniDriverDestroy and 31 more functions");
  EXPECT_THAT(problem(altered("libMissing.so", "libopencv_core.so", "libopencv_c0re.so")),
              AllOf(HasSubstr("the library libopencv_c0re.so"), HasSubstr("that it needs is missing")));
}

TEST_F(ModuleFileTest, NamesAForeignArchitecture) {
  const fs::path file = put("libAcme.so");
  fs::copy(VIRTUAL_MODULE, file, fs::copy_options::overwrite_existing);
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekp(offsetof(Elf64_Ehdr, e_machine));
  const Elf64_Half machine = EM_SPARCV9;
  stream.write(reinterpret_cast<const char*>(&machine), sizeof machine);
  stream.close();
  EXPECT_THAT(problem(file), HasSubstr("it is built for ELF machine 43, and this machine is "));
}

TEST_F(ModuleFileTest, TakesFilesAndFoldersWithBothEndings) {
  put("acme/libAcme.so");
  put("acme/libOther.so.0");
  fs::create_symlink("libOther.so.0", folder_ / "acme/libOther.so");
  put("acme/acme.ini");
  put("acme/libacme.so.txt");
  const fs::path one = put("driver-of-another-name");
  const std::string variable = (folder_ / "acme").string() + "::" + one.string() + ":" + one.string();
  EXPECT_THAT(named_modules(variable.c_str()),
              ElementsAre(folder_ / "acme/libAcme.so", folder_ / "acme/libOther.so", one));
  EXPECT_THAT(named_modules(nullptr), IsEmpty());
  EXPECT_THAT(named_modules("/nowhere/libX.so"), ElementsAre("/nowhere/libX.so")) << "so that it is reported";
}

TEST(ModuleName, IsBetweenLibAndSo) {
  EXPECT_EQ(module_name("/x/libPS1080.so.0"), "PS1080");
  EXPECT_EQ(module_name("liborbbec.so"), "orbbec");
  EXPECT_EQ(module_name("libx.so.1.2"), "x");
  for (const char* other : {"orbbec.so", "lib.so", "libx.a", "libx.so.old"})
    EXPECT_EQ(module_name(other), "");
}

}  // namespace
}  // namespace saccade
