// The documents say what is true of the tree: quotations are verbatim, links lead somewhere.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using Lines = std::vector<std::string>;

const fs::path kRoot = PBRT_SOURCE_DIR;
const fs::path kTutorial = kRoot / "docs" / "adding-a-plugin.md";

// Without white space at the ends of lines.
Lines linesOf(const fs::path& file) {
  std::ifstream in(file);
  EXPECT_TRUE(in) << file;
  Lines lines;
  for (std::string line; std::getline(in, line);)
    lines.push_back(line.substr(0, line.find_last_not_of(" \t\r") + 1));
  return lines;
}

std::string textOf(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

// Without the blocks of code, where brackets are no links.
std::string proseOf(const fs::path& file) {
  std::string text;
  bool code = false;
  for (const std::string& line : linesOf(file)) {
    const bool fence = line.starts_with("```");
    code ^= fence;
    if (!code && !fence) text += line + "\n";
  }
  return text;
}

std::vector<std::smatch> matches(const std::string& text, const std::regex& pattern) {
  return {std::sregex_iterator(text.begin(), text.end(), pattern), {}};
}

struct Quotation {
  std::string file;  // in "```cpp file"
  Lines lines;
};

std::vector<Quotation> quotations(const fs::path& document) {
  const std::string fence = "```cpp ";
  std::vector<Quotation> found;
  bool open = false;
  for (const std::string& line : linesOf(document)) {
    if (line == "```") {
      open = false;
    } else if (line.starts_with(fence)) {
      found.push_back({line.substr(fence.size()), {}});
      open = true;
    } else if (open) {
      found.back().lines.push_back(line);
    }
  }
  return found;
}

std::vector<fs::path> documents() {
  std::vector<fs::path> files = {kRoot / "README.md", kRoot / "CONTRIBUTING.md"};
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "docs"))
    if (entry.path().extension() == ".md") files.push_back(entry.path());
  return files;
}

TEST(Docs, QuotationsAreVerbatim) {
  for (const fs::path& document : documents())
    for (const Quotation& q : quotations(document)) {
      const Lines source = linesOf(kRoot / q.file);
      EXPECT_FALSE(std::ranges::search(source, q.lines).empty())
          << document << " misquotes " << q.file << " from \"" << q.lines.at(0) << "\" on";
    }
}

// What it shows of the examples is held to them by tests/kit/tutorial.cpp.
TEST(Docs, ExamplesNeedFewerThan100Lines) {
  int examples = 0;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "examples")) {
    if (entry.path().extension() != ".cpp") continue;
    ++examples;
    EXPECT_LT(linesOf(entry.path()).size(), 100U) << entry.path();
  }
  EXPECT_EQ(examples, 3);
}

TEST(Docs, TheSphereNeedsAsManyLinesAsTheTutorialSays) {
  const std::size_t lines = linesOf(kRoot / "shapes" / "sphere.cpp").size();
  EXPECT_LT(lines, 80U);
  EXPECT_NE(textOf(kTutorial).find(std::to_string(lines) + " lines"), std::string::npos);
}

TEST(Docs, LinksLeadToFiles) {
  for (const fs::path& document : documents()) {
    const std::string text = proseOf(document);
    for (const std::smatch& link : matches(text, std::regex(R"(\]\(([^)#\s]+)[^)]*\))"))) {
      const std::string target = link[1];
      if (target.find("://") != std::string::npos) continue;
      EXPECT_TRUE(fs::exists(document.parent_path() / target)) << document << ": " << target;
    }
  }
}

// What links name the headings of a document by.
std::set<std::string> anchors(const fs::path& document) {
  std::set<std::string> found;
  for (const std::string& line : linesOf(document)) {
    if (!line.starts_with('#')) continue;
    std::string anchor;
    for (const unsigned char c : line.substr(line.find_first_not_of("# ")))
      if (std::isalnum(c) || c == ' ' || c == '-' || c == '_')
        anchor += c == ' ' ? '-' : static_cast<char>(std::tolower(c));
    found.insert(anchor);
  }
  return found;
}

TEST(Docs, LinksLeadToHeadings) {
  for (const fs::path& document : documents()) {
    const std::string text = proseOf(document);
    std::map<fs::path, std::set<std::string>> headings;
    for (const std::smatch& link : matches(text, std::regex(R"(\]\(([\w./-]*)#([^)]+)\))"))) {
      const fs::path target = link.length(1) ? document.parent_path() / link.str(1) : document;
      if (!headings.contains(target)) headings[target] = anchors(target);
      EXPECT_TRUE(headings[target].contains(link.str(2))) << document << ": " << link.str();
    }
  }
}

TEST(Docs, ExitCodesAreThoseOfFailure) {
  const auto codes = [](const std::string& text, const char* pattern) {
    std::set<std::string> found;
    for (const std::smatch& code : matches(text, std::regex(pattern))) found.insert(code[1]);
    return found;
  };
  std::smatch failure;
  const std::string source = textOf(kRoot / "core" / "base" / "error.h");
  ASSERT_TRUE(std::regex_search(source, failure, std::regex(R"(enum class Failure[^}]*\})")));
  std::set<std::string> expected = codes(failure.str(), R"(= (\d+))");
  expected.insert({"0", "1", "75"});  // done; a bug; interrupted
  EXPECT_EQ(codes(textOf(kRoot / "README.md"), R"(\n\| (\d+) \|)"), expected);
}

}  // namespace
