// Memory and threads that the system does not give: each time one clear line, never a crash.

#include "tests/tools/system_faults.h"

namespace pbrt::test {
namespace {

// So many times a statement.
std::string times(int n, const std::string& statement) {
  std::string text;
  for (int i = 0; i < n; ++i) text += statement + "\n";
  return text;
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
  for (int megabytes = 120; megabytes <= 280; megabytes += 20) {
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
        std::pair("Spheres", scene(times(20000, "Translate .01 0 0 Shape \"sphere\""))),
        std::pair("Instances", scene("ObjectBegin \"a\"\nShape \"sphere\"\nObjectEnd\n" +
                                     times(20000, "Translate .01 0 0 ObjectInstance \"a\""))),
        std::pair("Subdivision",
                  scene("Shape \"loopsubdiv\" \"integer levels\" 8 \"integer indices\" "
                        "[0 1 2 0 2 3 0 3 1 1 3 2] \"point P\" [0 0 0 1 0 0 0 1 0 0 0 1]")),
        std::pair("Film", scene("Shape \"sphere\"", 700))),
    [](const auto& test) { return test.param.first; });

#endif

}  // namespace
}  // namespace pbrt::test
