// Renders that are saved and gone on with.

#include <fmt/format.h>

#include "core/base/image.h"
#include "core/scene/film_file.h"
#include "core/scene/film_pixel.h"
#include "tests/tools/foggy_scene.h"
#include "tests/tools/running.h"
#include "tests/tools/same_picture.h"

namespace pbrt::test {
namespace {

namespace fs = std::filesystem;

class Checkpoint : public testing::Test {
 protected:
  void SetUp() override { folder.write("scene.pbrt", foggyScene()); }
  Outcome pbrt(const std::string& arguments) const {
    return folder.pbrt("--quiet " + arguments + " scene.pbrt");
  }
  void run(const std::string& arguments) const {
    const Outcome outcome = pbrt(arguments);
    EXPECT_EQ(outcome.code, 0) << arguments << outcome.err;
    EXPECT_EQ(outcome.out + outcome.err, "");
  }
  Image picture(const std::string& name) const { return readExr(folder.path() / name); }
  FilmInfo info(const std::string& name) const { return FilmReader(folder.path() / name).info(); }
  bool has(const std::string& name) const { return fs::exists(folder.path() / name); }
  std::string bytes(const std::string& name) const { return contents(folder.path() / name); }

  Folder folder;
};

TEST_F(Checkpoint, GoesOnToTheSamePicture) {
  const std::string stored = "--aov variance,albedo,normal,depth,samples ";
  for (const char* sampler : {"random", "halton", "stratified"})
    for (const char* filter : {"gaussian", "box"}) {
      folder.write("scene.pbrt", foggyScene(sampler, filter));
      const std::string parts = stored + "--spp 6 --checkpoint c.film --outfile parts.exr ";
      run(stored + "--spp 6 --outfile once.exr");
      run(parts + "--samples 0..1 --nthreads 1");
      run(parts + "--samples 0..4 --nthreads 3 --resume");
      run(parts + "--nthreads 2 --resume");
      expectSamePicture(picture("once.exr"), picture("parts.exr"));
      EXPECT_FALSE(info("c.film").interrupted());
      EXPECT_EQ(info("c.film").endSample, 6U);
      fs::remove(folder.path() / "c.film");
    }
}

TEST_F(Checkpoint, InterruptedAnywhereGoesOnToTheSamePicture) {
  run("--spp 48 --aov variance --outfile once.exr");
  const std::string parts = "--spp 48 --aov variance --checkpoint c.film --outfile parts.exr ";
  bool uneven = false;
  int code = 75;
  for (int i = 0; code == 75 && i < 100; ++i) {
    Running render(folder,
                   parts + fmt::format("--quiet --resume --nthreads {} scene.pbrt", 1 + i % 3));
    render.untilItHandles(SIGTERM);
    std::this_thread::sleep_for(std::chrono::milliseconds(20 + 10 * i));
    const Outcome outcome = render.send(SIGTERM).end();
    code = outcome.code;
    if (code == 75 && has("c.film")) uneven |= info("c.film").interrupted();
  }
  EXPECT_EQ(code, 0);
  EXPECT_TRUE(uneven) << "no interruption came in the midst of a pass";
  expectSamePicture(picture("once.exr"), picture("parts.exr"));
}

TEST_F(Checkpoint, WhatIsCompleteIsOnlyWrittenAgain) {
  const std::string line = "--spp 3 --checkpoint c.film --outfile out.exr ";
  run(line);
  const std::string film = bytes("c.film");
  const Image first = picture("out.exr");
  fs::remove(folder.path() / "out.exr");
  run(line + "--resume");
  expectSamePicture(first, picture("out.exr"));
  EXPECT_EQ(bytes("c.film"), film);
}

TEST_F(Checkpoint, BeginsIfThereIsNone) {
  const Outcome loud =
      folder.pbrt("--progress none --spp 1 --checkpoint c.film --resume scene.pbrt");
  EXPECT_EQ(loud.code, 0);
  EXPECT_EQ(loud.err, "note: c.film is not there yet: the render begins\n");
  fs::remove(folder.path() / "c.film");
  run("--spp 1 --checkpoint c.film --resume");
  EXPECT_EQ(info("c.film").endSample, 1U);
}

TEST_F(Checkpoint, NothingThatIsThereIsWrittenOver) {
  run("--spp 4 --samples 0..2 --checkpoint c.film --outfile out.exr");
  const std::string film = bytes("c.film");
  folder.write("other.pbrt", foggyScene() + "# another byte\n");
  const std::vector<std::tuple<std::string, int, std::string>> cases = {
      {"--spp 4 scene.pbrt", 3, "is there already"},
      {"--spp 4 --resume other.pbrt", 3, "another scene"},
      {"--spp 5 --resume scene.pbrt", 3, "spreads 4 samples"},
      {"--spp 4 --seed 7 --resume scene.pbrt", 3, "another seed"},
      {"--spp 4 --width 60 --resume scene.pbrt", 3, "70 x 50 pixels"},
      {"--spp 4 --aov depth --resume scene.pbrt", 3, "depth"},
      {"--spp 4 --pixelbounds 0,9,0,9 --resume scene.pbrt", 3, "it has the pixels 0,70,0,50"},
      {"--spp 4 --samples 1..4 --resume scene.pbrt", 3, "first sample is 0, not 1"},
      {"--spp 4 --samples 0..1 --resume scene.pbrt", 3, "2 samples per pixel, more than the 1"}};
  for (const auto& [arguments, code, reason] : cases) {
    const Outcome outcome =
        folder.pbrt("--quiet --checkpoint c.film --outfile out2.exr " + arguments);
    EXPECT_EQ(outcome.code, code) << arguments << outcome.err;
    EXPECT_NE(outcome.err.find(reason), std::string::npos) << arguments << outcome.err;
    EXPECT_NE(outcome.err.find("c.film"), std::string::npos) << outcome.err;
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    EXPECT_EQ(bytes("c.film"), film);
    EXPECT_FALSE(has("out2.exr"));
  }
}

TEST_F(Checkpoint, DamagedOnesAreRefusedAndKept) {
  run("--spp 2 --checkpoint c.film --outfile out.exr");
  const std::string film = bytes("c.film");
  std::string flipped = film;
  flipped[film.size() * 2 / 3] ^= 1;
  for (const std::string& bad : {std::string(), std::string("no film"), film.substr(0, 100),
                                 film.substr(0, film.size() - 1), film + "x", flipped}) {
    folder.write("c.film", bad);
    const Outcome outcome = pbrt("--spp 2 --checkpoint c.film --resume --outfile out2.exr");
    EXPECT_EQ(outcome.code, 3) << outcome.err;
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    EXPECT_EQ(bytes("c.film"), bad);
    EXPECT_FALSE(has("out2.exr"));
  }
}

TEST_F(Checkpoint, FilmsAreOutputsToo) {
  run("--spp 3 --checkpoint c.film --outfile out.exr");
  run("--spp 3 --outfile part.film");
  run("--spp 3 --outfile both.exr --outfile both.film");
  EXPECT_EQ(folder.files(), 6U);
  expectSamePicture(picture("out.exr"), picture("both.exr"));
  // The rows, between the header, which tells the time, and the hash.
  const auto rows = [&](const std::string& name) {
    const std::string film = bytes(name);
    constexpr std::size_t kRows = 70 * 50 * sizeof(PictureSums), kHash = 8;
    return film.size() > kRows + kHash ? film.substr(film.size() - kRows - kHash, kRows) : "";
  };
  EXPECT_FALSE(rows("part.film").empty());
  EXPECT_EQ(rows("part.film"), rows("both.film"));
  EXPECT_EQ(rows("part.film"), rows("c.film"));
  run("--spp 3 --checkpoint part.film --resume --outfile again.exr");
  expectSamePicture(picture("out.exr"), picture("again.exr"));
}

TEST_F(Checkpoint, TimeCountsAllRuns) {
  const std::string line = "--time 300ms --checkpoint c.film --outfile out.exr ";
  run(line);
  const FilmInfo before = info("c.film");
  EXPECT_GT(before.seconds, 0);
  run(line + "--resume");
  EXPECT_EQ(info("c.film").endSample, before.endSample);
  run("--samples 0.." + std::to_string(before.endSample + 1) +
      " --checkpoint c.film --resume --outfile out.exr");
  EXPECT_GT(info("c.film").seconds, before.seconds);
}

TEST_F(Checkpoint, TheTargetErrorIsReachedWithTheSameSamples) {
  const std::string goal = "--target-error 0.2 ";
  run(goal + "--outfile once.exr");
  int code = 75;
  for (int i = 0; code == 75 && i < 100; ++i) {
    Running render(folder,
                   goal + "--quiet --checkpoint c.film --resume --outfile parts.exr scene.pbrt");
    render.untilItHandles(SIGTERM);
    std::this_thread::sleep_for(std::chrono::milliseconds(30 + 10 * i));
    code = render.send(SIGTERM).end().code;
  }
  EXPECT_EQ(code, 0);
  expectSamePicture(picture("once.exr"), picture("parts.exr"));
}

// It is tried again; in the end it is an error, but the picture is there.
TEST_F(Checkpoint, RendersOnWhereItCannotBeSaved) {
  Running render(folder,
                 "--quiet --spp 60 --checkpoint c.film --checkpoint-every 100ms "
                 "--outfile out.exr scene.pbrt");
  render.until([&] { return has("c.film"); });
  fs::remove(folder.path() / "c.film");
  fs::create_directory(folder.path() / "c.film");
  const Outcome outcome = render.end();
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  EXPECT_NE(outcome.err.find("cannot write c.film"), std::string::npos) << outcome.err;
  EXPECT_EQ(std::get<int>(picture("out.exr").attributes.at("samplesPerPixel")), 60);
}

TEST_F(Checkpoint, AllThatCannotBeWrittenIsTold) {
  Running render(folder, "--quiet --spp 1000000 --checkpoint c.film --outfile out.exr scene.pbrt");
  render.untilItHandles(SIGTERM);
  fs::create_directory(folder.path() / "c.film");
  fs::create_directory(folder.path() / "out.exr");
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  render.send(SIGTERM);
  const Outcome outcome = render.end();
  EXPECT_EQ(outcome.code, 4);
  EXPECT_NE(outcome.err.find("cannot write out.exr"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("cannot write c.film"), std::string::npos) << outcome.err;
}

TEST_F(Checkpoint, WrongWordsAreUsageErrors) {
  for (const char* words :
       {"--resume", "--checkpoint-every 5s", "--checkpoint",
        "--checkpoint c.film --checkpoint-every 0", "--checkpoint c.film --checkpoint-every 99ms",
        "--checkpoint out.exr --outfile out.exr", "--checkpoint c.film --checkpoint-every soon"}) {
    const Outcome outcome = folder.pbrt(std::string("scene.pbrt ") + words);
    EXPECT_EQ(outcome.code, 2) << words << outcome.err;
    EXPECT_EQ(folder.files(), 1U);
  }
  EXPECT_EQ(pbrt("--checkpoint nowhere/c.film").code, 4);
  fs::create_directory(folder.path() / "c.film");
  EXPECT_EQ(pbrt("--checkpoint c.film --resume").code, 4);
}

}  // namespace
}  // namespace pbrt::test
