// What disks, streams and surroundings can do to the command. Each fault is one clear line and the
// documented exit code; old pictures stay whole, and nothing is left behind.

#include "tests/tools/system_faults.h"

#include "core/base/image.h"
#include "tests/file_system.h"

namespace pbrt::test {
namespace {

namespace fs = std::filesystem;

class Output : public testing::TestWithParam<const char*> {
 protected:
  Output() { folder_.write("scene.pbrt", scene(kBall, 200)); }

  // The picture's name in a folder or disk.
  std::string in(const std::string& place) const { return place + "/out" + GetParam(); }
  Outcome render(const std::string& output) const {
    return folder_.pbrt("--quiet --aov normal,position scene.pbrt --outfile " + output);
  }

  Folder folder_;
};

TEST_P(Output, CannotGoWhereThereIsNoFolder) {
  expectError(render(in("nowhere")), 4, "cannot write " + in("nowhere") + ": .*no such folder");
  expectError(render(in("scene.pbrt")), 4, "cannot write .*: (Not a directory|.*no such folder)");
  EXPECT_EQ(folder_.files(), 1U);
}

TEST_P(Output, IsNotAFolder) {
  fs::create_directory(folder_.path() / in("."));
  expectError(render(in(".")), 4, "cannot write .*it is a folder");
}

TEST_P(Output, HasANameThatTheSystemTakes) {
  expectError(render(std::string(300, 'x') + GetParam()), 4, "cannot write x+.*File name too long");
}

TEST_P(Output, IsNoLoopOfLinks) {
  fs::create_symlink(in("."), folder_.path() / in("."));
  expectError(render(in(".")), 4, "cannot write .*Too many levels of symbolic links");
}

TEST_P(Output, GoesThroughALinkToAFileThatIsNotThereYet) {
  fs::create_symlink(std::string("new") + GetParam(), folder_.path() / in("."));
  EXPECT_EQ(render(in(".")).code, 0);
  EXPECT_TRUE(fs::is_symlink(folder_.path() / in(".")));
  EXPECT_TRUE(fs::is_regular_file(folder_.path() / (std::string("new") + GetParam())));
}

TEST_P(Output, CannotGoToADiskThatMayNotBeWritten) {
  if (!mayMount()) GTEST_SKIP() << "this user may not mount";
  const Disk disk(folder_, "disk", 256);
  ASSERT_TRUE(disk.mounted());
  disk.forbidWriting();
  expectError(render(in("disk")), 4, "cannot write " + in("disk") + ": Read-only file system");
}

// In the beginning or in the middle of the picture.
TEST_P(Output, ThatFillsTheDiskLeavesTheOldOneWhole) {
  if (!mayMount()) GTEST_SKIP() << "this user may not mount";
  for (const bool full : {true, false}) {
    const Disk disk(folder_, full ? "full" : "small", 12);
    ASSERT_TRUE(disk.mounted());
    const std::string output = in(full ? "full" : "small");
    folder_.write(output, "the old picture");
    if (full) disk.fill();
    const auto files = [&] {
      return std::distance(fs::directory_iterator((folder_.path() / output).parent_path()), {});
    };
    const auto before = files();
    expectError(render(output), 4, "cannot write " + output + ": .*No space left on device");
    EXPECT_TRUE(contents(folder_.path() / output) == "the old picture");
    EXPECT_EQ(files(), before);
  }
}

TEST_P(Output, LongerThanFilesMayBeLeavesTheOldOneWhole) {
  folder_.write(in("."), "the old picture");
  expectError(shell(folder_, "ulimit -f 4; ", "scene.pbrt --quiet --outfile " + in(".")), 4,
              "cannot write .*File too large");
  EXPECT_EQ(contents(folder_.path() / in(".")), "the old picture");
  EXPECT_EQ(folder_.files(), 2U);
}

INSTANTIATE_TEST_SUITE_P(Of, Output, testing::Values(".exr", ".png", ".film"),
                         [](const auto& test) { return std::string(test.param + 1); });

TEST(Checkpoint, IsAskedForBeforeTheSceneIsRead) {
  const Folder folder;
  expectError(folder.pbrt("no.pbrt --checkpoint nowhere/a.film"), 4, "cannot write nowhere/a.film");
  expectError(folder.pbrt("no.pbrt --checkpoint a.film --outfile nowhere/a.exr"), 4,
              "cannot write nowhere/a.exr");
  EXPECT_EQ(folder.files(), 0U);
}

TEST(Checkpoint, ThatCannotBeWrittenNowDoesNotEndTheRender) {
  if (!mayMount()) GTEST_SKIP() << "this user may not mount";
  const Folder folder;
  folder.write("scene.pbrt", scene());
  const Disk disk(folder, "disk", 24);
  ASSERT_TRUE(disk.mounted());
  const Outcome outcome = folder.pbrt(
      "scene.pbrt --spp 200 --checkpoint disk/a.film --checkpoint-every 100ms --outfile out.exr");
  EXPECT_EQ(outcome.code, 4);
  EXPECT_NE(outcome.err.find("warning: cannot write disk/a.film: No space left"), std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find("error: cannot write disk/a.film: No space left"), std::string::npos)
      << outcome.err;
  ASSERT_EQ(folder.pbrt("scene.pbrt --quiet --spp 200 --outfile whole.exr").code, 0);
  EXPECT_EQ(readExr(folder.path() / "out.exr").channels,
            readExr(folder.path() / "whole.exr").channels);
}

TEST(Checkpoint, HoldsTheSamplesOfAPictureThatCouldNotBeWritten) {
  if (!mayMount()) GTEST_SKIP() << "this user may not mount";
  const Folder folder;
  folder.write("scene.pbrt", scene());
  const std::string render = "scene.pbrt --quiet --checkpoint a.film ";
  {
    const Disk disk(folder, "disk", 16);
    ASSERT_TRUE(disk.mounted());
    const Outcome outcome = folder.pbrt(render + "--outfile disk/out.exr");
    expectError(outcome, 4, "cannot write disk/out.exr: No space left on device");
    EXPECT_NE(outcome.err.find("the samples are in a.film: go on with --resume"), std::string::npos)
        << outcome.err;
  }
  ASSERT_EQ(folder.pbrt(render + "--resume --outfile out.exr").code, 0);
  ASSERT_EQ(folder.pbrt("scene.pbrt --quiet --outfile whole.exr").code, 0);
  EXPECT_EQ(readExr(folder.path() / "out.exr").channels,
            readExr(folder.path() / "whole.exr").channels);
}

TEST(Streams, ThatAreClosedOrFullLoseNoPicture) {
  const Folder folder;
  folder.write("scene.pbrt",
               "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 8 "
               "\"string filename\" \"out.exr\"\nWorldBegin\nWorldEnd\n");
  const Outcome whole = folder.pbrt("scene.pbrt");
  ASSERT_EQ(whole.code, 0);
  ASSERT_NE(whole.err, "") << "the test needs a scene that is warned of";
  const auto picture = readExr(folder.path() / "out.exr").channels;
  struct {
    const char* streams;
    int code;
  } const cases[] = {{"2>&-", 0},        {"2>/dev/full", 0},        {"<&- 2>&-", 0},
                     {">&-", 4},         {">/dev/full", 4},         {"<&- >&- 2>&-", 4},
                     {">&- --quiet", 0}, {">/dev/full --stats", 4}, {">&- 2>/dev/full", 4}};
  for (const auto& c : cases) {
    fs::remove(folder.path() / "out.exr");
    const Outcome outcome = shell(folder, "", std::string("scene.pbrt ") + c.streams);
    EXPECT_EQ(outcome.code, c.code) << c.streams << ": " << outcome.err;
    EXPECT_EQ(readExr(folder.path() / "out.exr").channels, picture) << c.streams;
    EXPECT_EQ(folder.files(), 2U) << c.streams;
  }
  expectError(shell(folder, "", "scene.pbrt --quiet --stats >/dev/full"), 4,
              "cannot write to standard output: No space left on device");
  EXPECT_EQ(shell(folder, "", "nowhere.pbrt 2>&-").code, 4);
  EXPECT_EQ(shell(folder, "", "scene.pbrt --spp 0 2>&- >&-").code, 2);
  EXPECT_NE(shell(folder, "", "- <&-").code, 0);
}

// Messages: the picture is there all the same. Results: the end that pipes are used to.
TEST(Streams, WhoseReaderHasLeft) {
  const Folder folder;
  folder.write("scene.pbrt",
               "Film \"image\" \"string filename\" \"out.exr\" \"integer xresolution\" "
               "8 \"integer yresolution\" 8\nWorldBegin\nWorldEnd\n");
  const std::string run = Folder::program() + " scene.pbrt; echo $? >code; ";
  folder.command("bash -c '{ sleep 0.1; " + run + "} 2>&1 >/dev/null | true'");
  EXPECT_EQ(contents(folder.path() / "code"), "0\n");
  EXPECT_TRUE(fs::exists(folder.path() / "out.exr"));
  folder.command("bash -c '{ sleep 0.1; " + run + "} 2>err | true'");
  EXPECT_EQ(contents(folder.path() / "code"), "141\n");
  EXPECT_EQ(contents(folder.path() / "err").find("error"), std::string::npos);
}

TEST(Surroundings, DoNotMatter) {
  const Folder folder;
  folder.write("scene.pbrt", scene());
  ASSERT_EQ(folder.pbrt("scene.pbrt").code, 0);
  const auto picture = readExr(folder.path() / "out.exr").channels;
  const std::string render = Folder::program() + " scene.pbrt --quiet";
  for (const std::string& line :
       {"env -i " + render, "env LC_ALL=xx_YY LANG=de_DE.UTF-8 " + render,
        "sh -c 'ulimit -n 8; " + render + "'", "sh -c 'ulimit -s 512; " + render + "'"}) {
    fs::remove(folder.path() / "out.exr");
    const Outcome outcome = folder.command(line);
    EXPECT_EQ(outcome.code, 0) << line << ": " << outcome.err;
    EXPECT_EQ(readExr(folder.path() / "out.exr").channels, picture) << line;
  }
}

TEST(Surroundings, MayBeAFolderThatIsGone) {
  const Folder folder;
  folder.write("scene.pbrt", scene());
  const std::string leave = "mkdir gone; cd gone; rmdir ../gone; ";
  expectError(shell(folder, leave, "scene.pbrt"), 4, "cannot read scene.pbrt: No such file");
  const std::string whole = (folder.path() / "scene.pbrt").string();
  expectError(shell(folder, leave, whole), 4, "cannot write out.exr: ");
  EXPECT_EQ(shell(folder, leave, whole + " --quiet --outfile " + whole + ".exr").code, 0);
}

TEST(Surroundings, MayHaveLongPaths) {
  const Folder folder;
  std::string deep;
  for (int i = 0; i < 14; ++i) deep += std::string(250, 'd') + "/";
  fs::create_directories(folder.path() / deep);
  folder.write(deep + "scene.pbrt", scene());
  const Outcome outcome = folder.pbrt(deep + "scene.pbrt --quiet --outfile " + deep + "out.exr");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(fs::exists(folder.path() / deep / "out.exr"));
  const std::string longer = deep + deep + "out.exr";
  expectError(folder.pbrt("scene.pbrt --outfile " + longer), 4, "cannot .*: File name too long");
}

}  // namespace
}  // namespace pbrt::test
