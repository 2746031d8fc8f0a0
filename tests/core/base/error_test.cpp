#include "core/base/error.h"

#include <gtest/gtest.h>

#include <array>

namespace pbrt {
namespace {

std::string shown(const Source& source, std::size_t begin, std::size_t length) {
  return format(diagnose(Severity::error, {&source, begin, length}, "message"));
}

TEST(Diagnose, GivesLineColumnAndTheLine) {
  const Source source{"a.pbrt", "one\ntwo three\nfour"};
  const Diagnostic d = diagnose(Severity::warning, {&source, 8, 5}, "odd");
  EXPECT_EQ(d.file, "a.pbrt");
  EXPECT_EQ(d.line, 2U);
  EXPECT_EQ(d.column, 5U);
  EXPECT_EQ(d.length, 5U);
  EXPECT_EQ(d.quote, "two three");
  EXPECT_EQ(d.quoteColumn, 4U);
  EXPECT_EQ(format(d), "a.pbrt:2:5: warning: odd\n 2 | two three\n   |     ^~~~~");
}

TEST(Diagnose, WithoutAPlaceIsTheMessageAlone) {
  EXPECT_EQ(format(diagnose(Severity::note, {}, "so")), "note: so");
}

TEST(Diagnose, EveryByteOfATextHasTheLineAndColumnOfAPlainCount) {
  const Source source{"a", "\n\nab\n\ncde\n\n"};
  std::size_t line = 1;
  std::size_t column = 1;
  for (std::size_t i = 0; i <= source.text.size(); ++i) {
    const Diagnostic d = diagnose(Severity::error, {&source, i, 1}, "");
    EXPECT_EQ(d.line, line) << i;
    EXPECT_EQ(d.column, column) << i;
    const bool newLine = i < source.text.size() && source.text[i] == '\n';
    line += newLine ? 1 : 0;
    column = newLine ? 1 : column + 1;
  }
}

TEST(Diagnose, PlacesAtAndBeyondTheEnd) {
  const Source source{"a", "ab"};
  EXPECT_EQ(shown(source, 2, 0), "a:1:3: error: message\n 1 | ab\n   |   ^");
  EXPECT_EQ(shown(source, 99, 99), "a:1:3: error: message\n 1 | ab\n   |   ^");
  const Source empty{"a", ""};
  EXPECT_EQ(shown(empty, 0, 1), "a:1:1: error: message\n 1 | \n   | ^");
}

TEST(Diagnose, AMarkEndsWithItsLine) {
  const Source source{"a", "x [1\n2 3]\n"};
  EXPECT_EQ(shown(source, 2, 7), "a:1:3: error: message\n 1 | x [1\n   |   ^~");
}

TEST(Diagnose, TabsAreKeptAndCarriageReturnsAreNot) {
  const Source source{"a", "\ta\tbad\r\n"};
  EXPECT_EQ(shown(source, 3, 3), "a:1:4: error: message\n 1 | \ta\tbad\n   | \t \t^~~");
}

TEST(Diagnose, CharactersOfSeveralBytesTakeOneColumn) {
  const Source source{"a", "\"\xC3\xA4\xC3\xB6\" \xC3\xBC\xC3\xBC x"};
  EXPECT_EQ(shown(source, 7, 4),
            "a:1:8: error: message\n 1 | \"\xC3\xA4\xC3\xB6\" \xC3\xBC\xC3\xBC x\n   |      ^~");
}

TEST(Diagnose, AByteOrderMarkTakesNoColumn) {
  const Source source{"a",
                      "\xEF\xBB\xBF"
                      "ab"};
  EXPECT_EQ(shown(source, 4, 1), "a:1:2: error: message\n 1 | ab\n   |  ^");
}

TEST(Diagnose, ControlCharactersDoNotReachTheTerminal) {
  const Source source{"a", std::string("a\0\x1B[2Jb", 7)};
  EXPECT_EQ(shown(source, 1, 1), "a:1:2: error: message\n 1 | a??[2Jb\n   |  ^");
}

TEST(Diagnose, LongLinesAreQuotedAsAWindowAboutTheMark) {
  Source source{"a", std::string(100000, '.')};
  for (const std::size_t at : {std::size_t{0}, std::size_t{10}, std::size_t{50000},
                               std::size_t{99990}, std::size_t{99999}}) {
    source.text[at] = 'X';
    const Diagnostic d = diagnose(Severity::error, {&source, at, 1}, "");
    EXPECT_EQ(d.column, at + 1);
    EXPECT_LT(d.quote.size(), 110U);
    EXPECT_EQ(d.quote[d.quoteColumn], 'X');
    source.text[at] = '.';
  }
}

TEST(Diagnose, WindowsAreCutBetweenCharacters) {
  Source source{"a", {}};
  for (int i = 0; i < 1000; ++i) source.text += "\xE2\x82\xAC";  // 3 bytes
  for (std::size_t i = 0; i < 1000; ++i) {
    const Diagnostic d = diagnose(Severity::error, {&source, 3 * i, 3}, "");
    EXPECT_EQ(d.quote.substr(d.quoteColumn, 3), "\xE2\x82\xAC");
    std::size_t dots = 0;
    for (const char c : d.quote) dots += c == '.' ? 1 : 0;
    EXPECT_EQ((d.quote.size() - dots) % 3, 0U) << i;
  }
}

TEST(Error, ShowsItsDiagnosticsAndKeepsItsKind) {
  const Source source{"a.pbrt", "abc"};
  const Error error({&source, 1, 1}, "bad", Failure::plugin);
  EXPECT_STREQ(error.what(), "a.pbrt:1:2: error: bad\n 1 | abc\n   |  ^");
  EXPECT_EQ(error.failure(), Failure::plugin);
  EXPECT_STREQ(Error("alone").what(), "error: alone");
}

TEST(Error, AtPlacesOnlyWhatHasNoPlace) {
  const Source source{"a.pbrt", "abc"};
  const Error error({diagnose(Severity::error, {&source, 0, 1}, "first"),
                     diagnose(Severity::warning, {}, "second")},
                    Failure::io);
  const Error placed = error.at({&source, 2, 1});
  ASSERT_EQ(placed.diagnostics().size(), 2U);
  EXPECT_EQ(placed.diagnostics()[0].column, 1U);
  EXPECT_EQ(placed.diagnostics()[1].column, 3U);
  EXPECT_EQ(placed.diagnostics()[1].severity, Severity::warning);
  EXPECT_EQ(placed.diagnostics()[1].message, "second");
  EXPECT_EQ(placed.failure(), Failure::io);
}

TEST(Error, OutlivesItsSource) {
  Error error("");
  {
    const Source source{"gone.pbrt", "text"};
    error = Error({&source, 0, 4}, "m");
  }
  EXPECT_EQ(format(error.diagnostics()[0]), "gone.pbrt:1:1: error: m\n 1 | text\n   | ^~~~");
}

const std::vector<std::string> kShapes{"sphere", "cylinder", "disk", "trianglemesh"};

TEST(Closest, FindsEveryKindOfEdit) {
  EXPECT_EQ(closest("sphere", kShapes), "sphere");
  EXPECT_EQ(closest("SPHERE", kShapes), "sphere");
  EXPECT_EQ(closest("shpere", kShapes), "sphere");      // swap
  EXPECT_EQ(closest("spere", kShapes), "sphere");       // insert
  EXPECT_EQ(closest("spherre", kShapes), "sphere");     // delete
  EXPECT_EQ(closest("cilinder", kShapes), "cylinder");  // replace
  EXPECT_EQ(closest("TriangelMehs", kShapes), "trianglemesh");
}

TEST(Closest, IsSilentBeyondAThirdOfTheLength) {
  EXPECT_EQ(closest("spxxre", kShapes), "sphere");  // 2 of 6
  EXPECT_EQ(closest("sxxxre", kShapes), "");        // 3 of 6
  EXPECT_EQ(closest("", kShapes), "");
  EXPECT_EQ(closest("d", kShapes), "");
  EXPECT_EQ(closest(std::string(100000, 'x'), kShapes), "");
  EXPECT_EQ(closest("sphere", {}), "");
}

TEST(Closest, PrefersTheNearest) {
  const std::vector<std::string> names{"abcdefxx", "abcdefgx", "abcdefgh"};
  EXPECT_EQ(closest("abcdefgh", names), "abcdefgh");
  EXPECT_EQ(closest("abcdefgi", names), "abcdefgx");  // the first of two at the same distance
}

TEST(Closest, IsPhrasedAsAQuestion) {
  EXPECT_EQ(didYouMean("shpere", kShapes), "; did you mean \"sphere\"?");
  EXPECT_EQ(didYouMean("teapot", kShapes), "");
}

}  // namespace
}  // namespace pbrt
