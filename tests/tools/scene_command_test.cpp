// --check, --permissive, --format and --describe all, run as a user runs them.

#include "tests/command.h"

namespace pbrt::test {
namespace {

namespace fs = std::filesystem;

const std::string kScene = R"(Film "rgb" "integer xresolution" 8 "integer yresolution" 8
    "string filename" "out.exr"
Camera "perspective"
WorldBegin
Material "diffuse" "texture reflectance" "wood"
LightSource "point"
Translate 0 0 3
Shape "sphere"
Shape "spheer"
)";

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Check, TellsAllThatIsWrongAndRendersNothing) {
  const Folder folder;
  folder.write("scene.pbrt", kScene);
  const Outcome outcome = folder.pbrt("--check scene.pbrt");
  EXPECT_EQ(outcome.code, 3);
  EXPECT_TRUE(contains(outcome.err, "scene.pbrt:5:42: error: there is")) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "there is no shape \"spheer\"; did you mean \"sphere\"?"));
  EXPECT_TRUE(outcome.err.ends_with("2 errors\n"));
  EXPECT_EQ(folder.files(), 1U);
}

TEST(Check, SaysWhatASceneIs) {
  const Folder folder;
  folder.write("scene.pbrt",
               "WorldBegin\nLightSource \"point\"\nObjectBegin \"o\" Shape \"sphere\"\n"
               "ObjectEnd ObjectInstance \"o\" ObjectInstance \"o\"");
  const Outcome outcome = folder.pbrt("--check scene.pbrt");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.err, "warning: the scene has no Camera: it is seen from 0 0 0 along +z\n");
  EXPECT_TRUE(outcome.out.starts_with("scene.pbrt: pbrt-v4 (it has no WorldEnd); 1 shape"));
  EXPECT_TRUE(contains(outcome.out, "2 instances")) << outcome.out;
  const Outcome asV2 = folder.pbrt("--check --dialect v2 scene.pbrt");
  EXPECT_TRUE(contains(asV2.out, "pbrt-v2 (--dialect says so)"));
  EXPECT_TRUE(contains(asV2.err, "the file ends without WorldEnd"));
}

TEST(Permissive, RendersWhatCanBeAndCountsTheRest) {
  const Folder folder;
  folder.write("scene.pbrt", kScene + "Include \"nothing.pbrt\"\n");
  const Outcome strict = folder.pbrt("scene.pbrt --quiet");
  EXPECT_EQ(strict.code, 3);
  EXPECT_EQ(folder.files(), 1U);
  const Outcome outcome = folder.pbrt("--permissive scene.pbrt --quiet --spp 1");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(contains(outcome.err, "nothing.pbrt")) << outcome.err;
  EXPECT_TRUE(
      outcome.err.ends_with("3 errors passed over: the picture is not what the scene asks for\n"))
      << outcome.err;
  EXPECT_TRUE(fs::exists(folder.path() / "out.exr"));
}

TEST(Permissive, TellsTheSameErrorOnlySoOften) {
  const Folder folder;
  std::string text = "WorldBegin\n";
  for (int i = 0; i < 1000; ++i) text += "ObjectInstance \"nothing\"\n";
  folder.write("scene.pbrt", text);
  const Outcome outcome = folder.pbrt("--check scene.pbrt");
  EXPECT_TRUE(contains(outcome.err, "more errors are not shown")) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "1000 errors"));
  EXPECT_LT(outcome.err.size(), 20000U);
}

// The normal form of each of our scenes is read as the scene itself, to the bit.
TEST(Format, RendersTheSamePicture) {
  const fs::path scenes = fs::path(PBRT_SOURCE_DIR) / "scenes";
  int tried = 0;
  for (const auto& entry : fs::directory_iterator(scenes)) {
    if (entry.path().extension() != ".pbrt") continue;
    const Folder folder;
    const std::string name = entry.path().string(), out = folder.path().string();
    const auto render = [&](const std::string& command, const std::string& picture) {
      // Files that the scene names are found from its folder, in which the text is read.
      return folder
          .command("sh -c 'cd \"" + scenes.string() + "\" && " + command +
                   " --quiet --width 24 "
                   "--spp 1 --outfile " +
                   out + "/" + picture + "'")
          .code;
    };
    ASSERT_EQ(render(Folder::program() + " " + name, "a.exr"), 0) << name;
    ASSERT_EQ(render(Folder::program() + " --format " + name + " | " + Folder::program(), "b.exr"),
              0)
        << name;
    EXPECT_EQ(folder.command(PBRT_BUILD_DIR "/bin/pbrt-diff --quiet a.exr b.exr").code, 0) << name;
    ++tried;
  }
  EXPECT_GE(tried, 12);
}

TEST(Docs, PluginsAreDescribedAsTheyAre) {
  const Outcome outcome = Folder().pbrt("--describe all");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(outcome.out == contents(fs::path(PBRT_SOURCE_DIR) / "docs" / "plugins.md"))
      << "docs/plugins.md is out of date: ./dev docs makes it anew";
}

}  // namespace
}  // namespace pbrt::test
