// The loader refuses what it cannot use, with the file and the reason; plug-ins that are wrong in
// one way each are built from tests/bad_plugins. The files themselves: stamp_test.cpp.

#include "core/plugin/loader.h"

#include "tests/command.h"
#include "tests/support.h"

namespace pbrt {
namespace {

namespace fs = std::filesystem;

struct Refusal {
  std::string name, reason;
};

class BadPlugin : public testing::TestWithParam<Refusal> {};

TEST_P(BadPlugin, IsRefusedWithFileAndReasonInOneLine) {
  const auto& [name, reason] = GetParam();
  const fs::path folder = PBRT_BUILD_DIR "/tests/bad_plugins";
  if (!fs::exists(folder / "filters" / (name + ".so")))
    GTEST_SKIP() << "not built under a sanitizer";
  PluginLoader loader({folder});
  try {
    loader.open(PluginKind::filter, name);
    FAIL() << "it was opened";
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_EQ(error.failure(), Failure::plugin);
    EXPECT_NE(message.find("filters/" + name + ".so: " + reason), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
  EXPECT_TRUE(loader.opened().empty());
}

const std::string kNextAbi = std::to_string(kAbiVersion + 1);
const std::string kThisAbi = std::to_string(kAbiVersion);

INSTANTIATE_TEST_SUITE_P(
    OpenedInVain, BadPlugin,
    testing::Values(Refusal{"other_kind", "it is a shape, not a filter"},
                    Refusal{"other_name", "it calls itself \"misnamed\""},
                    Refusal{"no_entry", "it is no pbrt plug-in: it has no function pbrt_plugin"},
                    Refusal{"returns_nothing", "its entry function returns nothing"},
                    Refusal{"other_answer", "it was built for plug-in ABI " + kNextAbi},
                    Refusal{"missing_symbol",
                            "it cannot be opened: undefined symbol: nowhere::defined(int)"},
                    Refusal{"missing_library",
                            "it cannot be opened: libnowhere.so.7: cannot open shared object "
                            "file: No such file or directory"}),
    [](const auto& test) { return test.param.name; });

// They end the process as soon as they are opened: the stamp was read before.
INSTANTIATE_TEST_SUITE_P(
    NeverRun, BadPlugin,
    testing::Values(
        Refusal{"no_stamp", "it has no stamp: it is no pbrt plug-in, or one for a plug-in ABI "},
        Refusal{"other_abi", "it was built for plug-in ABI " + kNextAbi + ", this pbrt has " +
                                 kThisAbi + "; build it again"},
        Refusal{"other_layout", "its data are laid out otherwise"},
        Refusal{"old_strings",
                "it was built with the std::string of before C++11 "
                "(-D_GLIBCXX_USE_CXX11_ABI=0), this pbrt was not; build"},
        Refusal{"debug_containers", "it was built with the containers of -D_GLIBCXX_DEBUG, this"},
        Refusal{"aligned_glm", "it was built with other options of GLM"},
        Refusal{"address_sanitizer", "it was built with AddressSanitizer (-fsanitize=address), "},
        Refusal{"thread_sanitizer", "it was built with ThreadSanitizer (-fsanitize=thread), "}),
    [](const auto& test) { return test.param.name; });

TEST(PluginLoader, OpensWhatAnotherCompilerBuilt) {
  const fs::path folder = PBRT_BUILD_DIR "/tests/other_compiler";
  if (!fs::exists(folder / "shapes/sphere.so")) GTEST_SKIP() << "there is no other compiler";
  PluginLoader loader({folder});
  const PluginInfo& plugin = loader.open(PluginKind::shape, "sphere");

  // Values, virtual functions, strings and vectors go to and fro.
  const ParamList two{test::number("radius", 2)};
  Params params("shapes/sphere", {}, {&two});
  const auto sphere = create<Shape>(plugin, params, {});
  params.refuseUnread();
  const ObjectRay ray{{0, 0, -5}, {0, 0, 1}};
  const auto hit = sphere->intersect(ray, 0);
  ASSERT_TRUE(hit);
  EXPECT_FLOAT_EQ(hit->t, 3);
  EXPECT_NEAR(sphere->surface(ray, *hit).p.z, -2, 1e-12);
  ASSERT_TRUE(sphere->areaSampler());
  EXPECT_NEAR(sphere->areaSampler()->area(), 16 * std::numbers::pi, 1e-5);

  // So do exceptions.
  const ParamList empty{test::number("zmin", 3), test::number("zmax", 4)};
  Params wrong("shapes/sphere", {}, {&empty});
  try {
    create<Shape>(plugin, wrong, {});
    FAIL() << "a sphere without a surface";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("leaves nothing"), std::string::npos) << error.what();
  }
}

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
