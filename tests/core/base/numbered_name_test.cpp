// Names of files that are numbered.

#include "core/base/numbered_name.h"

#include <gtest/gtest.h>

#include <limits>

namespace pbrt {
namespace {

TEST(NumberedName, EachRunBecomesTheNumber) {
  EXPECT_EQ(numbered("out/####.exr", 7), "out/0007.exr");
  EXPECT_EQ(numbered("out/####.exr", 12345), "out/12345.exr") << "more digits than #";
  EXPECT_EQ(numbered("#", 0), "0");
  EXPECT_EQ(numbered("##", 0), "00");
  EXPECT_EQ(numbered("s#/a##b###", 12), "s12/a12b012");
  EXPECT_EQ(numbered("##", std::numeric_limits<int>::max()), "2147483647");
  EXPECT_EQ(numbered("no number", 7), "no number");
  EXPECT_EQ(numbered("", 7), "");
  EXPECT_EQ(numbered("{}%d#", 7), "{}%d7") << "nothing else has a meaning";
}

TEST(NumberedName, RunsAreCounted) {
  EXPECT_EQ(numberRuns(""), 0U);
  EXPECT_EQ(numberRuns("a.exr"), 0U);
  EXPECT_EQ(numberRuns("####"), 1U);
  EXPECT_EQ(numberRuns("#a#"), 2U);
  EXPECT_EQ(numberRuns("a##/b#.exr"), 2U);
}

TEST(NumberedName, ANumberIsFoundAgain) {
  for (const char* pattern : {"a##b", "##", "####.ply", "7##7", "f#0.ply", "#"})
    for (const int number : {0, 1, 7, 10, 77, 99, 100, 707, 123456, 2147483647})
      EXPECT_EQ(numberIn(pattern, numbered(pattern, number)), number) << pattern;
}

TEST(NumberedName, OtherNamesHaveNoNumber) {
  for (const char* name : {"", "a", "ab", "a7b", "a007b", "a-7b", "a+7b", "a 7b", "a0x7b", "a07",
                           "07b", "a07bb", "xa07b", "a07c", "a2147483648b", "a99999999999999b"})
    EXPECT_EQ(numberIn("a##b", name), std::nullopt) << name;
}

}  // namespace
}  // namespace pbrt
