// Frames of an animation, as the command renders them.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/resource.h>

#include <sstream>

#include "tests/tools/frames_scene.h"

namespace pbrt::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class FramesTest : public Frames {
 protected:
  // The names of the pictures, in the order in which they were made.
  std::string rendered(const std::string& arguments) const {
    const Outcome outcome = folder.pbrt("--outfile '#.png' scene.pbrt --frames " + arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    std::string names;
    std::istringstream lines(outcome.out);
    for (std::string line; std::getline(lines, line); fs::remove(folder.path() / line))
      names += line.substr(0, line.find('.')) + ' ';
    EXPECT_EQ(folder.files(), 1U) << "no other picture";
    return names;
  }
};

TEST_F(FramesTest, RangesStepsAndLists) {
  EXPECT_EQ(rendered("7"), "7 ");
  EXPECT_EQ(rendered("0-3"), "0 1 2 3 ");
  EXPECT_EQ(rendered("1-10:4"), "1 5 9 ");
  EXPECT_EQ(rendered("1-9:4"), "1 5 9 ");
  EXPECT_EQ(rendered("5-5:3"), "5 ");
  EXPECT_EQ(rendered("3,1-4,20"), "3 1 2 4 20 ") << "in this order, each once";
  EXPECT_EQ(rendered("2147483646-2147483647"), "2147483646 2147483647 ");
}

TEST_F(FramesTest, WrongRangesAreOneClearLine) {
  for (const char* range : {"5-1",   "1-",     "-3",  "1-999999999999", "",          "a",    "1..3",
                            "1-3:0", "1-3:-1", "7:2", "1,,2",           "1,",        ",1",   "1-3:",
                            "1 - 3", "0x7",    "1.5", "2147483648",     "0-1000000", "1-2-3"}) {
    const Outcome outcome =
        folder.pbrt(fmt::format("'--frames={}' --outfile '#.png' scene.pbrt", range));
    EXPECT_EQ(outcome.code, 2) << range << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("--frames")) << range;
    EXPECT_LT(outcome.err.find('\n'), 160U) << outcome.err;
    EXPECT_EQ(folder.files(), 1U);
  }
}

TEST_F(FramesTest, FramesNeedNamesOfTheirOwn) {
  for (const char* arguments :
       {"--frames 1-2", "--frames 7 --outfile a.png",
        "--frames 1-2 --outfile '#.png' --outfile b.exr",
        "--frames 1-2 --outfile '#.exr' --checkpoint a.film",
        "--frames 1 --outfile '#.film' --checkpoint './##.film' --resume --skip-existing",
        "--frames 1-2 --outfile '#.exr' --write-every 1s", "--frames 1-2 --outfile '#.exr' -",
        "--skip-existing --outfile a.exr", "--fps 24 --outfile a.exr",
        "--frames 1 --outfile '#.exr' --fps 0"}) {
    const Outcome outcome = folder.pbrt(std::string(arguments) + " scene.pbrt");
    EXPECT_EQ(outcome.code, 2) << arguments << outcome.err;
    EXPECT_EQ(folder.files(), 1U) << arguments;
  }
}

TEST_F(FramesTest, OneAloneIsTheSameAsInARun) {
  folder.write("scene.pbrt", scene("Include \"at##.pbrt\" Shape \"sphere\""));
  for (int i = 8; i <= 11; ++i)
    folder.write(fmt::format("at{:02}.pbrt", i), fmt::format("Translate {} 0 0", i - 9));
  EXPECT_EQ(folder.pbrt("--frames 8-11 --outfile 'run###.exr' scene.pbrt").code, 0);
  for (const int i : {8, 10, 11}) {
    EXPECT_EQ(folder.pbrt(fmt::format("--frames {} --outfile alone#.exr scene.pbrt", i)).code, 0);
    const std::string run = fmt::format("run{:03}.exr", i);
    EXPECT_EQ(channels(fmt::format("alone{}.exr", i)), channels(run));
    folder.write("still.pbrt", scene(fmt::format("Translate {} 0 0 Shape \"sphere\"", i - 9)));
    EXPECT_EQ(folder.pbrt("--outfile still.exr still.pbrt").code, 0);
    EXPECT_EQ(channels("still.exr"), channels(run));
  }
  EXPECT_NE(channels("run008.exr"), channels("run011.exr"));
}

// A fluid's particles, a scene's own name, a texture's: all strings have the number.
TEST_F(FramesTest, EveryStringHasTheNumber) {
  const std::string fluid =
      "Shape \"metaballs\" \"string filename\" \"{}\" \"float radius\" 1.5 "
      "\"string kernel\" \"wyvill\"";
  for (const int i : {1, 2}) {
    folder.write(fmt::format("fluid{:04}.xyz", i), fmt::format("{} 0 0\n0 0 {}\n", i, i));
    folder.write(fmt::format("s{}.pbrt", i),
                 scene("Texture \"t1\" \"color\" \"constant\" \"rgb value\" [0.1 0.5 0.9]\n"
                       "Texture \"t2\" \"color\" \"constant\" \"rgb value\" [0.9 0.5 0.1]\n"
                       "Material \"matte\" \"texture Kd\" \"t#\"" +
                       fmt::format(fmt::runtime(fluid), "fluid####.xyz")));
    folder.write("still.pbrt",
                 scene(fmt::format("Material \"matte\" \"rgb Kd\" [{} 0.5 {}]", i == 1 ? 0.1 : 0.9,
                                   i == 1 ? 0.9 : 0.1) +
                       fmt::format(fmt::runtime(fluid), fmt::format("fluid{:04}.xyz", i))));
    EXPECT_EQ(folder.pbrt(fmt::format("--outfile still{}.exr still.pbrt", i)).code, 0);
  }
  const Outcome outcome = folder.pbrt("--frames 1-2 --outfile '#.exr' 's#.pbrt'");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  for (const int i : {1, 2})
    EXPECT_EQ(channels(fmt::format("{}.exr", i)), channels(fmt::format("still{}.exr", i)));
  EXPECT_NE(channels("1.exr"), channels("2.exr"));
}

// One that an included file names is looked for beside that file, then beside the scene.
TEST_F(FramesTest, TheFolderOfASceneHasTheNumberToo) {
  ASSERT_EQ(folder.pbrt("--outfile a.png scene.pbrt").code, 0);
  fs::create_directories(folder.path() / "shot01" / "parts");
  fs::rename(folder.path() / "a.png", folder.path() / "shot01" / "a.png");
  folder.write("shot01/scene.pbrt", scene("Include \"parts/part.pbrt\""));
  folder.write("shot01/parts/part.pbrt",
               "Texture \"a\" \"color\" \"imagemap\" \"string filename\" \"a.png\"\n"
               "Material \"matte\" \"texture Kd\" \"a\" Shape \"sphere\"\n");
  const Outcome outcome = folder.pbrt("--frames 1 --outfile '#.exr' 'shot##/scene.pbrt'");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
}

TEST_F(FramesTest, WithoutFramesANumberSignIsOne) {
  folder.write("##.pbrt", scene("Include \"a#.pbrt\""));
  folder.write("a#.pbrt", "Shape \"sphere\"");
  const Outcome outcome = folder.pbrt("--outfile '#.exr' '##.pbrt'");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(there("#.exr"));
}

// The ball goes 3 units in a second; --fps 4 takes the frames 0, 2 and 4 at 0, 0.5 and 1 second.
TEST_F(FramesTest, TimeGoesOn) {
  folder.write("scene.pbrt", "TransformTimes 0 1\n" + scene("ActiveTransform EndTime\n"
                                                            "Translate 3 0 0 Shape \"sphere\""));
  EXPECT_EQ(folder.pbrt("--frames 0-4:2 --fps 4 --outfile '#.exr' scene.pbrt").code, 0);
  for (const int i : {0, 2, 4}) {
    folder.write("still.pbrt", scene(fmt::format("Translate {} 0 0 Shape \"sphere\"", 0.75 * i)));
    EXPECT_EQ(folder.pbrt("--outfile still.exr still.pbrt").code, 0);
    EXPECT_EQ(channels(fmt::format("{}.exr", i)), channels("still.exr")) << i;
  }
  EXPECT_EQ(folder.pbrt("--frames 2 --outfile 'fixed#.exr' scene.pbrt").code, 0);
  EXPECT_EQ(channels("fixed2.exr"), channels("0.exr")) << "without --fps time stands still";
}

TEST_F(FramesTest, WhatIsThereIsLeftAlone) {
  folder.write("1.exr", "not touched");
  folder.write("2.exr", "its other picture is missing");
  folder.write("1.png", "nor this one");
  const fs::path first = folder.path() / "1.exr";
  fs::last_write_time(first, fs::file_time_type::clock::now() - std::chrono::hours(48));
  const auto before = fs::last_write_time(first);
  const std::string command = "--frames 1-3 --skip-existing --outfile '#.exr' --outfile '#.png' ";
  const Outcome outcome = folder.pbrt(command + "scene.pbrt");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "2.exr\n2.png\n3.exr\n3.png\n");
  EXPECT_THAT(outcome.err, HasSubstr("1 of 3 frames were there already"));
  EXPECT_EQ(fs::last_write_time(first), before);
  EXPECT_EQ(contents(first), "not touched");
  EXPECT_EQ(channels("2.exr"), channels("3.exr"));
  EXPECT_EQ(folder.pbrt(command + "--quiet scene.pbrt").err, "");
  EXPECT_EQ(folder.pbrt("--frames 1-3 --quiet --outfile '#.exr' scene.pbrt").code, 0);
  EXPECT_EQ(channels("1.exr"), channels("3.exr")) << "without the option all are made anew";
}

TEST_F(FramesTest, WhatIsThereIsCheckedNonetheless) {
  folder.write("1.exr", "");
  for (const char* how : {"--check", "--format"})
    for (const char* output : {"", "--outfile '#.exr' "}) {
      const std::string arguments = std::string(how) + " --frames 1 --skip-existing " + output;
      EXPECT_EQ(folder.pbrt(arguments + "no.pbrt").code, 4) << arguments;
    }
}

TEST_F(FramesTest, AFrameThatFailsStopsNoOther) {
  folder.write("scene.pbrt", scene("Include \"part#.pbrt\""));
  folder.write("part1.pbrt", "Shape \"sphere\"");
  folder.write("part2.pbrt", "Shape \"sphere\" \"float radius\" \"wide\"");
  folder.write("part4.pbrt", "Shape \"nosuchshape\"");
  folder.write("part5.pbrt", "Shape \"sphere\"");
  const Outcome outcome = folder.pbrt("--frames 1-5 --outfile '#.png' scene.pbrt");
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  EXPECT_EQ(outcome.out, "1.png\n5.png\n");
  for (const char* told : {"part2.pbrt:1:", "part3.pbrt", "nosuchshape"})
    EXPECT_THAT(outcome.err, HasSubstr(told));
  EXPECT_THAT(outcome.err, HasSubstr("3 of 5 frames failed: 2, 3, 4\n"));
}

TEST_F(FramesTest, AMissingSceneStopsNoOther) {
  fs::copy(folder.path() / "scene.pbrt", folder.path() / "s3.pbrt");
  const Outcome outcome = folder.pbrt("--frames 1-3 --outfile '#.png' 's#.pbrt'");
  EXPECT_EQ(outcome.code, 4);
  EXPECT_EQ(outcome.out, "3.png\n");
  EXPECT_THAT(outcome.err, HasSubstr("2 of 3 frames failed: 1, 2\n"));
}

// Errors that are passed over are counted anew for each frame.
TEST_F(FramesTest, PermissiveFramesCountTheirOwnErrors) {
  folder.write("scene.pbrt", scene("Include \"part#.pbrt\""));
  folder.write("part1.pbrt", "Shape \"nosuchshape\"");
  folder.write("part2.pbrt", "Shape \"sphere\"");
  const Outcome outcome = folder.pbrt("--permissive --frames 1-2 --outfile '#.png' scene.pbrt");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out, "1.png\n2.png\n");
  EXPECT_EQ(outcome.err.find("passed over"), outcome.err.rfind("passed over")) << outcome.err;
  const Outcome check = folder.pbrt("--check --frames 1-2 scene.pbrt");
  EXPECT_EQ(check.code, 3);
  EXPECT_THAT(check.err, HasSubstr("1 of 2 frames failed: 1\n"));
}

TEST_F(FramesTest, PicturesThatCannotBeWrittenEndTheRun) {
  const Outcome outcome = folder.pbrt("--frames 1-9 --outfile 'nowhere/#.png' scene.pbrt");
  EXPECT_EQ(outcome.code, 4);
  EXPECT_THAT(outcome.err, HasSubstr("nowhere/1.png"));
  EXPECT_EQ(outcome.err.find("nowhere/2.png"), std::string::npos);
}

// The largest of all programs that this test has run so far, in bytes.
long largest() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  return 1024 * usage.ru_maxrss;
}

// A film of 256 x 256 takes several MiB. One scene is there at a time.
TEST_F(FramesTest, FortyTakeTheMemoryOfFour) {
  folder.write("scene.pbrt", scene("Shape \"sphere\"", 256));
  const std::string command = "--quiet --spp 1 --outfile '#.png' scene.pbrt --frames ";
  EXPECT_EQ(folder.pbrt(command + "1-4").code, 0);
  const long four = largest();
  EXPECT_EQ(folder.pbrt(command + "1-40").code, 0);
  EXPECT_LT(largest() - four, 20L << 20);
}

}  // namespace
}  // namespace pbrt::test
