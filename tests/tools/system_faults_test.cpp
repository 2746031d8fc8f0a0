// What the system can do to the command: disks, memory, threads, streams. Each fault is one clear
// line and the documented exit code; old pictures stay whole, and nothing is left behind.

#include <regex>

#include "core/base/image.h"
#include "tests/file_system.h"

namespace pbrt::test {
namespace {

namespace fs = std::filesystem;

// Noisy, so that pictures of it are long.
std::string scene(const std::string& statements = "Shape \"sphere\"", int width = 64) {
  return "LookAt 0 0 3  0 0 0  0 1 0\nCamera \"perspective\"\n"
         "Film \"image\" \"integer xresolution\" " +
         std::to_string(width) + " \"integer yresolution\" " + std::to_string(width) +
         " \"string filename\" \"out.exr\"\n"
         "Sampler \"random\" \"integer pixelsamples\" 1\nIntegrator \"path\"\nWorldBegin\n"
         "LightSource \"infinite\"\n" +
         statements + "\nWorldEnd\n";
}

// So many times a statement.
std::string times(int n, const std::string& statement) {
  std::string text;
  for (int i = 0; i < n; ++i) text += statement + "\n";
  return text;
}

// One error, said in one line (its place in the scene may be shown below), for people.
void expectError(const Outcome& outcome, int code, const std::string& pattern) {
  EXPECT_EQ(outcome.code, code) << outcome.err;
  const std::regex line("^([^\\n]*:\\d+:\\d+: )?error: [^\\n]*(" + pattern + ")[^\\n]*\\n");
  EXPECT_TRUE(std::regex_search(outcome.err, line, std::regex_constants::match_continuous))
      << "not found: " << pattern << "\nin: " << outcome.err;
  EXPECT_EQ(outcome.err.find("bug"), std::string::npos) << outcome.err;
}

// A command with settings of the shell, such as limits and redirections.
Outcome shell(const Folder& folder, const std::string& before, const std::string& arguments) {
  return folder.command("sh -c '" + before + Folder::program() + " " + arguments + "'");
}

class Output : public testing::TestWithParam<const char*> {
 protected:
  Output() { folder_.write("scene.pbrt", scene("Shape \"sphere\"", 200)); }

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
    const Disk disk(folder_, full ? "full" : "small", 24);
    ASSERT_TRUE(disk.mounted());
    const std::string output = in(full ? "full" : "small");
    folder_.write(output, "the old picture");
    if (full) disk.fill();
    const auto files = [&] {
      return std::distance(fs::directory_iterator((folder_.path() / output).parent_path()), {});
    };
    const auto before = files();
    expectError(render(output), 4, "cannot write " + output + ": .*No space left on device");
    EXPECT_EQ(contents(folder_.path() / output), "the old picture");
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

INSTANTIATE_TEST_SUITE_P(Pictures, Output, testing::Values(".exr", ".png"),
                         [](const auto& test) { return std::string(test.param + 1); });

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

TEST(Film, OfMoreThanThereIsRoomForIsRefusedWithFigures) {
  const Folder folder;
  folder.write("scene.pbrt", scene("Shape \"sphere\"", 65536));
  const std::string figures =
      "a film of 65536 x 65536 pixels needs \\d{3}\\.\\d GiB of memory; there is room for "
      "\\d+\\.\\d GiB";
  expectError(folder.pbrt("scene.pbrt"), 3, figures);
  expectError(folder.pbrt("scene.pbrt --aov variance"), 3, figures);
  EXPECT_EQ(folder.pbrt("scene.pbrt --quiet --pixelbounds 0,64,0,64").code, 0);
}

// Sanitizers take more addresses than these limits allow.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

TEST(Film, IsHeldToTheLimitOfTheProcess) {
  const Folder folder;
  folder.write("scene.pbrt", scene("Shape \"sphere\"", 8192));
  expectError(shell(folder, "ulimit -v 1000000; ", "scene.pbrt"), 3,
              "a film of 8192 x 8192 pixels needs \\d+\\.\\d GiB of memory; there is room for "
              "1.0 GiB");
}

TEST(Threads, ThatTheSystemRefusesAreAnError) {
  const Folder folder;
  folder.write("scene.pbrt", scene());
  expectError(shell(folder, "ulimit -v 2000000; ", "scene.pbrt --nthreads 4000"), 4,
              "the system lets this process start \\d+ threads, not 4000: ");
}

class Memory : public testing::TestWithParam<std::pair<const char*, std::string>> {};

// Whatever it is that finds none.
TEST_P(Memory, ThatIsShortIsAnErrorOrEnough) {
  const Folder folder;
  folder.write("scene.pbrt", GetParam().second);
  bool failed = false;
  for (int megabytes = 120; megabytes <= 280; megabytes += 16) {
    const std::string limit = "ulimit -v " + std::to_string(megabytes * 1000) + "; ";
    const Outcome outcome = shell(folder, limit, "scene.pbrt --quiet --nthreads 2");
    if (outcome.code == 0) continue;
    failed = true;
    SCOPED_TRACE(limit);
    expectError(outcome, outcome.code == 4 ? 4 : 3, "memory|threads");
  }
  EXPECT_TRUE(failed) << "the test needs a scene that takes more";
}

INSTANTIATE_TEST_SUITE_P(
    Of, Memory,
    testing::Values(
        std::pair("Little", scene()),
        std::pair("Spheres", scene(times(30000, "Translate .01 0 0 Shape \"sphere\""))),
        std::pair("Instances", scene("ObjectBegin \"a\"\nShape \"sphere\"\nObjectEnd\n" +
                                     times(30000, "Translate .01 0 0 ObjectInstance \"a\""))),
        std::pair("Subdivision",
                  scene("Shape \"loopsubdiv\" \"integer levels\" 8 \"integer indices\" "
                        "[0 1 2 0 2 3 0 3 1 1 3 2] \"point P\" [0 0 0 1 0 0 0 1 0 0 0 1]")),
        std::pair("Film", scene("Shape \"sphere\"", 700))),
    [](const auto& test) { return test.param.first; });

#endif

}  // namespace
}  // namespace pbrt::test
