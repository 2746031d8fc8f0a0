// docs/adding-a-plugin.md, word for word, in an empty folder, with what is installed alone: files
// are written as they are shown, commands print what is said that they print.
//
//   ```sh                    commands; they must succeed
//   ```                      behind them: lines of their output, in this order; "..." for any
//   ```cpp examples/a/a.cpp  a file, or the next piece of it, that the reader writes to a/a.cpp

#include <gmock/gmock.h>

#include <map>
#include <sstream>

#include "tests/command.h"

namespace pbrt {
namespace {

namespace fs = std::filesystem;

struct Block {
  std::string info, text;
  int line = 0;
};

std::vector<Block> blocks(const fs::path& document) {
  std::ifstream in(document);
  std::vector<Block> found;
  bool open = false;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.starts_with("```")) {
      open = !open;
      if (open) found.push_back({line.substr(3), "", number});
    } else if (open) {
      found.back().text += line + "\n";
    }
  }
  return found;
}

// The lines that are not printed, in their order.
std::string missing(const std::string& wanted, const std::string& printed) {
  std::istringstream lines(wanted);
  std::size_t at = 0;
  std::string lacking;
  for (std::string line; std::getline(lines, line);) {
    if (line.find("...") != line.npos) continue;
    const std::size_t found = printed.find(line + "\n", at);
    if (found == printed.npos)
      lacking += line + "\n";
    else
      at = found + line.size();
  }
  return lacking;
}

TEST(Tutorial, WorksWordForWord) {
  const test::Folder folder;
  std::map<std::string, int> pieces;
  std::string printed;
  int commands = 0;
  for (const Block& block : blocks(PBRT_SOURCE_DIR "/docs/adding-a-plugin.md")) {
    SCOPED_TRACE("the block of line " + std::to_string(block.line));
    if (block.info == "sh") {
      folder.write("block.sh", "set -e\n" + block.text);
      const test::Outcome run =
          folder.command("env -u PBRT_PLUGIN_PATH -u CMAKE_PREFIX_PATH PATH='" PBRT_KIT
                         "/prefix/bin':\"$PATH\" bash block.sh 2>&1");
      ASSERT_EQ(run.code, 0) << block.text << run.out;
      printed = run.out;
      ++commands;
    } else if (block.info.empty()) {
      EXPECT_EQ(missing(block.text, printed), "") << printed;
    } else if (const std::size_t at = block.info.find(" examples/"); at != block.info.npos) {
      const std::string name = block.info.substr(at + 10);
      const bool first = pieces[name]++ == 0;
      std::ofstream(folder.path() / name, first ? std::ios::trunc : std::ios::app) << block.text;
    }
  }
  EXPECT_GE(commands, 6);
  EXPECT_GE(pieces.size(), 3U);
  for (const auto& [name, count] : pieces)
    EXPECT_EQ(test::contents(folder.path() / name),
              test::contents(fs::path(PBRT_SOURCE_DIR) / "examples" / name))
        << name << " is not shown as it is";
}

}  // namespace
}  // namespace pbrt
