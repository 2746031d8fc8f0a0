// Files appear whole or not at all.

#include "core/base/replacement.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>

#include "core/base/error.h"
#include "tests/command.h"

namespace pbrt {
namespace {

namespace fs = std::filesystem;

using test::contents;

void expectRefused(const fs::path& file, const std::string& why) {
  for (const bool write : {false, true}) try {
      if (write)
        writeFile(file, "new");
      else
        checkReplaceable(file);
      ADD_FAILURE() << "not refused: " << why;
    } catch (const Error& error) {
      EXPECT_EQ(error.failure(), Failure::io);
      const std::string said = error.what();
      EXPECT_NE(said.find("cannot write " + file.string() + ": "), said.npos) << said;
      EXPECT_NE(said.find(why), std::string::npos) << said;
    }
}

TEST(WriteFile, HoldsTheBytes) {
  const test::Folder folder;
  const std::string bytes("a\0b\r\n\xff", 6);
  writeFile(folder.path() / "a", bytes);
  EXPECT_EQ(contents(folder.path() / "a"), bytes);
  writeFile(folder.path() / "a", "");
  EXPECT_EQ(contents(folder.path() / "a"), "");
  EXPECT_EQ(folder.files(), 1U);
}

TEST(WriteFile, TakesNamesAsLongAsThereAre) {
  const test::Folder folder;
  writeFile(folder.path() / std::string(255, 'x'), "long");
  EXPECT_EQ(contents(folder.path() / std::string(255, 'x')), "long");
  expectRefused(folder.path() / std::string(256, 'x'), "File name too long");
}

TEST(WriteFile, FollowsALinkToItsFile) {
  const test::Folder folder;
  folder.write("file", "old");
  fs::create_symlink("file", folder.path() / "link");
  writeFile(folder.path() / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder.path() / "link"));
  EXPECT_EQ(contents(folder.path() / "file"), "new");
}

TEST(WriteFile, RefusesWhatCannotBe) {
  const test::Folder folder;
  fs::create_directory(folder.path() / "folder");
  expectRefused(folder.path() / "folder", "it is a folder");
  expectRefused(folder.path() / "nowhere" / "a", "no such folder");
  folder.write("file", "old");
  expectRefused(folder.path() / "file" / "a", "");
  EXPECT_EQ(folder.files(), 2U);
}

TEST(WriteFile, RespectsPermissions) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
  const test::Folder folder;
  folder.write("file", "old");
  fs::permissions(folder.path() / "file", fs::perms::owner_read);
  expectRefused(folder.path() / "file", "Permission denied");
  fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
  expectRefused(folder.path() / "new", "Permission denied");
  fs::permissions(folder.path(), fs::perms::owner_all);
}

TEST(CheckReplaceable, LeavesNothing) {
  const test::Folder folder;
  folder.write("old", "old");
  checkReplaceable(folder.path() / "old");
  checkReplaceable(folder.path() / "new");
  EXPECT_EQ(contents(folder.path() / "old"), "old");
  EXPECT_EQ(folder.files(), 1U);
}

TEST(Replacement, TakesThePlaceOnlyWhenItIsDone) {
  const test::Folder folder;
  folder.write("file", "old");
  {
    Replacement abandoned(folder.path() / "file");
    std::fputs("half", abandoned.stream());
  }
  EXPECT_EQ(contents(folder.path() / "file"), "old");
  EXPECT_EQ(folder.files(), 1U);
  Replacement a(folder.path() / "file"), b(folder.path() / "file");
  std::fputs("a", a.stream());
  std::fputs("b", b.stream());
  std::fflush(a.stream());
  EXPECT_EQ(contents(folder.path() / "file"), "old");
  b.commit();
  EXPECT_EQ(contents(folder.path() / "file"), "b");
  a.commit();
  EXPECT_EQ(contents(folder.path() / "file"), "a") << "two at a time do not share a file";
  EXPECT_EQ(folder.files(), 1U);
}

TEST(WriteFile, ThatDoesNotFitLeavesTheOldFile) {
  const test::Folder folder;
  folder.write("file", "old");
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = before;
  small.rlim_cur = 1000;
  setrlimit(RLIMIT_FSIZE, &small);
  EXPECT_THROW(writeFile(folder.path() / "file", std::string(5000, 'x')), Error);
  EXPECT_THROW(writeFile(folder.path() / "file", std::string(500000, 'x')), Error);
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(contents(folder.path() / "file"), "old");
  EXPECT_EQ(folder.files(), 1U);
}

}  // namespace
}  // namespace pbrt
