// Files appear whole or not at all.

#include "core/base/replacement.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstddef>
#include <iostream>
#include <thread>

#include "core/base/error.h"
#include "core/base/rng.h"
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

// Whether the new file has no name while it is written. As NFS cannot have that, some tests are
// run with both, in a process of their own where need be.
enum class Kind : std::uint8_t { nameless, named };

// From now on O_TMPFILE is refused to this process, as by a file system that does not have it.
bool refuseNameless() {
  constexpr auto kArgument = offsetof(seccomp_data, args) + 2 * sizeof(std::uint64_t);
  sock_filter program[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_openat, 0, 3),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, kArgument),
      BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, O_TMPFILE & ~O_DIRECTORY, 0, 1),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EOPNOTSUPP),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  };
  const sock_fprog filter{std::size(program), program};
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) == 0;
}

// Starts a process that does the work and exits with 0 if no expectation failed.
template <class Work>
pid_t start(Kind kind, Work work) {
  const pid_t child = fork();
  if (child != 0) return child;
  if (kind == Kind::named && !refuseNameless()) _exit(2);
  work();
  std::cout.flush();
  _exit(testing::Test::HasFailure() ? 1 : 0);
}

bool went(pid_t child) {
  int status = 0;
  return waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

class ReplacementOfKind : public testing::TestWithParam<Kind> {
 protected:
  void SetUp() override {
    if (!went(start(GetParam(), [] {}))) GTEST_SKIP() << "this system has no seccomp filters";
  }

  const test::Folder folder_;
  const fs::path file_ = folder_.path() / "file";
};
INSTANTIATE_TEST_SUITE_P(Either, ReplacementOfKind, testing::Values(Kind::nameless, Kind::named),
                         [](const auto& test) {
                           return test.param == Kind::named ? "named" : "nameless";
                         });

TEST_P(ReplacementOfKind, TakesThePlaceOnlyWhenItIsDone) {
  folder_.write("file", "old");
  EXPECT_TRUE(went(start(GetParam(), [&] {
    {
      Replacement abandoned(file_);
      std::fputs("half", abandoned.stream());
      std::fflush(abandoned.stream());
      EXPECT_EQ(contents(file_), "old");
      if (GetParam() == Kind::named) {
        EXPECT_EQ(folder_.files(), 2U);
      }
    }
    EXPECT_EQ(folder_.files(), 1U);
    Replacement a(file_), b(file_);
    std::fputs("a", a.stream());
    std::fputs("b", b.stream());
    b.commit(Durability::onDisk);
    EXPECT_EQ(contents(file_), "b");
    a.commit();
    EXPECT_EQ(contents(file_), "a") << "two at a time do not share a file";
    EXPECT_EQ(folder_.files(), 1U);
  })));
}

// One process tells another that it may go on.
class Gate {
 public:
  Gate() { EXPECT_EQ(pipe(ends_), 0); }
  ~Gate() {
    for (const int end : ends_) close(end);
  }
  Gate(const Gate&) = delete;
  Gate& operator=(const Gate&) = delete;

  void open() const { EXPECT_EQ(write(ends_[1], "", 1), 1); }
  void await() const {
    char byte = 0;
    EXPECT_EQ(read(ends_[0], &byte, 1), 1);
  }

 private:
  int ends_[2];
};

// What another process is still writing is not taken for abandoned.
TEST_P(ReplacementOfKind, LeavesThoseOfLiveProcessesAlone) {
  const Gate written, mayGoOn;
  const pid_t slow = start(GetParam(), [&] {
    Replacement replacement(file_);
    std::fputs("slow", replacement.stream());
    written.open();
    mayGoOn.await();
    replacement.commit();
  });
  written.await();
  writeFile(file_, "quick");
  EXPECT_EQ(contents(file_), "quick");
  mayGoOn.open();
  EXPECT_TRUE(went(slow));
  EXPECT_EQ(contents(file_), "slow");
  EXPECT_EQ(folder_.files(), 1U);
}

// Names are given and taken all the time; no process removes what is another's.
TEST_P(ReplacementOfKind, TakesManyWritersAtOnce) {
  std::vector<pid_t> writers;
  for (char c = 'a'; c < 'e'; ++c)
    writers.push_back(start(GetParam(), [&] {
      for (int i = 0; i < 500; ++i) EXPECT_NO_THROW(writeFile(file_, std::string(100, c)));
    }));
  for (const pid_t writer : writers) EXPECT_TRUE(went(writer));
  EXPECT_EQ(contents(file_).size(), 100U);
  EXPECT_EQ(folder_.files(), 1U);
}

TEST_P(ReplacementOfKind, RemovesWhatAKilledProcessHasLeft) {
  folder_.write("file", "old");
  const Gate written, never;
  const pid_t killed = start(GetParam(), [&] {
    Replacement replacement(file_);
    std::fputs("half", replacement.stream());
    std::fflush(replacement.stream());
    written.open();
    never.await();
  });
  written.await();
  kill(killed, SIGKILL);
  waitpid(killed, nullptr, 0);
  EXPECT_EQ(contents(file_), "old");
  EXPECT_EQ(folder_.files(), GetParam() == Kind::named ? 2U : 1U);
  checkReplaceable(file_);
  EXPECT_EQ(folder_.files(), 1U) << "asking is enough";
}

// Killed at any moment: the file is whole, and what may be left is gone after the next write.
TEST_P(ReplacementOfKind, OutlivesKillsAtAnyMoment) {
  constexpr std::size_t kSize = 2 << 20;
  const auto isWhole = [](const std::string& bytes) {
    return bytes.size() == kSize && bytes.find_first_not_of(bytes[0]) == bytes.npos;
  };
  writeFile(file_, std::string(kSize, 'a'));
  Rng rng(1);
  for (int kills = 1; kills <= 32; ++kills) {
    const std::string before = contents(file_);
    const Gate begun;
    const pid_t child = start(GetParam(), [&] {
      begun.open();
      for (char c = before[0];; c = c == 'z' ? 'a' : static_cast<char>(c + 1))
        writeFile(file_, std::string(kSize, c));
    });
    begun.await();
    std::this_thread::sleep_for(std::chrono::microseconds(rng.uniform(10000)));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    const std::string after = contents(file_);
    ASSERT_TRUE(isWhole(after)) << "after " << kills << " kills";
    // A name before it is the file's has, for a moment, what is complete.
    for (const auto& entry : fs::directory_iterator(folder_.path()))
      EXPECT_TRUE(GetParam() == Kind::named || isWhole(contents(entry)));
    if (kills % 8 == 0) {
      writeFile(file_, after);
      EXPECT_EQ(folder_.files(), 1U) << "after " << kills << " kills";
    }
  }
}

}  // namespace
}  // namespace pbrt
