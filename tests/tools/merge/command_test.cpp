// pbrt-merge as people use it, with films that pbrt has written.

#include "tests/command.h"

#include <algorithm>
#include <cstring>

#include "core/base/image.h"
#include "tests/tools/foggy_scene.h"

namespace pbrt::test {
namespace {

namespace fs = std::filesystem;

class MergeCommand : public testing::Test {
 protected:
  MergeCommand() { folder_.write("scene.pbrt", foggyScene()); }

  void render(const std::string& arguments) const {
    const Outcome o = folder_.pbrt("--quiet scene.pbrt --aov variance,normal " + arguments);
    ASSERT_EQ(o.code, 0) << o.err;
  }
  Outcome merge(const std::string& arguments, const std::string& before = "") const {
    return folder_.command(before + " " PBRT_BUILD_DIR "/bin/pbrt-merge " + arguments);
  }
  // All but the seconds.
  void expectSamePicture(const std::string& a, const std::string& b) const {
    Image x = readExr(folder_.path() / a), y = readExr(folder_.path() / b);
    x.attributes.erase("renderTimeSeconds");
    y.attributes.erase("renderTimeSeconds");
    EXPECT_EQ(x.attributes, y.attributes);
    EXPECT_EQ(x.names, y.names);
    EXPECT_EQ(x.window, y.window);
    for (std::size_t i = 0; i < std::min(x.names.size(), y.names.size()); ++i)
      EXPECT_EQ(std::memcmp(x.channels[i].data(), y.channels[i].data(),
                            std::min(x.channels[i].size(), y.channels[i].size()) * sizeof(float)),
                0)
          << x.names[i];
  }

  const Folder folder_;
};

TEST_F(MergeCommand, GivesThePictureOfOneProcess) {
  render("--samples 0..4 --spp 4 --outfile whole.exr --outfile whole.film");
  render("--samples 0..1 --spp 4 --outfile a.film --nthreads 1");
  render("--samples 1..4 --spp 4 --outfile b.film --pixelbounds 0,70,0,21");
  render("--samples 1..4 --spp 4 --outfile c.film --pixelbounds 0,70,21,50");
  const Outcome o = merge("c.film a.film b.film --outfile merged.exr --outfile merged.film");
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.out, "merged.exr\nmerged.film\n");
  EXPECT_EQ(o.err, "");
  expectSamePicture("merged.exr", "whole.exr");
  EXPECT_EQ(merge("whole.film --outfile again.exr").code, 0);
  expectSamePicture("again.exr", "whole.exr");

  // A part makes room for the whole.
  EXPECT_EQ(merge("a.film b.film c.film --quiet --outfile a.film").out, "");
  EXPECT_EQ(merge("a.film --outfile last.exr").code, 0);
  expectSamePicture("last.exr", "whole.exr");
  // What is merged can be gone on from.
  render("--samples 0..6 --spp 4 --outfile six.exr");
  render("--samples 0..6 --spp 4 --outfile resumed.exr --checkpoint a.film --resume");
  expectSamePicture("resumed.exr", "six.exr");
}

TEST_F(MergeCommand, FilmsThatScenesNameArePartsOfThem) {
  std::string scene = foggyScene();
  scene.replace(scene.find("out.exr"), 7, "a.film");
  folder_.write("scene.pbrt", scene);
  render("--spp 2 --samples 0..1");
  fs::rename(folder_.path() / "a.film", folder_.path() / "b.film");
  render("--spp 2 --samples 1..2");
  EXPECT_EQ(merge("a.film b.film --outfile x.exr").code, 0);
  render("--spp 2 --samples 1..2 --seed 5");
  EXPECT_EQ(merge("a.film b.film --outfile x.exr").code, 3);
}

TEST_F(MergeCommand, SaysWhatIsWrong) {
  render("--samples 0..1 --outfile a.film");
  render("--samples 1..2 --outfile b.film --seed 5");
  EXPECT_EQ(merge("").code, 2);
  EXPECT_EQ(merge("a.film").code, 2);
  EXPECT_EQ(merge("--outfile x.exr").code, 2);
  EXPECT_EQ(merge("a.film --check --outfile x.exr").code, 2);

  Outcome o = merge("a.film b.film --outfile x.exr");
  EXPECT_EQ(o.code, 3);
  EXPECT_EQ(o.err,
            "error: b.film is no part of the same render as a.film: it has another seed: 5, not "
            "0\n");
  o = merge("a.film --check");
  EXPECT_EQ(o.code, 0);
  EXPECT_EQ(o.err, "warning: the film is not whole: it holds --samples 0..1 of --samples 0..16\n");
  EXPECT_EQ(o.out, "1 film: 1 sample per pixel\n");
  EXPECT_EQ(merge("a.film --check --quiet").err, "");
  EXPECT_EQ(merge("scene.pbrt --outfile x.exr").code, 4);
  EXPECT_EQ(merge("a.film --partial --outfile nowhere/x.exr").code, 4);
  EXPECT_EQ(merge("a.film --outfile nowhere/x.film").code, 4);
  o = merge("a.film --partial --outfile x.txt");
  EXPECT_EQ(o.code, 4);
  EXPECT_FALSE(fs::exists(folder_.path() / "x.exr"));
  EXPECT_EQ(folder_.files(), 3U);
}

// A recipe that forgets a part gets no picture; films are for what is not whole yet.
TEST_F(MergeCommand, MakesPicturesOfPartsOnlyIfTold) {
  render("--samples 0..1 --spp 4 --outfile a.film");
  render("--samples 1..3 --spp 4 --outfile b.film");
  render("--samples 0..4 --spp 4 --pixelbounds 0,70,0,21 --outfile top.film");
  const std::string lacks = "the film is not whole: it holds --samples 0..3 of --samples 0..4";
  Outcome o = merge("--quiet a.film b.film --outfile ab.film --outfile ab.exr");
  EXPECT_EQ(o.code, 3);
  EXPECT_EQ(o.err, "error: " + lacks + "; --partial makes a picture of it all the same\n");
  EXPECT_EQ(merge("top.film --outfile ab.exr").code, 3);
  EXPECT_EQ(folder_.files(), 4U) << "nothing is written";

  o = merge("a.film b.film --outfile ab.film");
  EXPECT_EQ(o.code, 0);
  EXPECT_EQ(o.err, "warning: " + lacks + "\n");
  o = merge("ab.film --partial --outfile ab.exr");
  EXPECT_EQ(o.code, 0);
  EXPECT_EQ(o.err, "warning: " + lacks + "\n");
  render("--samples 0..3 --spp 4 --outfile three.exr");
  expectSamePicture("ab.exr", "three.exr");
}

// What is stored only to tell when the picture is good enough is not shown, but where asked for.
TEST_F(MergeCommand, ShowsWhatPbrtShows) {
  const std::string line = "--quiet scene.pbrt --spp 4 --aov normal";
  const auto run = [&](const std::string& arguments) {
    ASSERT_EQ(folder_.pbrt(line + arguments).code, 0);
  };
  run(" --progress-error --outfile direct.exr --outfile direct.film");
  ASSERT_EQ(merge("direct.film --outfile merged.exr --outfile merged.film").code, 0);
  EXPECT_EQ(readExr(folder_.path() / "direct.exr").channel("Variance.R"), nullptr);
  expectSamePicture("merged.exr", "direct.exr");
  ASSERT_EQ(merge("merged.film --outfile again.exr").code, 0);
  expectSamePicture("again.exr", "direct.exr");

  run(",variance --outfile shown.exr");
  run(" --progress-error --samples 0..1 --outfile a.film");
  run(",variance --samples 1..4 --outfile b.film");
  for (const char* films : {"a.film b.film", "b.film a.film"}) {
    ASSERT_EQ(merge(std::string(films) + " --outfile merged.exr").code, 0);
    expectSamePicture("merged.exr", "shown.exr");
  }
}

TEST_F(MergeCommand, OpensAsManyFilmsAsThereMayBe) {
  render("--samples 0..1 --outfile a.film");
  std::string many;
  for (int i = 0; i < 30; ++i) many += " a.film";
  // The soft limit is raised; the films overlap, but all are open.
  Outcome o = merge(many + " --outfile x.exr", "sh -c 'ulimit -Sn 20; exec \"$@\"' -");
  EXPECT_EQ(o.code, 3);
  EXPECT_NE(o.err.find("hold the same samples"), o.err.npos) << o.err;
  o = merge(many + " --outfile x.exr", "sh -c 'ulimit -n 20; exec \"$@\"' -");
  EXPECT_EQ(o.code, 4);
  EXPECT_NE(o.err.find("30 films are more than this process may have open (20)"), o.err.npos)
      << o.err;
}

}  // namespace
}  // namespace pbrt::test
