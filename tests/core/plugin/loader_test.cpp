// The loader refuses what it cannot use, with the file and the reason; one bad plug-in of each
// sort is built from tests/bad_plugins.

#include "core/plugin/loader.h"

#include "tests/command.h"
#include "tests/support.h"

namespace pbrt {
namespace {

PluginLoader badLoader() {
  return PluginLoader({PBRT_BUILD_DIR "/tests/bad_plugins"});
}

struct Refusal {
  std::string name, reason;
};

class BadPlugin : public testing::TestWithParam<Refusal> {};

TEST_P(BadPlugin, IsRefusedWithFileAndReason) {
  PluginLoader loader = badLoader();
  try {
    loader.open(PluginKind::filter, GetParam().name);
    FAIL() << "it was opened";
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_EQ(error.failure(), Failure::plugin);
    EXPECT_NE(message.find("filters/" + GetParam().name + ".so"), std::string::npos) << message;
    EXPECT_NE(message.find(GetParam().reason), std::string::npos) << message;
  }
  EXPECT_TRUE(loader.opened().empty());
}

INSTANTIATE_TEST_SUITE_P(Sorts, BadPlugin,
                         testing::Values(Refusal{"other_abi", "plug-in ABI"},
                                         Refusal{"other_layout", "data layout"},
                                         Refusal{"other_kind", "it is a shape, not a filter"},
                                         Refusal{"other_name", "calls itself \"misnamed\""},
                                         Refusal{"no_entry", "no pbrt plug-in"},
                                         Refusal{"returns_nothing", "returns nothing"},
                                         Refusal{"missing_symbol", "nowhereDefined"},
                                         Refusal{"not_an_object", "cannot be opened"}),
                         [](const auto& test) { return test.param.name; });

TEST(PluginLoader, OpensAtFirstMentionAndOnce) {
  PluginLoader loader({PBRT_BUILD_DIR "/lib/pbrt"});
  EXPECT_TRUE(loader.opened().empty());
  const PluginInfo& first = loader.open(PluginKind::shape, "sphere");
  EXPECT_EQ(&first, &loader.open(PluginKind::shape, "sphere"));
  EXPECT_EQ(loader.opened().size(), 1U);
  EXPECT_STREQ(first.name, "sphere");
}

TEST(PluginLoader, ANameIsNeverAPath) {
  PluginLoader loader({PBRT_BUILD_DIR "/lib/pbrt"});
  for (const char* name : {"../shapes/sphere", "/etc/passwd", "..", "", "sphere.so", "a b"})
    EXPECT_THROW(loader.open(PluginKind::shape, name), Error) << name;
}

TEST(PluginLoader, FoldersThatCannotBeReadArePassedOver) {
  PluginLoader loader({std::string(5000, 'x'), "/dev/null", PBRT_BUILD_DIR "/lib/pbrt"});
  EXPECT_NO_THROW(loader.open(PluginKind::shape, "sphere"));
}

TEST(PluginLoader, EarlierFoldersWin) {
  const test::Folder folder;
  std::filesystem::create_directories(folder.path() / "shapes");
  std::filesystem::copy_file(PBRT_BUILD_DIR "/lib/pbrt/shapes/sphere.so",
                             folder.path() / "shapes/sphere.so");
  PluginLoader loader({folder.path(), PBRT_BUILD_DIR "/lib/pbrt"});
  loader.open(PluginKind::shape, "sphere");
  loader.open(PluginKind::shape, "disk");
  EXPECT_EQ(loader.opened()[0].file, folder.path() / "shapes/sphere.so");
  EXPECT_EQ(loader.opened()[1].file, PBRT_BUILD_DIR "/lib/pbrt/shapes/disk.so");
}

TEST(PluginLoader, ABadPluginEndsTheCommandWithExitCode5) {
  const test::Folder folder;
  folder.write("scene.pbrt", "PixelFilter \"other_abi\"\nWorldBegin\nWorldEnd\n");
  const test::Outcome outcome =
      folder.pbrt("--plugin-path " PBRT_BUILD_DIR "/tests/bad_plugins scene.pbrt");
  EXPECT_EQ(outcome.code, 5) << outcome.err;
  EXPECT_NE(outcome.err.find("scene.pbrt:1:"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace pbrt
