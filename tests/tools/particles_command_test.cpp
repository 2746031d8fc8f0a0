// pbrt-particles as a user runs it: what it leaves behind, what it prints, how it ends.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "core/base/image.h"
#include "shapes/metaballs/particles/particles.h"
#include "tests/command.h"

namespace pbrt::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Command : public testing::Test {
 protected:
  Outcome run(const std::string& arguments) const {
    return folder.command(PBRT_BUILD_DIR "/bin/pbrt-particles " + arguments);
  }
  fs::path at(const std::string& name) const { return folder.path() / name; }
  // The lines of the run's own; it must have gone well.
  std::vector<std::string> lines(const std::string& text) const {
    std::istringstream in(text);
    std::vector<std::string> all;
    for (std::string line; std::getline(in, line);) all.push_back(line);
    return all;
  }

  Folder folder;
};

// A quick run.
const std::string kSmall = "--motion ring --atoms 100 --particles 500 --settle 3 --size 40x30 ";
const std::string kDam = "--atoms 300 --particles 3000 --settle 3 --size 90x70 --frames 1-8 ";

// Where the field (1 - r^2)^3 of a lone atom is a half.
const double kBall = std::sqrt(1 - std::cbrt(0.5));
const std::string kBallFile = "ball#.csv --kernel wyvill --radius 1 --threshold 0.5 ";

TEST_F(Command, LeavesAPictureAFrameAndItsFigures) {
  const Outcome outcome = run(kSmall + "--frames 9-11 --out f#.png --stats s.csv");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(folder.files(), 4U);
  for (const char* name : {"f9.png", "f10.png", "f11.png"})
    EXPECT_EQ(readImage(at(name)).resolution, Point2i(40, 30));
  EXPECT_NE(contents(at("f9.png")), contents(at("f11.png"))) << "drops move";

  const std::vector<std::string> rows = lines(contents(at("s.csv")));
  ASSERT_EQ(rows.size(), 4U);
  const auto columns = std::ranges::count(rows[0], ',');
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_EQ(std::ranges::count(rows[i], ','), columns);
    EXPECT_TRUE(rows[i].starts_with(fmt::format("{},100,500,", 8 + i))) << rows[i];
    EXPECT_EQ(rows[i].find("nan"), std::string::npos) << rows[i];
  }
  const std::vector<std::string> said = lines(outcome.out);
  ASSERT_EQ(said.size(), 6U) << "a head, a line a frame, and two of sums";
  EXPECT_THAT(said[4], HasSubstr("3 frames: "));
  for (const char c : outcome.out) EXPECT_TRUE(c == '\n' || c >= ' ') << int(c);
}

TEST_F(Command, SaysNothingIfQuiet) {
  const Outcome outcome = run(kSmall + "--frames 1-2 --quiet");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out + outcome.err, "");
  EXPECT_EQ(folder.files(), 0U);
}

TEST_F(Command, GivesTheSameBitsForAnyNumberOfThreads) {
  for (const char* suffix : {"ply", "exr"}) {
    for (const char* threads : {"1", "2", "5"}) {
      const Outcome outcome =
          run(kDam + fmt::format("--nthreads {0} --out {0}-#.{1}", threads, suffix));
      ASSERT_EQ(outcome.code, 0) << outcome.err;
    }
    for (int frame = 1; frame <= 8; ++frame) {
      const std::string one = contents(at(fmt::format("1-{}.{}", frame, suffix)));
      EXPECT_FALSE(one.empty());
      EXPECT_TRUE(one == contents(at(fmt::format("2-{}.{}", frame, suffix)))) << frame << suffix;
      EXPECT_TRUE(one == contents(at(fmt::format("5-{}.{}", frame, suffix)))) << frame << suffix;
    }
  }
}

TEST_F(Command, PutsSurfelsOntoTheSurfaceOfAFile) {
  folder.write("ball7.csv", "x,y,z\n10,0,0\n");
  const Outcome outcome = run(kBallFile + "--particles 1000 --out s.ply");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Particles surfels = readParticles(at("s.ply"));
  ASSERT_EQ(surfels.positions.size(), 1000U);
  Vec3 mean(0);
  for (const Point3& p : surfels.positions) {
    EXPECT_NEAR(glm::distance(p, Point3(10, 0, 0)), kBall, 1e-3);
    mean += (p - Point3(10, 0, 0)) / 1000.F;
  }
  EXPECT_LT(glm::length(mean), 0.02F) << "all around it";
}

TEST_F(Command, SeesABallWhereItIs) {
  folder.write("ball7.csv", "x,y,z\n0,0,0\n");
  constexpr int kSize = 101;
  const Outcome outcome =
      run(kBallFile + fmt::format("--eye 0,0,-5 --look 0,0,0 --fov 20 --size {0}x{0} --particles "
                                  "4000 --settle 60 --background 0.25,0.5,0.75 --out s.exr",
                                  kSize));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Image image = readExr(at("s.exr"));
  const auto channel = [&](const char* name) -> const std::vector<float>& {
    return *image.channel(name);
  };
  const double pixel = 2 * std::tan(10 * std::numbers::pi / 180) / kSize;
  const double cosineOfRim = std::sqrt(1 - kBall * kBall / 25);
  int wrong = 0;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const auto i = static_cast<std::size_t>(y) * kSize + x;
      const DVec3 d = glm::normalize(
          DVec3((x + 0.5 - kSize / 2.0) * pixel, -(y + 0.5 - kSize / 2.0) * pixel, 1));
      const bool met = d.z > cosineOfRim;
      // A pixel or so at the rim may go either way.
      if (std::abs(std::acos(d.z) - std::acos(cosineOfRim)) < 1.5 * pixel) continue;
      wrong += (channel("A")[i] == 1) != met;
      if (!met) {
        EXPECT_EQ(channel("G")[i], 0.5F);
        continue;
      }
      const double t = 5 * d.z - std::sqrt(25 * d.z * d.z - 25 + kBall * kBall);
      const DVec3 n = (t * d - DVec3(0, 0, 5)) / kBall;
      if (-glm::dot(n, d) < 0.3) continue;
      EXPECT_NEAR(channel("Z")[i], t, 2e-3);
      EXPECT_LT(glm::distance(DVec3(channel("N.X")[i], channel("N.Y")[i], channel("N.Z")[i]), n),
                0.02);
    }
  EXPECT_EQ(wrong, 0);
}

TEST_F(Command, ShowsTheSkyWhereThereIsNoSurface) {
  folder.write("ball1.csv", "x,y,z\n0,0,0\n");
  const Outcome outcome =
      run("ball#.csv --kernel wyvill --radius 1 --threshold 2 --particles 100 --size 9x9 "
          "--background 0.25,0.5,0.75 --out s.exr --stats s.csv");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(contents(at("s.csv")).find("nan"), std::string::npos) << contents(at("s.csv"));
  const Image image = readExr(at("s.exr"));
  for (const float a : *image.channel("A")) EXPECT_EQ(a, 0);
  for (const float red : *image.channel("R")) EXPECT_EQ(red, 0.25F);
}

TEST_F(Command, RefusesWhatMakesNoSense) {
  const std::pair<const char*, const char*> wrong[] = {
      {"--motion rinf", "did you mean \"ring\""},
      {"--frames 5-1", "the last is before the first"},
      {"--frames 0-5", "the first frame is 1"},
      {"--frames 1..5", "1-120"},
      {"--frames 1-5x", "1-120"},
      {"--frames 99999999999", "1-120"},
      {"--particles 0", "not in range"},
      {"--particles 18446744073709551615", "particles"},
      {"--size 0x5", "512x512"},
      {"--size 512", "512x512"},
      {"--size 16384x1x1", "512x512"},
      {"--eye 1,2", "--eye"},
      {"--eye=nan,1,2", "finite"},
      {"--eye 0,5,0 --look 0,0,0", "looks nowhere"},
      {"--fov 180", "not in range"},
      {"--fps nan", "above 0"},
      {"--radius 1", "requires files"},
      {"--atoms 3", "100 to a million"},
      {"fluid#.ply --motion dam", "excludes"},
      {"--out a.png", "frames/####.png"},
      {"--out '#.jpg'", ".ply"},
  };
  for (const auto& [arguments, reason] : wrong) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_THAT(outcome.err + outcome.out, HasSubstr(reason)) << arguments;
  }
  EXPECT_EQ(folder.files(), 0U);
}

TEST_F(Command, NamesFilesThatCannotBeReadOrWritten) {
  for (const char* arguments :
       {"'nowhere#.ply'", "--out 'nowhere/#.png'", "--stats nowhere/s.csv"}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 4) << arguments;
    EXPECT_THAT(outcome.err, HasSubstr("nowhere"));
  }
}

// The frames before the fault are there, and nothing else.
TEST_F(Command, KeepsWhatWasMadeBeforeAFault) {
  fs::create_directory(at("f3.png"));
  const Outcome outcome = run(kSmall + "--frames 1-30 --out 'f#.png'");
  EXPECT_EQ(outcome.code, 4);
  EXPECT_THAT(outcome.err, HasSubstr("f3.png"));
  EXPECT_EQ(folder.files(), 3U);
  EXPECT_EQ(readImage(at("f2.png")).resolution, Point2i(40, 30));

  for (const char* name : {"in1.csv", "in2.csv", "in4.csv"}) folder.write(name, "x,y,z\n0,0,0\n");
  const Outcome gap = run("'in#.csv' --radius 1 --particles 100 --size 9x9 --out 'g#.png'");
  EXPECT_EQ(gap.code, 4);
  EXPECT_THAT(gap.err, HasSubstr("in3.csv"));
  EXPECT_FALSE(fs::exists(at("g3.png")));
}

TEST_F(Command, EndsBetweenFramesIfAsked) {
  const Outcome outcome = folder.command(
      "sh -c '" PBRT_BUILD_DIR "/bin/pbrt-particles " + kSmall +
      "--frames 1-1000000 --out f#.png --stats s.csv & pid=$!; until [ -e f5.png ]; do sleep 0.01; "
      "done; kill -TERM $pid; wait $pid'");
  EXPECT_EQ(outcome.code, 128 + SIGTERM) << outcome.err;
  const std::size_t frames = lines(contents(at("s.csv"))).size() - 1;
  EXPECT_GE(frames, 5U);
  EXPECT_EQ(folder.files(), frames + 1) << "every frame made, and nothing half done";
  for (std::size_t i = 1; i <= frames; ++i)
    EXPECT_EQ(readImage(at(fmt::format("f{}.png", i))).resolution, Point2i(40, 30));
}

TEST_F(Command, HelpsByExamples) {
  const Outcome outcome = run("--help");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("pbrt-particles --motion split --out frames/####.png"));
}

}  // namespace
}  // namespace pbrt::test
