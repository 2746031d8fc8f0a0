// What is found in a file before it is opened, and that no file can do harm there.

#include "core/plugin/stamp.h"

#include <link.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstring>

#include "core/plugin/loader.h"
#include "tests/command.h"

namespace pbrt {
namespace {

namespace fs = std::filesystem;

const fs::path kGood = PBRT_BUILD_DIR "/lib/pbrt/shapes/sphere.so";

// A copy of a good plug-in, to be spoilt.
class Spoilt : public testing::Test {
 protected:
  fs::path file() const { return folder_.path() / "spoilt.so"; }
  // A new file each time: an old one may be open.
  void write() const {
    fs::remove(file());
    folder_.write("spoilt.so", bytes_);
  }
  // Of what is in bytes_; empty: it was opened.
  std::string reason() const {
    write();
    try {
      openPlugin(file());
    } catch (const Error& error) {
      EXPECT_EQ(error.failure(), Failure::plugin);
      const std::string message = error.what(), before = "error: " + file().string() + ": ";
      EXPECT_TRUE(message.starts_with(before)) << message;
      EXPECT_EQ(message.find('\n'), message.npos) << message;
      return message.substr(std::min(before.size(), message.size()));
    }
    return "";
  }
  std::size_t stamp() const {
    const auto magic = PluginStamp().magic;
    const std::size_t at = bytes_.find(std::string_view(magic.data(), magic.size()));
    EXPECT_LE(at + sizeof(PluginStamp), bytes_.size());
    return at;
  }

  // Where they lie in bytes_.
  std::vector<std::size_t> programHeaders() const {
    ElfW(Ehdr) head;
    std::memcpy(&head, bytes_.data(), sizeof head);
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < head.e_phnum; ++i)
      all.push_back(head.e_phoff + i * head.e_phentsize);
    return all;
  }

  test::Folder folder_;
  std::string bytes_ = test::contents(kGood);
};

TEST(Stamp, OfThisBuildFits) {
  EXPECT_EQ(refusal(PluginStamp()), "");
  EXPECT_EQ(refusal(kGood), "");
}

TEST(Stamp, EveryBitCounts) {
  for (std::size_t bit = 0; bit < 8 * sizeof(PluginStamp); ++bit) {
    std::array<unsigned char, sizeof(PluginStamp)> bytes;
    PluginStamp stamp;
    std::memcpy(bytes.data(), &stamp, sizeof stamp);
    bytes[bit / 8] ^= static_cast<unsigned char>(1U << bit % 8);
    std::memcpy(&stamp, bytes.data(), sizeof stamp);
    // A pbrt that has a sanitizer can do with plug-ins that have not.
    constexpr std::uint32_t kSanitizers = kAddressSanitizer | kThreadSanitizer | kMemorySanitizer;
    const bool onlyLacks = (buildOptions() & ~stamp.options & kSanitizers) != 0;
    EXPECT_EQ(refusal(stamp).empty(), onlyLacks) << "bit " << bit;
  }
}

TEST(Stamp, NamesTheOptionAndTheSide) {
  PluginStamp stamp;
  stamp.options ^= kLibcxx;
  EXPECT_EQ(refusal(stamp),
            buildOptions() & kLibcxx
                ? "it was built without libc++ (-stdlib=libc++), this pbrt with it; build it again "
                  "with it"
                : "it was built with libc++ (-stdlib=libc++), this pbrt was not; build it again "
                  "without");
}

TEST_F(Spoilt, TheCopyItselfIsGood) {
  EXPECT_EQ(reason(), "");
}

TEST_F(Spoilt, WhatIsNoSharedObject) {
  for (const char* text : {"", "\177", "\177ELF", "this is a text", "#!/bin/sh\n"}) {
    bytes_ = text;
    EXPECT_EQ(reason(), "it is no shared object") << text;
  }
  bytes_ = std::string(1000, '\0');
  EXPECT_EQ(reason(), "it is no shared object");
}

TEST_F(Spoilt, AnotherMachine) {
  for (const std::size_t at : {4, 5, 18}) {  // the class, the byte order, the machine
    bytes_ = test::contents(kGood);
    bytes_[at] ^= 1;
    EXPECT_EQ(reason(), "it was built for another kind of machine; build it again on this one");
  }
}

// The dynamic linker maps what the headers say and would meet a signal beyond the end.
TEST_F(Spoilt, CutShort) {
  const std::string whole = bytes_;
  std::size_t refused = 0;
  for (std::size_t part = 0; part < 100; ++part) {
    bytes_ = whole.substr(0, whole.size() * part / 100);
    refused += !reason().empty();
  }
  EXPECT_GT(refused, 50U);
  bytes_ = whole.substr(0, whole.size() / 2);
  EXPECT_EQ(reason(), "the file is cut short; build it again");
}

// What the dynamic linker would write to is said to be smaller than what the file has of it: it
// would set to zero all that lies behind in memory.
TEST_F(Spoilt, MoreInTheFileThanInMemory) {
  const std::string good = bytes_;
  int refused = 0;
  for (const std::size_t at : programHeaders()) {
    ElfW(Phdr) part;
    std::memcpy(&part, good.data() + at, sizeof part);
    if (part.p_type != PT_LOAD || part.p_filesz == 0) continue;
    part.p_memsz = part.p_filesz - 1;
    bytes_ = good;
    std::memcpy(bytes_.data() + at, &part, sizeof part);
    EXPECT_EQ(reason(), "its headers are damaged; build it again");
    ++refused;
  }
  EXPECT_GT(refused, 1);
}

// A file with a hole takes no room on the disk, but what is read of it does.
TEST_F(Spoilt, ATerabyteOfData) {
  constexpr std::uint64_t size = std::uint64_t{1} << 40;
  for (const std::size_t at : programHeaders()) {
    ElfW(Phdr) part;
    std::memcpy(&part, bytes_.data() + at, sizeof part);
    if (part.p_type != PT_LOAD || !(part.p_flags & PF_W)) continue;
    part.p_filesz = part.p_memsz = size - part.p_offset;
    std::memcpy(bytes_.data() + at, &part, sizeof part);
  }
  write();
  std::error_code refused;
  fs::resize_file(file(), size, refused);
  if (refused) GTEST_SKIP() << "the file system has no files as large: " << refused.message();
  EXPECT_EQ(refusal(file()),
            "it has 1048575 MiB of data that may be written to, a plug-in at most 256");
}

TEST_F(Spoilt, FoldersAndPipes) {
  fs::create_directory(file());
  EXPECT_EQ(refusal(file()), "it is a folder, a device or a pipe");
  fs::remove(file());
  ASSERT_EQ(mkfifo(file().c_str(), 0600), 0);
  EXPECT_EQ(refusal(file()), "it is a folder, a device or a pipe");
  fs::remove(file());
  EXPECT_EQ(refusal(file()), "there is no such file");
}

TEST_F(Spoilt, AFileThatMayNotBeRead) {
  write();
  fs::permissions(file(), fs::perms::none);
  if (geteuid() == 0) GTEST_SKIP() << "root may read everything";
  EXPECT_EQ(refusal(file()), "it cannot be read: Permission denied");
}

TEST_F(Spoilt, NoMutationOfTheStampIsOpened) {
  const std::string good = bytes_;
  const std::size_t at = stamp();
  Rng rng(1);
  for (int i = 0; i < 2000; ++i) {
    bytes_ = good;
    for (std::uint32_t n = 1 + rng.uniform(4); n > 0; --n)
      bytes_[at + rng.uniform(sizeof(PluginStamp))] ^= static_cast<char>(1 + rng.uniform(255));
    PluginStamp mutated;
    std::memcpy(&mutated, bytes_.data() + at, sizeof mutated);
    if (refusal(mutated).empty()) continue;  // it is the old one, or lacks our sanitizer
    EXPECT_NE(reason(), "") << "mutation " << i;
  }
}

// Reading the headers is safe whatever they say; the answer may be yes.
TEST_F(Spoilt, NoMutationOfTheHeadersDoesHarm) {
  const std::string good = bytes_;
  Rng rng(2);
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    bytes_ = good;
    for (std::uint32_t n = 1 + rng.uniform(8); n > 0; --n)
      bytes_[rng.uniform(64 + 56 * 8)] = static_cast<char>(rng.uniform(4) ? rng.bits() : 0xff);
    write();
    refused += !refusal(file()).empty();
  }
  EXPECT_GT(refused, 500);
}

// By itself the dynamic linker would look for it among the libraries of the system.
TEST(OpenPlugin, AFileOfTheWorkingDirectory) {
  const fs::path before = fs::current_path();
  fs::current_path(kGood.parent_path());
  EXPECT_STREQ(openPlugin("sphere.so").name, "sphere");
  fs::current_path(before);
}

}  // namespace
}  // namespace pbrt
