// What signals do to a render.

#include <fmt/format.h>

#include <numeric>

#include "core/base/image.h"
#include "core/scene/film_file.h"
#include "tests/tools/foggy_scene.h"
#include "tests/tools/running.h"

namespace pbrt::test {
namespace {

namespace fs = std::filesystem;

// More samples than any of these tests waits for.
constexpr const char* kLong = "--quiet --spp 1000000 --outfile out.exr scene.pbrt ";

class SignalsTest : public testing::Test {
 protected:
  void SetUp() override { folder.write("scene.pbrt", foggyScene()); }
  bool has(const std::string& file) const { return fs::exists(folder.path() / file); }
  Image picture() const { return readExr(folder.path() / "out.exr"); }
  static int number(const Image& image, const std::string& name) {
    const auto found = image.attributes.find(name);
    return found == image.attributes.end() ? -1 : std::get<int>(found->second);
  }

  Folder folder;
};

TEST_F(SignalsTest, InterruptionsSaveWhatThereIs) {
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
    Running render(folder, kLong + std::string("--checkpoint c.film --checkpoint-every 100ms"));
    render.until([&] { return has("c.film"); }).send(signal);
    const Outcome outcome = render.end();
    EXPECT_EQ(outcome.code, 75) << outcome.err;
    EXPECT_TRUE(outcome.err.starts_with("interrupted at ")) << outcome.err;
    EXPECT_TRUE(outcome.err.ends_with(" of 1000000 samples per pixel; go on with --resume\n"))
        << outcome.err;
    const FilmInfo info = FilmReader(folder.path() / "c.film").info();
    const Image image = picture();
    EXPECT_EQ(number(image, "samplesPerPixel"), static_cast<int>(info.endSample));
    if (info.interrupted()) {
      EXPECT_EQ(number(image, "mostSamplesPerPixel"),
                static_cast<int>(std::ranges::max(info.reached)));
    }
    fs::remove(folder.path() / "c.film");
    fs::remove(folder.path() / "out.exr");
  }
}

TEST_F(SignalsTest, WithoutACheckpointThePictureIsLeft) {
  Running render(folder, kLong + std::string("--write-every 10ms"));
  render.until([&] { return has("out.exr"); }).send(SIGTERM);
  const Outcome outcome = render.end();
  EXPECT_EQ(outcome.code, 75);
  EXPECT_NE(outcome.err.find("without --checkpoint, it cannot be continued"), std::string::npos)
      << outcome.err;
  EXPECT_GE(number(picture(), "samplesPerPixel"), 1);
}

TEST_F(SignalsTest, ThePictureOfNoSampleIsNotWritten) {
  folder.write("out.exr", "old");
  Running render(folder, kLong + std::string("--width 1000 --nthreads 1"));
  render.untilItHandles(SIGTERM).send(SIGTERM);
  const Outcome outcome = render.end();
  EXPECT_EQ(outcome.code, 75);
  if (outcome.err.starts_with("interrupted at 0 of"))
    EXPECT_EQ(contents(folder.path() / "out.exr"), "old");
  else
    EXPECT_EQ(number(picture(), "samplesPerPixel"), 0) << outcome.err;
}

TEST_F(SignalsTest, OnRequestItSavesAndGoesOn) {
  Running render(folder, kLong + std::string("--checkpoint c.film --checkpoint-every 1h"));
  double before = 0;
  for (int i = 0; i < 3; ++i) {
    render.untilItHandles(SIGTERM).until([&] {
      render.send(SIGUSR1);  // again if it came while the last was saved, which answered it
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      return has("c.film");
    });
    FilmReader reader(folder.path() / "c.film");
    const FilmInfo info = reader.info();
    double samples = info.endSample;  // of a tile, on average
    if (info.interrupted())
      samples = std::accumulate(info.reached.begin(), info.reached.end(), 0.0) /
                static_cast<double>(info.reached.size());
    EXPECT_GE(samples, before);
    before = samples;
    fs::remove(folder.path() / "c.film");
  }
  EXPECT_FALSE(has("out.exr")) << "the picture was not asked for";
  EXPECT_EQ(render.send(SIGTERM).end().code, 75);
}

TEST_F(SignalsTest, OnRequestWithoutACheckpointItWritesThePicture) {
  Running render(folder, kLong);
  render.untilItHandles(SIGTERM).until([&] {
    render.send(SIGUSR1);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return has("out.exr");
  });
  EXPECT_EQ(render.send(SIGKILL).end().code, 137) << "it went on";
  EXPECT_GE(number(picture(), "samplesPerPixel"), 0);
}

// As soon as anything is read, and over and over: requests never end a render.
TEST_F(SignalsTest, ManyRequestsDoNoHarm) {
  ASSERT_EQ(folder.pbrt("--quiet --spp 8 --outfile wanted.exr scene.pbrt").code, 0);
  Running render(folder, "--quiet --spp 8 --outfile out.exr --checkpoint c.film scene.pbrt");
  render.untilItHandles(SIGUSR1).until([&] {
    render.send(SIGUSR1);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return false;
  });
  const Outcome outcome = render.end();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(picture().channels, readExr(folder.path() / "wanted.exr").channels);
}

TEST_F(SignalsTest, ASecondInterruptEndsAtOnce) {
  std::string scene = foggyScene();  // whose first sample waits for ever
  const std::string sampler = "Sampler \"halton\"";
  scene.replace(scene.find(sampler), sampler.size(),
                "Sampler \"faulty\" \"string fault\" \"hangs\"");
  folder.write("scene.pbrt", scene);
  Running render(folder, kLong + std::string("--plugin-path " PBRT_BUILD_DIR "/tests/bad_plugins"));
  render.untilItHandles(SIGINT).send(SIGINT);
  const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  render.until(
      [&] { return !render.handles(SIGINT) || std::chrono::steady_clock::now() > patience; });
  ASSERT_FALSE(render.handles(SIGINT)) << "it would not end";
  EXPECT_EQ(render.send(SIGINT).end().code, 128 + SIGINT);
}

// While the scene is read there is nothing to save.
TEST_F(SignalsTest, BeforeRenderingTheySimplyEndIt) {
  Running render(folder, "--quiet --outfile out.exr");  // waits for standard input
  render.untilItHandles(SIGUSR1).send(SIGTERM);
  EXPECT_EQ(render.end().code, 128 + SIGTERM);
  EXPECT_FALSE(has("out.exr"));
}

TEST_F(SignalsTest, WhatWasIgnoredStaysSo) {
  const std::string line =
      "sh -c 'trap \"\" HUP INT; " + Folder::program() +
      " --quiet --spp 40 --outfile out.exr scene.pbrt & p=$!; "
      "until grep -q \"SigCgt:.*[4-7c-f]...$\" /proc/$p/status; do kill -0 $p || break; done; "
      "kill -HUP $p; kill -INT $p; wait $p'";
  const Outcome outcome = folder.command(line);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(number(picture(), "samplesPerPixel"), 40);
}

}  // namespace
}  // namespace pbrt::test
