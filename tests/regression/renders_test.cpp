// The regression renders of scenes/ see 1 % more light, and what else can be wrong with a render or
// its golden picture fails in a way that tells what to do.

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>

#include "core/base/image.h"
#include "tests/command.h"

namespace pbrt {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const fs::path kScripts = PBRT_SOURCE_DIR "/cmake";

// Multiplies all light by a factor.
void brighten(const fs::path& from, const fs::path& to, float factor) {
  Image image = readExr(from);
  for (std::size_t c = 0; c < image.names.size(); ++c) {
    if (image.names[c] == "A") continue;
    const float scale = image.names[c].starts_with("Variance.") ? factor * factor : factor;
    for (float& v : image.channels[c]) v *= scale;
  }
  writeImage(to, image);
}

class SceneRender : public testing::TestWithParam<std::string> {};

// A test that cannot fail is none.
TEST_P(SceneRender, SeesOnePercentOfLight) {
  const test::Folder folder;
  const fs::path golden = folder.path() / "golden.exr";
  brighten(fs::path(PBRT_SOURCE_DIR "/tests/golden") / (GetParam() + ".exr"), golden, 1.01f);
  const std::string settings =
      test::contents(fs::path(PBRT_BUILD_DIR "/regression") / GetParam() / PBRT_SETTINGS);
  ASSERT_THAT(settings, HasSubstr(GetParam() + ".exr"));
  folder.write("settings.cmake", settings + "set(golden " + golden.string() + ")\nset(folder " +
                                     folder.path().string() + ")\n");
  const test::Outcome outcome =
      folder.command(PBRT_CMAKE " -Dsettings=" + (folder.path() / "settings.cmake").string() +
                     " -P " + (kScripts / "regression/test.cmake").string());
  EXPECT_EQ(outcome.code, 1) << outcome.out;
  EXPECT_THAT(outcome.out, HasSubstr("noise does not explain the difference"));
}

std::vector<std::string> scenes() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(PBRT_SOURCE_DIR "/scenes"))
    if (entry.path().extension() == ".pbrt") names.push_back(entry.path().stem());
  std::sort(names.begin(), names.end());
  return names;
}

INSTANTIATE_TEST_SUITE_P(All, SceneRender, testing::ValuesIn(scenes()), [](const auto& test) {
  std::string name = test.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

// A user's project with one scene, a ball before a wall.
class Project : public testing::Test {
 protected:
  Project() {
    folder_.write("ball.pbrt", scene("3"));
    describe("ball SCENE ball.pbrt GOLDEN golden/ball.exr WIDTH 16 SPP 16 GOLDEN_SPP 64");
  }

  static std::string scene(const std::string& light) {
    return "LookAt 0 0 -5  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" 40\n"
           "Film \"image\" \"integer xresolution\" 32 \"integer yresolution\" 32\n"
           "Sampler \"random\"\nIntegrator \"whitted\"\nWorldBegin\n"
           "LightSource \"distant\" \"point from\" [1 1 -1] \"rgb L\" [" +
           light + " 2 1]\nShape \"sphere\"\nWorldEnd\n";
  }

  // What follows in the parentheses of pbrt_add_regression_render.
  void describe(const std::string& render) {
    folder_.write("CMakeLists.txt",
                  "cmake_minimum_required(VERSION 3.25)\nproject(user LANGUAGES NONE)\n"
                  "enable_testing()\ninclude(" +
                      (kScripts / "RegressionRenders.cmake").string() +
                      ")\npbrt_add_regression_render(" + render + ")\n");
  }

  test::Outcome configure() {
    return folder_.command(
        PBRT_CMAKE " -G Ninja -S . -B build -DPBRT_EXECUTABLE=" + pbrt_.string() +
        " -DPBRT_DIFF_EXECUTABLE=" PBRT_BUILD_DIR "/bin/pbrt-diff");
  }
  // `./dev golden`, with variables of the environment.
  test::Outcome makeGolden(const std::string& environment = "") {
    const test::Outcome configured = configure();
    EXPECT_EQ(configured.code, 0) << configured.err;
    return folder_.command("env " + environment + " " PBRT_CMAKE " --build build --target golden");
  }
  test::Outcome ctest() {
    const test::Outcome configured = configure();
    EXPECT_EQ(configured.code, 0) << configured.err;
    return folder_.command(PBRT_CTEST " --test-dir build --output-on-failure");
  }
  fs::path golden() const { return folder_.path() / "golden/ball.exr"; }
  fs::path results() const { return folder_.path() / "build/regression/ball"; }

  test::Folder folder_;
  fs::path pbrt_ = test::Folder::program();
};

TEST_F(Project, WithoutAGoldenPictureTheTestTellsHowToMakeIt) {
  const test::Outcome missing = ctest();
  EXPECT_NE(missing.code, 0);
  EXPECT_THAT(missing.out, HasSubstr("no golden picture"));
  const std::string command =
      "PBRT_GOLDEN=ball cmake --build " + (folder_.path() / "build").string() + " --target golden";
  EXPECT_THAT(missing.out, HasSubstr(command));

  EXPECT_THAT(folder_.command("env " + command).out, HasSubstr("ball    new"));
  EXPECT_EQ(ctest().code, 0);
  const Image reference = readExr(golden()), picture = readExr(results() / "test.exr");
  EXPECT_EQ(reference.number("samplesPerPixel", 0), 64);
  EXPECT_EQ(picture.number("samplesPerPixel", 0), 16);
  EXPECT_NE(reference.attributes.at("seed"), picture.attributes.at("seed"));
}

TEST_F(Project, AChangedSceneFailsAndShowsThePictures) {
  makeGolden();
  folder_.write("ball.pbrt", scene("3.3"));
  const test::Outcome outcome = ctest();
  EXPECT_NE(outcome.code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("noise does not explain the difference"));
  for (const char* name : {"test.exr", "test-golden.exr", "test-error.png"}) {
    EXPECT_TRUE(fs::exists(results() / name)) << name;
    EXPECT_THAT(outcome.out, HasSubstr((results() / name).string()));
  }
}

TEST_F(Project, OnlyChangedGoldenPicturesAreReplaced) {
  makeGolden();
  const std::string before = test::contents(golden());
  const test::Outcome same = makeGolden();
  EXPECT_EQ(same.code, 0);
  EXPECT_THAT(same.out, HasSubstr("ball    unchanged  0            0"));
  EXPECT_EQ(test::contents(golden()), before);  // the time of rendering is in it
  makeGolden("PBRT_GOLDEN_ALL=1");
  EXPECT_NE(test::contents(golden()), before);

  folder_.write("ball.pbrt", scene("3.3"));
  EXPECT_THAT(makeGolden().out, HasSubstr("ball    changed"));
  EXPECT_EQ(ctest().code, 0);
}

TEST_F(Project, ASceneThatDoesNotRenderFails) {
  makeGolden();
  const std::string before = test::contents(golden());
  folder_.write("ball.pbrt", "WorldBegin\nShape \"nonsense\"\nWorldEnd\n");
  const test::Outcome outcome = ctest();
  EXPECT_NE(outcome.code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("nonsense"));
  EXPECT_THAT(outcome.out, HasSubstr("pbrt failed (3)"));
  EXPECT_FALSE(fs::exists(results() / "test.exr"));  // none of before

  const test::Outcome update = makeGolden();
  EXPECT_NE(update.code, 0);
  EXPECT_THAT(update.out, HasSubstr("ball    failed"));
  EXPECT_EQ(test::contents(golden()), before);
}

TEST_F(Project, AGoldenPictureWithANanFails) {
  makeGolden();
  Image image = readExr(golden());
  image.channels.back()[7] = std::numeric_limits<float>::quiet_NaN();
  writeImage(golden(), image);
  const test::Outcome outcome = ctest();
  EXPECT_NE(outcome.code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("not finite"));
  EXPECT_THAT(makeGolden().out, HasSubstr("ball    changed"));
  EXPECT_EQ(ctest().code, 0);
}

TEST_F(Project, ABrokenGoldenPictureFails) {
  makeGolden();
  folder_.write("golden/ball.exr", "no picture");
  const test::Outcome outcome = ctest();
  EXPECT_NE(outcome.code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("pbrt-diff failed (4)"));
}

TEST_F(Project, AGoldenPictureWithANanIsNotMade) {
  makeGolden();
  Image image = readExr(golden());
  image.channels[0][7] = std::numeric_limits<float>::quiet_NaN();
  writeImage(folder_.path() / "nan.exr", image);
  const std::string before = test::contents(golden());
  // A pbrt that gives this picture for any scene.
  folder_.write("broken",
                "#!/bin/sh\nwhile [ \"$1\" != --outfile ]; do shift; done\ncp nan.exr \"$2\"\n");
  fs::permissions(folder_.path() / "broken", fs::perms::owner_all);
  pbrt_ = folder_.path() / "broken";
  const test::Outcome outcome = makeGolden();
  EXPECT_NE(outcome.code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("ball    failed"));
  EXPECT_EQ(test::contents(golden()), before);
}

TEST_F(Project, PicturesThatNoTestUsesAreListed) {
  makeGolden();
  fs::copy_file(golden(), folder_.path() / "golden/gone.exr");
  const test::Outcome outcome = makeGolden();
  EXPECT_THAT(outcome.out, HasSubstr("gone    unused"));
  EXPECT_TRUE(fs::exists(folder_.path() / "golden/gone.exr"));
}

TEST_F(Project, RendersOnlyTheChosenOnes) {
  EXPECT_NE(makeGolden("PBRT_GOLDEN=bell").code, 0);
  EXPECT_FALSE(fs::exists(golden()));
  EXPECT_EQ(makeGolden("PBRT_GOLDEN=ball").code, 0);
  EXPECT_TRUE(fs::exists(golden()));
}

TEST_F(Project, OptionsReachPbrt) {
  describe("ball SCENE ball.pbrt GOLDEN golden/ball.exr WIDTH 20 ARGS --cropwindow 0,0.5,0,0.25");
  makeGolden();
  EXPECT_EQ(readExr(golden()).window.hi, Point2i(10, 5));
}

TEST_F(Project, ThePluginPathIsSearchedFirst) {
  describe("ball SCENE ball.pbrt GOLDEN golden/ball.exr PLUGIN_PATH plugins");
  fs::create_directories(folder_.path() / "plugins/shapes");
  folder_.write("plugins/shapes/sphere.so", "no plug-in");
  const test::Outcome outcome = makeGolden();
  EXPECT_THAT(outcome.out, HasSubstr("ball    failed"));
  EXPECT_THAT(outcome.err, HasSubstr("plugins/shapes/sphere.so"));
}

TEST_F(Project, WrongUseIsAnError) {
  for (const char* render :
       {"ball SCENE ball.pbrt", "ball GOLDEN ball.exr", "a/b SCENE a GOLDEN b",
        "ball SCENE a GOLDEN b SAMPLES 3", "ball SCENE a GOLDEN b SPP 0", "ball SCENE a GOLDEN"}) {
    describe(render);
    const test::Outcome outcome = configure();
    EXPECT_NE(outcome.code, 0) << render;
    EXPECT_THAT(outcome.err, HasSubstr("pbrt_add_regression_render")) << render;
  }
}

}  // namespace
}  // namespace pbrt
