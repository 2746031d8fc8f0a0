// Frames that are interrupted, and gone on with from checkpoints of their own.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/tools/frames_scene.h"
#include "tests/tools/running.h"

namespace pbrt::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using FramesInterrupted = Frames;

// All bytes that are read for the two are the same.
TEST_F(FramesInterrupted, AnotherFrameIsAnotherRender) {
  folder.write("scene.pbrt", scene("MakeNamedMaterial \"paint1\" \"string type\" \"matte\"\n"
                                   "MakeNamedMaterial \"paint2\" \"string type\" \"mirror\"\n"
                                   "NamedMaterial \"paint#\"\nShape \"sphere\""));
  const std::string command = "--spp 2 --outfile '#.exr' scene.pbrt --checkpoint ";
  ASSERT_EQ(folder.pbrt(command + "'#.film' --frames 1 --samples 0..1").code, 0);
  fs::rename(folder.path() / "1.film", folder.path() / "2.film");
  const Outcome outcome = folder.pbrt(command + "'#.film' --frames 2 --resume");
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("frame 1"));
}

TEST_F(FramesInterrupted, ACheckpointThatCannotBeUsedStopsNoOther) {
  for (const char* how : {"", "--resume "}) {
    folder.write("c2.film", "damaged");
    const Outcome outcome = folder.pbrt("--frames 1-3 --outfile '#.png' --checkpoint 'c#.film' " +
                                        std::string(how) + "scene.pbrt");
    EXPECT_EQ(outcome.code, 3) << outcome.err;
    EXPECT_EQ(outcome.out, "1.png\n3.png\n") << how;
    fs::remove(folder.path() / "c1.film");
    fs::remove(folder.path() / "c3.film");
  }
}

// The second frame would take days. What it has is in its checkpoint, but its name is not taken.
TEST_F(FramesInterrupted, AnInterruptionEndsTheRun) {
  std::string text = scene("Shape \"sphere\"");
  text.replace(text.find("Sampler"), text.find("Integrator") - text.find("Sampler"),
               "Include \"samples#.pbrt\"\n");
  folder.write("scene.pbrt", text);
  folder.write("samples1.pbrt", "Sampler \"random\" \"integer pixelsamples\" 2");
  folder.write("samples2.pbrt", "Sampler \"random\" \"integer pixelsamples\" 1000000000");
  folder.write("run.sh", Folder::program() +
                             " --quiet --frames 1-3 --outfile '#.png' --checkpoint 'c#.film' "
                             "--checkpoint-every 100ms scene.pbrt & p=$!\n"
                             "while ! test -e c2.film; do sleep 0.05; done\n"
                             "kill -USR1 $p; sleep 0.1; kill -TERM $p; wait $p\n");
  const Outcome outcome = folder.command("sh run.sh");
  EXPECT_EQ(outcome.code, 75) << outcome.err;
  EXPECT_TRUE(there("1.png") && there("c1.film") && there("c2.film"));
  EXPECT_FALSE(there("2.png") || there("3.png") || there("c3.film"));
}

// The frame whose pictures are being written becomes whole, but no other begins.
TEST_F(FramesInterrupted, AnInterruptionWhileAFrameIsWrittenEndsTheRun) {
  folder.write("scene.pbrt", scene("Shape \"sphere\"", 256));
  Outcome outcome;
  for (int i = 0; i < 50; ++i) {
    Running render(folder,
                   "--quiet --spp 1 --aov normal,depth,uv --outfile #.png --outfile #.exr "
                   "--frames 1-3 scene.pbrt");
    render.until([&] { return there("1.png"); }).send(SIGSTOP);
    render.untilItStands();
    const bool inTime = there("1.png") && !there("1.exr");
    outcome = render.send(inTime ? SIGTERM : SIGKILL).send(SIGCONT).end();
    if (inTime) break;
    for (const char* name : {"1.png", "1.exr", "2.png", "2.exr", "3.png", "3.exr"})
      fs::remove(folder.path() / name);
  }
  EXPECT_EQ(outcome.code, 75);
  EXPECT_EQ(outcome.err, "interrupted after frame 1\n");
  EXPECT_TRUE(there("1.exr"));
  EXPECT_FALSE(there("2.png"));
}

TEST_F(FramesInterrupted, EachGoesOnFromItsOwnCheckpoint) {
  const std::string command =
      "--quiet --frames 1-2 --outfile '#.exr' --checkpoint 'c##.film' --resume scene.pbrt";
  EXPECT_EQ(folder.pbrt(command).code, 0);
  const std::string second = contents(folder.path() / "c02.film");
  const auto wanted = channels("2.exr");
  fs::remove(folder.path() / "2.exr");
  const Outcome again = folder.pbrt("--skip-existing " + command);
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(channels("2.exr"), wanted);
  EXPECT_EQ(contents(folder.path() / "c02.film"), second) << "it was complete";
}

}  // namespace
}  // namespace pbrt::test
