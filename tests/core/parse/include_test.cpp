// Files that include files.

#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include "tests/core/parse/parsing.h"

namespace pbrt {
namespace {

namespace fs = std::filesystem;

class Include : public testing::Test {
 protected:
  Include() { fs::create_directories(folder_); }
  ~Include() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const std::string& text) {
    const fs::path path = folder_ / name;
    fs::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }
  // The first words of the directives, in their order.
  std::string read(const fs::path& path) {
    std::string words;
    Parser parser([&](Directive&& d) { words += d.words.empty() ? "-" : d.words[0]; });
    parser.file(path);
    return words;
  }
  Error errorOf(const fs::path& path) {
    try {
      read(path);
    } catch (const Error& error) {
      return error;
    }
    ADD_FAILURE() << "no error";
    return Error("");
  }
  void expectError(const fs::path& path, const std::string& file, std::size_t line,
                   std::size_t column, const std::string& message) {
    const Error error = errorOf(path);
    const Diagnostic& d = error.diagnostics().at(0);
    EXPECT_EQ(error.failure(), Failure::scene);
    EXPECT_EQ(d.file, (folder_ / file).string());
    EXPECT_EQ(d.line, line);
    EXPECT_EQ(d.column, column);
    EXPECT_EQ(d.message, message);
  }

  const fs::path folder_ = fs::path(testing::TempDir()) /
                           ("pbrt_include_" + std::to_string(::getpid()) + "_" +
                            testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(Include, IsReadInItsPlace) {
  write("b.pbrt", "Shape \"2\" Shape \"3\"");
  EXPECT_EQ(read(write("a.pbrt", "Shape \"1\"\nInclude \"b.pbrt\" Shape \"4\" Include \"b.pbrt\"")),
            "123423");
}

TEST_F(Include, IsWhatImportIsToo) {
  write("sub/b.pbrt", "Shape \"2\" Import \"c.pbrt\"");
  write("sub/c.pbrt", "Shape \"3\"");
  EXPECT_EQ(read(write("a.pbrt", "Shape \"1\" Import \"sub/b.pbrt\" Shape \"4\"")), "1234");
  expectError(write("d.pbrt", "Import \"d.pbrt\""), "d.pbrt", 1, 8,
              (folder_ / "d.pbrt").string() + " includes itself");
}

TEST_F(Include, IsFoundBesideTheIncludingFileOrTheFirst) {
  write("geometry/b.pbrt", "Shape \"b\" Include \"c.pbrt\" Include \"geometry/d.pbrt\"");
  write("geometry/c.pbrt", "Shape \"c\"");
  write("geometry/d.pbrt", "Shape \"d\"");
  write("c.pbrt", "Shape \"wrong\"");
  EXPECT_EQ(read(write("a.pbrt", "Include \"geometry/b.pbrt\"")), "bcd");
}

TEST_F(Include, TakesAbsoluteAndOddNames) {
  const std::string odd = "a b \"#]\xC3\xA4\\.pbrt";
  write(odd, "Shape \"odd\"");
  const fs::path absolute = write("c.pbrt", "Shape \"c\"");
  EXPECT_EQ(read(write("a.pbrt", "Include \"a b \\\"#]\xC3\xA4\\\\.pbrt\" Include \"" +
                                     absolute.string() + "\"")),
            "oddc");
}

TEST_F(Include, OfAMissingFileIsAnErrorThere) {
  expectError(write("a.pbrt", "WorldBegin\n  Include \"no.pbrt\""), "a.pbrt", 2, 11,
              "cannot read " + (folder_ / "no.pbrt").string() + ": No such file or directory");
  fs::create_directories(folder_ / "sub");
  expectError(write("a.pbrt", "Include \"sub\""), "a.pbrt", 1, 9,
              "cannot read " + (folder_ / "sub").string() + ": it is not a file");
  EXPECT_EQ(errorOf(write("a.pbrt", "Include \"\"")).failure(), Failure::scene);
}

TEST_F(Include, OfAFileThatIsBeingReadIsAnErrorThere) {
  expectError(write("a.pbrt", "\nInclude \"a.pbrt\""), "a.pbrt", 2, 9,
              (folder_ / "a.pbrt").string() + " includes itself");
  write("b.pbrt", "Include \"./../" + folder_.filename().string() + "/a.pbrt\"");
  expectError(write("a.pbrt", "Include \"b.pbrt\""), "b.pbrt", 1, 9,
              (folder_ / "./.." / folder_.filename() / "a.pbrt").string() + " includes itself");
  fs::create_symlink(folder_ / "a.pbrt", folder_ / "link.pbrt");
  expectError(write("a.pbrt", "Include \"link.pbrt\""), "a.pbrt", 1, 9,
              (folder_ / "link.pbrt").string() + " includes itself");
}

TEST_F(Include, GoesThirtyTwoDeep) {
  for (int i = 1; i < 33; ++i)
    write(std::to_string(i), "Include \"" + std::to_string(i + 1) + "\"");
  write("33", "Shape \"deep\"");
  EXPECT_EQ(read(folder_ / "1"), "deep");
  expectError(write("0", "Include \"1\""), "32", 1, 9, "includes are nested more than 32 deep");
}

// Each file includes the next twice: 2^31 of them, were there no end.
TEST_F(Include, EndsWhereFilesMultiply) {
  for (int i = 0; i < 31; ++i) {
    const std::string next = "Include \"" + std::to_string(i + 1) + "\"\n";
    write(std::to_string(i), next + next);
  }
  write("31", "");
  const Error error = errorOf(folder_ / "0");
  EXPECT_EQ(error.diagnostics()[0].message, "more than 100000 files are included");
}

TEST_F(Include, TheSameFileIsReadOnce) {
  const fs::path b = write("b.pbrt", "Shape \"b\"");
  std::vector<const Source*> sources;
  Parser parser([&](Directive&& d) { sources.push_back(d.where.source); });
  parser.file(write("a.pbrt", "Include \"b.pbrt\" Include \"b.pbrt\""));
  ASSERT_EQ(sources.size(), 2U);
  EXPECT_EQ(sources[0], sources[1]);
}

TEST_F(Include, OfAPackedFile) {
  write("b.pbrt", "Shape \"b\"");
  const std::string pack =
      "gzip -c " + (folder_ / "b.pbrt").string() + " >" + (folder_ / "b.pbrt.gz").string();
  ASSERT_EQ(std::system(pack.c_str()), 0);
  EXPECT_EQ(read(write("a.pbrt", "Include \"b.pbrt.gz\"")), "b");
  EXPECT_EQ(read(folder_ / "b.pbrt.gz"), "b");
}

TEST_F(Include, OfADeviceOrAPipeIsAnErrorThere) {
  expectError(write("a.pbrt", "Include \"/dev/zero\""), "a.pbrt", 1, 9,
              "cannot read /dev/zero: it is not a file");
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  expectError(write("a.pbrt", "Include \"pipe\""), "a.pbrt", 1, 9,
              "cannot read " + pipe.string() + ": it is not a file");
}

// A folder that links to itself gives each file endlessly many names.
TEST_F(Include, SeesThroughLinkedFolders) {
  fs::create_directory_symlink(".", folder_ / "here");
  expectError(write("a.pbrt", "Include \"here/here/here/a.pbrt\""), "a.pbrt", 1, 9,
              (folder_ / "here/here/here/a.pbrt").string() + " includes itself");
}

TEST_F(Include, ErrorsNameTheIncludedFile) {
  write("b.pbrt", "\n\n Shpae");
  expectError(write("a.pbrt", "Include \"b.pbrt\""), "b.pbrt", 3, 2,
              "unknown directive; did you mean \"Shape\"?");
}

TEST_F(Include, EndsAStatementOfTheIncludingFile) {
  write("b.pbrt", "\"float x\" 1");
  expectError(write("a.pbrt", "Shape \"s\" Include \"b.pbrt\""), "b.pbrt", 1, 1,
              "expected a directive");
}

TEST_F(Include, IsRelativeToTheFolderOfAText) {
  write("b.pbrt", "Shape \"b\"");
  int count = 0;
  Parser parser([&](Directive&&) { ++count; });
  parser.text("<stdin>", "Include \"b.pbrt\"", folder_);
  EXPECT_EQ(count, 1);
}

TEST_F(Include, AFileThatCannotBeReadIsAnErrorOfInput) {
  const Error missing = errorOf(folder_ / "no.pbrt");
  EXPECT_EQ(missing.failure(), Failure::io);
  EXPECT_EQ(missing.diagnostics()[0].message,
            "cannot read " + (folder_ / "no.pbrt").string() + ": No such file or directory");
  const Error directory = errorOf(folder_);
  EXPECT_EQ(directory.failure(), Failure::io);
  EXPECT_EQ(directory.diagnostics()[0].message,
            "cannot read " + folder_.string() + ": it is not a file");
}

TEST_F(Include, AnEmptyFileIsNoError) {
  EXPECT_EQ(read(write("a.pbrt", "")), "");
}

// Real scenes, where they are at hand.
TEST(Scenes, AllParse) {
  const fs::path scenes = fs::path(PBRT_SOURCE_DIR) / "../shared/scenes";
  if (!fs::exists(scenes)) GTEST_SKIP() << "no scenes here";
  int read = 0;
  for (const auto& entry : fs::recursive_directory_iterator(scenes)) {
    // Geometry is included by the scenes, and its own includes are relative to them.
    if (entry.path().extension() != ".pbrt" || entry.path().parent_path().filename() == "geometry")
      continue;
    int directives = 0;
    Parser parser([&](Directive&&) { ++directives; });
    EXPECT_NO_THROW(parser.file(entry.path())) << entry.path();
    EXPECT_GT(directives, 5) << entry.path();
    ++read;
  }
  EXPECT_GT(read, 0);
}

}  // namespace
}  // namespace pbrt
