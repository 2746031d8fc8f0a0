#include "core/base/file.h"

#include <sys/stat.h>

#include <thread>

#include "core/base/error.h"
#include "core/base/rng.h"
#include "tests/command.h"
#include "tests/gzip.h"

namespace pbrt {
namespace {

using test::packed;

class ReadFile : public testing::Test {
 protected:
  std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }
  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    folder_.write(name, bytes);
    return path(name);
  }
  // What follows "cannot read PATH: ".
  static std::string reasonOf(const std::filesystem::path& file,
                              FileKind allowed = FileKind::regular,
                              std::size_t longest = kLongestFile) {
    try {
      readFile(file, allowed, longest);
      return "no error";
    } catch (const Error& error) {
      EXPECT_EQ(error.failure(), Failure::io);
      const std::string begin = "cannot read " + file.string() + ": ";
      const std::string message = error.diagnostics().at(0).message;
      EXPECT_EQ(message.substr(0, begin.size()), begin);
      return message.substr(std::min(begin.size(), message.size()));
    }
  }
  test::Folder folder_;
};

std::string randomBytes(std::size_t size) {
  Rng rng(1);
  std::string bytes(size, '\0');
  for (char& c : bytes) c = static_cast<char>(rng.bits());
  return bytes;
}

// Sizes about the pieces in which a file is read.
TEST_F(ReadFile, GivesEveryByteBackPackedOrNot) {
  for (const std::size_t size : {0U, 1U, 2U, 3U, 65535U, 262143U, 262144U, 262145U, 1000000U}) {
    const std::string bytes = randomBytes(size);
    EXPECT_EQ(readFile(write("a", bytes)), bytes) << size;
    EXPECT_EQ(readFile(write("a.gz", packed(bytes))), bytes) << size;
    EXPECT_EQ(readFile(write("b", packed(bytes) + packed("and") + packed(bytes))),
              bytes + "and" + bytes)
        << size;
  }
}

TEST_F(ReadFile, KnowsPackedFilesByTheirFirstBytesAlone) {
  EXPECT_EQ(readFile(write("a.gz", "no gzip")), "no gzip");
  EXPECT_EQ(readFile(write("a", "\x1f")), "\x1f");
  EXPECT_EQ(readFile(write("a", "\x1f\x8c")), "\x1f\x8c");
}

TEST_F(ReadFile, RefusesWhatIsDamaged) {
  const std::string good = packed(randomBytes(100000));
  std::string changed = good;
  changed[50000] = static_cast<char>(changed[50000] ^ 1);
  EXPECT_EQ(reasonOf(write("a", changed)), "the packed data are damaged");
  EXPECT_EQ(reasonOf(write("a", good.substr(0, 50000))), "the packed data end too early");
  EXPECT_EQ(reasonOf(write("a", good.substr(0, good.size() - 1))), "the packed data end too early");
}

TEST_F(ReadFile, RefusesWhatIsNoFile) {
  EXPECT_EQ(reasonOf(path("none")), "No such file or directory");
  EXPECT_EQ(reasonOf(folder_.path()), "it is not a file");
  EXPECT_EQ(reasonOf(folder_.path(), FileKind::any), "it is not a file");
  EXPECT_EQ(reasonOf("/dev/zero"), "it is not a file");
  ASSERT_EQ(mkfifo(path("fifo").c_str(), 0600), 0);
  EXPECT_EQ(reasonOf(path("fifo")), "it is not a file");
  std::filesystem::create_symlink("fifo", path("link"));
  EXPECT_EQ(reasonOf(path("link")), "it is not a file");
  std::filesystem::create_symlink("loop", path("loop"));
  EXPECT_EQ(reasonOf(path("loop")), "Too many levels of symbolic links");
}

TEST_F(ReadFile, ReadsAPipeThatTheUserNames) {
  const std::string bytes = randomBytes(1000000);
  ASSERT_EQ(mkfifo(path("fifo").c_str(), 0600), 0);
  for (const std::string& written : {bytes, packed(bytes)}) {
    std::thread writer([&] { write("fifo", written); });
    EXPECT_EQ(readFile(path("fifo"), FileKind::any), bytes);
    writer.join();
  }
}

TEST_F(ReadFile, EndsAtTheLimit) {
  const std::string bytes(1 << 20, 'a');
  constexpr std::size_t kLimit = 1 << 20;
  EXPECT_EQ(readFile(write("a", bytes), FileKind::regular, kLimit), bytes);
  EXPECT_EQ(readFile(write("b", packed(bytes)), FileKind::regular, kLimit), bytes);
  EXPECT_EQ(reasonOf(write("a", bytes + "b"), FileKind::regular, kLimit),
            "it is longer than 1 MiB");
  EXPECT_EQ(reasonOf(write("b", packed(bytes + "b")), FileKind::regular, kLimit),
            "it is longer than 1 MiB when unpacked");
  EXPECT_EQ(reasonOf("/dev/zero", FileKind::any, kLimit), "it is longer than 1 MiB");
}

// Hundreds of thousands of them have to fit into memory.
TEST_F(ReadFile, SmallFilesTakeLittleMemory) {
  for (const std::string& text : {randomBytes(10), packed(randomBytes(1000))})
    EXPECT_LT(readFile(write("a", text)).capacity(), 4096U);
}

// A packed file may lie about what it holds: 4 GiB are neither taken nor filled.
TEST_F(ReadFile, BelievesNoSizeThatAFileStates) {
  std::string file = packed(std::string(10000000, 'a'));
  file.replace(file.size() - 4, 4, "\xff\xff\xff\xff");
  EXPECT_EQ(reasonOf(write("a", file)), "the packed data are damaged");
}

TEST_F(ReadFile, IsHashedWhileSomebodyAsks) {
  const auto digestOf = [&](const std::vector<std::string>& texts) {
    const FileDigest digest;
    for (const std::string& text : texts) readFile(write("a", text));
    return digest.value();
  };
  EXPECT_EQ(digestOf({}), 0U);
  const std::uint64_t all = digestOf({"one", "two"});
  readFile(write("a", "three"));  // nobody asks
  EXPECT_EQ(digestOf({"one", "two"}), all);
  for (const auto& other : std::vector<std::vector<std::string>>{
           {"one"}, {"two", "one"}, {"onetwo"}, {"one", "two", ""}, {"on", "etwo"}, {"One", "two"}})
    EXPECT_NE(digestOf(other), all);
  EXPECT_EQ(digestOf({packed("one"), packed("two")}), all) << "what was read counts";
  const FileDigest one;
  EXPECT_THROW(FileDigest(), std::logic_error);
}

}  // namespace
}  // namespace pbrt
