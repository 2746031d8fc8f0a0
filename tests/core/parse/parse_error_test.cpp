// What is wrong is said in plain words, at its exact place.

#include "tests/core/parse/parsing.h"

namespace pbrt {
namespace {

using test::errorOf;

TEST(ParseErrors, UnknownDirectives) {
  EXPECT_EQ(errorOf("WorldBegin\n  Shpae \"sphere\""),
            "2:3: unknown directive; did you mean \"Shape\"?");
  EXPECT_EQ(errorOf("includ \"x\""), "1:1: unknown directive; did you mean \"Include\"?");
  EXPECT_EQ(errorOf("Teapot"), "1:1: unknown directive");
  EXPECT_EQ(errorOf("Shape \"a\" Shpae"), "1:11: unknown directive; did you mean \"Shape\"?");
  EXPECT_EQ(errorOf("Scale 1 1 1\nShpae \"s\""),
            "2:1: expected a number or a directive; did you mean \"Shape\"?");
}

TEST(ParseErrors, KeywordsInTheWrongCase) {
  EXPECT_EQ(errorOf("worldbegin"), "1:1: unknown directive; did you mean \"WorldBegin\"?");
  EXPECT_EQ(errorOf("Scale 1 1 1 SHAPE \"s\""),
            "1:13: expected a number or a directive; did you mean \"Shape\"?");
  EXPECT_EQ(errorOf("Shape \"s\" \"bool x\" True"),
            "1:20: expected the value of the parameter; did you mean \"true\"?");
}

TEST(ParseErrors, Options) {
  const std::string wanted = "expected a parameter after Option, as in \"integer seed\" 1";
  EXPECT_EQ(errorOf("Option"), "1:1: " + wanted);
  EXPECT_EQ(errorOf("Option seed 1"), "1:8: " + wanted);
  EXPECT_EQ(errorOf("Option \"integer seed\""), "1:8: expected the value of the parameter");
  EXPECT_EQ(errorOf("Option \"integer seed\" 1.5"), "1:23: 1.5 is not an integer");
  EXPECT_EQ(errorOf("Option \"seed\" 1 \"b\" 2"), "1:17: expected a directive");
  EXPECT_EQ(errorOf("Option \"\" 1"),
            "1:8: expected the type and the name of a parameter, as in \"float fov\"");
}

TEST(ParseErrors, MissingNames) {
  EXPECT_EQ(errorOf("Shape"), "1:1: expected a quoted name after Shape");
  EXPECT_EQ(errorOf("\n Shape\nWorldEnd"), "2:2: expected a quoted name after Shape");
  EXPECT_EQ(errorOf("Shape sphere"), "1:7: expected a quoted name after Shape");
  EXPECT_EQ(errorOf("Shape [1]"), "1:7: expected a quoted name after Shape");
  EXPECT_EQ(errorOf("ObjectBegin ObjectEnd"), "1:1: expected a quoted name after ObjectBegin");
  EXPECT_EQ(errorOf("Include Include"), "1:1: expected a quoted name after Include");
  const std::string three = "expected three quoted names after Texture: name, type and class";
  EXPECT_EQ(errorOf("Texture \"a\""), "1:1: " + three);
  EXPECT_EQ(errorOf("Texture \"a\" \"float\" 3"), "1:21: " + three);
  const std::string time = "expected StartTime, EndTime or All after ActiveTransform";
  EXPECT_EQ(errorOf("ActiveTransform"), "1:1: " + time);
  EXPECT_EQ(errorOf("ActiveTransform WorldEnd"), "1:1: " + time);
  EXPECT_EQ(errorOf("ActiveTransform \"All\""), "1:17: " + time);
  EXPECT_EQ(errorOf("ActiveTransform StratTime"),
            "1:17: " + time + "; did you mean \"StartTime\"?");
}

TEST(ParseErrors, NumbersOfTransformations) {
  EXPECT_EQ(errorOf("Translate"), "1:1: expected numbers after Translate");
  EXPECT_EQ(errorOf("Translate\nRotate 1 2 3 4"), "1:1: expected numbers after Translate");
  EXPECT_EQ(errorOf("Translate \"a\""), "1:11: expected numbers after Translate");
  EXPECT_EQ(errorOf("Translate 1 2"), "1:1: expected 3 numbers after Translate, not 2");
  EXPECT_EQ(errorOf("LookAt 1 2 3 4 5 6 7 8 9 10"), "1:1: expected 9 numbers after LookAt, not 10");
  EXPECT_EQ(errorOf("Transform [1 2 3]"), "1:1: expected 16 numbers after Transform, not 3");
  EXPECT_EQ(errorOf("Scale [1 2 \"3\"]"), "1:12: expected numbers after Scale");
  EXPECT_EQ(errorOf("Scale 1 2 1e999"), "1:11: 1e999 is out of range");
}

TEST(ParseErrors, TooMuch) {
  EXPECT_EQ(errorOf("WorldBegin \"x\""), "1:12: expected a directive");
  EXPECT_EQ(errorOf("1"), "1:1: expected a directive");
  EXPECT_EQ(errorOf("MediumInterface \"a\" \"b\" \"c\""), "1:25: expected a directive");
  EXPECT_EQ(errorOf("]"), "1:1: this ] has no [");
  EXPECT_EQ(errorOf("Shape \"a\" \"float x\" [1]]"), "1:24: this ] has no [");
  EXPECT_EQ(errorOf("Shape \"a\" \"float x\" 1 0"),
            "1:23: expected a parameter, as in \"float fov\" 30, or the next directive; several "
            "values need brackets");
}

TEST(ParseErrors, Brackets) {
  EXPECT_EQ(errorOf("Shape \"a\" \"float x\" [1 2\nWorldEnd"), "1:21: this [ is not closed");
  EXPECT_EQ(errorOf("Shape \"a\" \"float x\" ["), "1:21: this [ is not closed");
  EXPECT_EQ(errorOf("Shape \"a\" \"float x\" [ \"a\" Include \"b\" ]"),
            "1:21: this [ is not closed");
  const std::string list = "expected numbers, quoted strings, true or false in the list";
  EXPECT_EQ(errorOf("Shape \"a\" \"float x\" [1 x]"), "1:24: " + list);
  EXPECT_EQ(errorOf("Shape \"a\" \"float x\" [[1]]"), "1:22: " + list);
  EXPECT_EQ(errorOf("Shape \"a\" \"float x\" " + std::string(1000000, '[')), "1:22: " + list);
}

TEST(ParseErrors, Strings) {
  const std::string open =
      "this string is not closed; it has to end on the line on which it begins";
  EXPECT_EQ(errorOf("Shape \"abc\n\""), "1:7: " + open);
  EXPECT_EQ(errorOf("Shape \"abc\r\n\""), "1:7: " + open);
  EXPECT_EQ(errorOf("Shape \""), "1:7: " + open);
  EXPECT_EQ(errorOf("Shape \"abc\\\""), "1:7: " + open);
  EXPECT_EQ(errorOf("Shape \"abc\\"), "1:7: " + open);
  EXPECT_EQ(errorOf("Shape \"" + std::string(100000, 'x')), "1:7: " + open);
  EXPECT_EQ(errorOf("Shape \"a\\qb\""), "1:9: unknown escape; a backslash itself is written \\\\");
}

TEST(ParseErrors, WhatIsTooLongOrTooMuch) {
  EXPECT_EQ(errorOf("Shape \"a\" \"string s\" \"" + std::string(65534, 'x') + "\""), "");
  EXPECT_EQ(errorOf("Shape \"a\" \"string s\" \"" + std::string(65535, 'x') + "\""),
            "1:22: this string is longer than 64 KiB");
  const auto parameters = [](int count) {
    std::string text = "Shape \"a\"";
    for (int i = 0; i < count; ++i) text += "\n\"float x" + std::to_string(i) + "\" 1";
    return text;
  };
  EXPECT_EQ(errorOf(parameters(1000)), "");
  EXPECT_EQ(errorOf(parameters(1000000)), "1002:1: a statement takes at most 1000 parameters");
}

TEST(ParseErrors, BytesOfNoText) {
  EXPECT_EQ(errorOf("@"), "1:1: unexpected character @");
  EXPECT_EQ(errorOf("\n \xFF"), "2:2: unexpected byte 0xff");
  EXPECT_EQ(errorOf(std::string("WorldBegin\n\0", 12)), "2:1: unexpected byte 0x00");
  EXPECT_EQ(errorOf(std::string("Shape \"a\0\"", 10)), "1:9: unexpected byte 0x00");
  EXPECT_EQ(errorOf(std::string("# c\0", 4)), "1:4: unexpected byte 0x00");
  EXPECT_EQ(errorOf(std::string("Shape \"a\" \"float x\" [1\0]", 24)),
            "1:23: unexpected byte 0x00");
  EXPECT_EQ(errorOf(" \xEF\xBB\xBF"), "1:2: unexpected byte 0xef");
}

TEST(ParseErrors, Declarations) {
  const std::string form = "expected the type and the name of a parameter, as in \"float fov\"";
  EXPECT_EQ(errorOf("Shape \"a\" \"x\" 1"), "1:11: " + form);
  EXPECT_EQ(errorOf("Shape \"a\" \"\" 1"), "1:11: " + form);
  EXPECT_EQ(errorOf("Shape \"a\" \"float a b\" 1"), "1:11: " + form);
  EXPECT_EQ(errorOf("Shape \"a\" \" flaot x\" 1"),
            "1:13: unknown parameter type; did you mean \"float\"?");
  EXPECT_EQ(errorOf("Shape \"a\" \"quaternion x\" 1"), "1:12: unknown parameter type");
  EXPECT_EQ(errorOf("Shape \"a\" \"float x\""), "1:11: expected the value of the parameter");
  EXPECT_EQ(errorOf("Shape \"a\" \"float x\" WorldEnd"),
            "1:11: expected the value of the parameter");
  EXPECT_EQ(errorOf("Shape \"a\" \"float x\" ]"), "1:21: expected the value of the parameter");
}

// The error of one parameter; columns count from the value.
std::string valueError(const std::string& type, const std::string& value) {
  const std::string begin = "Shape \"s\"\n\"" + type + " x\"\n";
  return errorOf(begin + value);
}

TEST(ParseErrors, ValuesOfAnotherType) {
  EXPECT_EQ(valueError("float", "\"1\""), "3:1: expected numbers, as the type is float");
  EXPECT_EQ(valueError("float", "[1 \"2\"]"), "3:4: expected numbers, as the type is float");
  EXPECT_EQ(valueError("integer", "true"), "3:1: expected numbers, as the type is integer");
  EXPECT_EQ(valueError("point", "\"a\""), "3:1: expected numbers, as the type is point");
  EXPECT_EQ(valueError("string", "1"), "3:1: expected quoted strings, as the type is string");
  EXPECT_EQ(valueError("string", "[1]"), "3:1: expected quoted strings, as the type is string");
  EXPECT_EQ(valueError("string", "[\"a\" 1]"),
            "3:6: expected quoted strings, as the type is string");
  EXPECT_EQ(valueError("texture", "[1]"), "3:1: expected the quoted name of a texture");
  const std::string boolean = "expected \"true\" or \"false\", as the type is bool";
  EXPECT_EQ(valueError("bool", "\"yes\""), "3:1: " + boolean);
  EXPECT_EQ(valueError("bool", "[true 1]"), "3:7: " + boolean);
  EXPECT_EQ(valueError("bool", "[0]"), "3:1: " + boolean);
  EXPECT_EQ(valueError("spectrum", "[\"a\" 1]"),
            "3:6: expected quoted names, as the first value is one");
  EXPECT_EQ(valueError("spectrum", "[1 \"a\"]"), "3:4: expected numbers, as the type is spectrum");
}

TEST(ParseErrors, Counts) {
  EXPECT_EQ(valueError("point", " [1 2 3 4]"),
            "3:2: point takes 3 numbers for each value, in brackets; here are 4");
  EXPECT_EQ(valueError("rgb", "1 0 0"),
            "3:1: rgb takes 3 numbers for each value, in brackets; here is 1");
  EXPECT_EQ(valueError("point2", "[1 2 3]"),
            "3:1: point2 takes 2 numbers for each value, in brackets; here are 3");
  EXPECT_EQ(valueError("spectrum", "[400 1 500]"),
            "3:1: spectrum takes 2 numbers for each value, in brackets; here are 3");
  EXPECT_EQ(valueError("blackbody", "[1 2 3]"),
            "3:1: blackbody takes a temperature, or pairs of a temperature and a scale, not 3 "
            "numbers");
  EXPECT_EQ(valueError("texture", "[\"a\" \"b\"]"), "3:1: expected the name of one texture");
  EXPECT_EQ(valueError("texture", "[]"), "3:1: expected the name of one texture");
}

TEST(ParseErrors, BadNumbersAreShownOnEitherPath) {
  for (const std::string comment : {"", "#\n"}) {
    const auto error = [&](const std::string& type, const std::string& number) {
      return valueError(type, "[ 1" + comment + " " + number + " 2]").substr(2);
    };
    const std::string column = comment.empty() ? "5: " : "2: ";
    EXPECT_EQ(error("float", "1e999"), column + "1e999 is out of range of a float");
    EXPECT_EQ(error("float", "-3.5e38"), column + "-3.5e38 is out of range of a float");
    EXPECT_EQ(error("float", "1.2.3"), column + "1.2.3 is not a number");
    EXPECT_EQ(error("float", "1-2"), column + "1-2 is not a number");
    EXPECT_EQ(error("float", "+-1"), column + "+-1 is not a number");
    EXPECT_EQ(error("float", "--1"), column + "--1 is not a number");
    EXPECT_EQ(error("float", "."), column + ". is not a number");
    EXPECT_EQ(error("float", "1e"), column + "1e is not a number");
    EXPECT_EQ(error("float", "1e+"), column + "1e+ is not a number");
    EXPECT_EQ(error("float", "0x10"), column + "0x10 is not a number");
    EXPECT_EQ(error("float", "1f"), column + "1f is not a number");
    EXPECT_EQ(error("float", "-inf"), column + "-inf is not a number");
    EXPECT_EQ(error("integer", "2.5"), column + "2.5 is not an integer");
    EXPECT_EQ(error("integer", "1e-3"), column + "1e-3 is not an integer");
    EXPECT_EQ(error("integer", "2147483648"), column + "2147483648 is out of range of an integer");
    EXPECT_EQ(error("integer", "-2147483649"),
              column + "-2147483649 is out of range of an integer");
    EXPECT_EQ(error("integer", "1e10"), column + "1e10 is out of range of an integer");
  }
}

TEST(ParseErrors, LongLinesAndLongNumbersStayShort) {
  std::string text = "Shape \"a\" \"float x\" [";
  for (int i = 0; i < 100000; ++i) text += "1.25 ";
  text += std::string(100000, '9') + "x]";
  try {
    test::Parsed parsed(text);
    FAIL();
  } catch (const Error& error) {
    EXPECT_LT(std::string(error.what()).size(), 500U);
    EXPECT_EQ(error.diagnostics()[0].column, 22 + 500000U);
  }
}

}  // namespace
}  // namespace pbrt
