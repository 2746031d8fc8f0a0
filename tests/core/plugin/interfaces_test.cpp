// No stamp can tell which virtual functions a plug-in was built for: the ABI number has to be
// raised by hand when they change. This test notices that they did, by what stood in the headers
// when it was last raised.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>

#include "core/plugin/stamp.h"
#include "tests/command.h"

namespace {

namespace fs = std::filesystem;

// The text without comments and directives, and with one space where there was any.
std::string bare(const std::string& text) {
  static const std::regex ignored("//[^\n]*|#[^\n]*|/\\*.*?\\*/"), spaces("\\s+");
  return std::regex_replace(std::regex_replace(text, ignored, ""), spaces, " ");
}

// The virtual functions that a header declares, in their order, one a line, each class before its
// own. Bodies do not count, nor do functions that override others.
std::string virtualFunctions(const std::string& header) {
  static const std::regex head("\\b(class|struct) \\w+( final)?( : [^;{(]*)?$"),
      access("\\w+ ?: virtual\\b");
  std::string found, statement, named;
  std::vector<std::string> open;  // for each brace the class that it opens; empty: something else
  for (const char c : bare(header)) {
    if (c != ';' && c != '{' && c != '}') {
      statement += c;
      continue;
    }
    statement = std::regex_replace(statement, access, "virtual");
    statement.erase(0, statement.find_first_not_of(' '));
    statement.erase(statement.find_last_not_of(' ') + 1);
    if (statement.starts_with("virtual ")) {
      if (open.back() != named) found += (named = open.back()) + "\n";
      found += "  " + statement + "\n";
    }
    if (std::smatch match; c == '{')
      open.push_back(std::regex_search(statement, match, head) ? match.str() : "");
    if (c == '}') open.pop_back();
    statement.clear();
  }
  return found;
}

std::string ofTheTree() {
  std::vector<fs::path> headers;
  for (const char* layer : {"base", "api", "plugin"})
    for (const auto& entry : fs::directory_iterator(fs::path(PBRT_SOURCE_DIR) / "core" / layer))
      if (entry.path().extension() == ".h") headers.push_back(entry.path());
  std::sort(headers.begin(), headers.end());
  std::string all = "plug-in ABI " + std::to_string(pbrt::kAbiVersion) + "\n";
  for (const fs::path& header : headers) all += virtualFunctions(pbrt::test::contents(header));
  return all;
}

TEST(Interfaces, ChangeOnlyWithTheAbiNumber) {
  const std::string now = ofTheTree();
  const fs::path known = PBRT_SOURCE_DIR "/tests/core/plugin/interfaces.txt";
  if (now == pbrt::test::contents(known)) return;
  const fs::path current = PBRT_BUILD_DIR "/tests/interfaces.txt";
  std::ofstream(current) << now;
  FAIL() << "The virtual functions of core/ are not those of plug-in ABI " << pbrt::kAbiVersion
         << ". If there is a release with that number, raise kAbiVersion in core/plugin/stamp.h; "
            "then\n  cp "
         << current.string() << " " << known.string()
         << "\nand say in CHANGELOG.md that plug-ins have to be built again. What changed:\n  diff "
         << known.string() << " " << current.string();
}

TEST(Interfaces, AreReadFromHeaders) {
  EXPECT_EQ(virtualFunctions("struct A { int f() { return 1; } };"), "");
  EXPECT_EQ(virtualFunctions("#include <a>\n"
                             "namespace n {\n"
                             "class A : public B {  // virtual of course\n"
                             " public:\n"
                             "  struct Setup { int n = 0; };\n"
                             "  virtual ~A();\n"
                             "  virtual int f(int a,\n"
                             "                int /*b*/) const = 0;  // any\n"
                             "  int g() const { return f(1, 2); }\n"
                             "  int h() const override { return 1; }\n"
                             " private:\n"
                             "  virtual void i() { g(); }\n"
                             "};\n"
                             "struct C final { virtual ~C(); };\n"
                             "}  // namespace n\n"),
            "class A : public B\n"
            "  virtual ~A()\n"
            "  virtual int f(int a, int ) const = 0\n"
            "  virtual void i()\n"
            "struct C final\n"
            "  virtual ~C()\n");
}

}  // namespace
