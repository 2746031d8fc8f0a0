// Every statement and every type of parameter.

#include "core/parse/parse.h"

#include <fmt/format.h>

#include "tests/core/parse/parsing.h"

namespace pbrt {
namespace {

using test::Parsed;
using test::textAt;

constexpr int kKinds = static_cast<int>(DirectiveKind::WorldEnd) + 1;

// A right statement of a kind, as long as the format allows.
std::string example(DirectiveKind kind) {
  const Syntax& s = syntax(kind);
  std::string text(s.keyword);
  switch (s.arguments) {
    case Arguments::none:
      break;
    case Arguments::name:
      text += " \"n\"";
      break;
    case Arguments::names:
      text += " \"n\" \"o\"";
      break;
    case Arguments::plugin:
      text += " \"n\" \"float a\" 1 \"string b\" [\"x\" \"y\"]";
      break;
    case Arguments::texture:
      text += " \"n\" \"o\" \"p\" \"float a\" 1 \"string b\" [\"x\" \"y\"]";
      break;
    case Arguments::numbers:
      for (std::size_t i = 0; i < s.numbers; ++i) text += " " + std::to_string(i + 0.5);
      break;
    case Arguments::time:
      text += " EndTime";
      break;
    case Arguments::option:
      text += " \"bool a\" true";
      break;
  }
  return text;
}

TEST(Directives, EachKindIsReadWithItsArguments) {
  for (int i = 0; i < kKinds; ++i) {
    const auto kind = static_cast<DirectiveKind>(i);
    const std::string text = example(kind);
    const Parsed parsed(text);
    ASSERT_EQ(parsed.directives.size(), 1U) << text;
    const Directive& d = parsed.directives[0];
    EXPECT_EQ(d.kind, kind);
    EXPECT_EQ(textAt(d.where), directiveName(kind));
    EXPECT_EQ(findDirective(directiveName(kind)), kind);

    const Syntax& s = syntax(kind);
    const bool isTexture = s.arguments == Arguments::texture;
    std::vector<std::string> words;
    if (s.arguments == Arguments::name || s.arguments == Arguments::plugin) words = {"n"};
    if (s.arguments == Arguments::names) words = {"n", "o"};
    if (s.arguments == Arguments::time) words = {"EndTime"};
    if (isTexture) words = {"n", "o", "p"};
    EXPECT_EQ(d.words, words) << text;
    EXPECT_EQ(d.wordsWhere.size(), words.size());
    std::size_t params = isTexture || s.arguments == Arguments::plugin ? 2 : 0;
    if (s.arguments == Arguments::option) params = 1;
    EXPECT_EQ(d.params.size(), params) << text;
    for (std::size_t k = 0; k < 16; ++k)
      EXPECT_EQ(d.numbers.at(k), k < s.numbers ? static_cast<double>(k) + 0.5 : 0) << text;
  }
}

TEST(Directives, AllKindsInOneTextComeInOrder) {
  std::string text = "# all\n";
  for (int i = 0; i < kKinds; ++i)
    text += example(static_cast<DirectiveKind>(i)) + (i % 2 ? "\r\n" : " # c\n\n\t");
  const Parsed parsed(text);
  ASSERT_EQ(parsed.directives.size(), static_cast<std::size_t>(kKinds));
  for (int i = 0; i < kKinds; ++i)
    EXPECT_EQ(static_cast<int>(parsed.directives[static_cast<std::size_t>(i)].kind), i);
}

TEST(Directives, WhatIsOptionalMayBeLeftOut) {
  const Parsed parsed("MediumInterface \"fog\" Shape \"disk\" Texture \"a\" \"float\" \"b\"");
  ASSERT_EQ(parsed.directives.size(), 3U);
  EXPECT_EQ(parsed.directives[0].words, std::vector<std::string>{"fog"});
  EXPECT_TRUE(parsed.directives[1].params.empty());
  EXPECT_TRUE(parsed.directives[2].params.empty());
}

TEST(Directives, OptionsMayLeaveOutTheType) {
  const auto option = [](const std::string& text) {
    return Parsed("Option " + text).directives.at(0).params.at(0);
  };
  for (const char* text : {"\"seed\" 7", "\"integer seed\" 7", "\"integer seed\" [7]"}) {
    const Param p = option(text);
    EXPECT_EQ(p.name, "seed");
    EXPECT_EQ(p.type, ParamType::integer) << text;
    EXPECT_EQ(std::get<std::vector<int>>(p.values), std::vector<int>{7});
  }
  EXPECT_EQ(option("\"a\" true").type, ParamType::boolean);
  EXPECT_EQ(option("\"a\" [false]").type, ParamType::boolean);
  EXPECT_EQ(option("\"a\" 2.0").type, ParamType::integer);
  EXPECT_EQ(option("\"a\" 1.5").type, ParamType::number);
  EXPECT_EQ(option("\"a\" [1e30]").type, ParamType::number);
  EXPECT_EQ(option("\"rendercoordsys\" \"true\"").type, ParamType::string);
}

TEST(Directives, NumbersStandInBracketsOrBare) {
  const Parsed parsed(
      "Translate [1 -2 .5e1] LookAt 1 2 3 4 5 6 7 8 9\nScale [1 # one\n 2 3]\n"
      "Transform [1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16] Rotate +1 2. 3 1e-400");
  ASSERT_EQ(parsed.directives.size(), 5U);
  EXPECT_EQ(parsed.directives[0].numbers, (std::array<double, 16>{1, -2, 5}));
  EXPECT_EQ(parsed.directives[2].numbers, (std::array<double, 16>{1, 2, 3}));
  EXPECT_EQ(parsed.directives[3].numbers[15], 16);
  EXPECT_EQ(parsed.directives[4].numbers, (std::array<double, 16>{1, 2, 3, 0}));
}

TEST(Directives, NothingComesOfNothing) {
  for (const char* text : {"", " ", "\n", "\r\n\t", "# only a comment", "\xEF\xBB\xBF", "#\n#\n"})
    EXPECT_TRUE(Parsed(text).directives.empty());
}

TEST(Directives, ByteOrderMarkAndWindowsLinesAreRead) {
  const Parsed parsed("\xEF\xBB\xBFWorldBegin\r\nShape \"a\"\r\n\"float x\" [1\r\n2]\r\n# c\r\n");
  ASSERT_EQ(parsed.directives.size(), 2U);
  EXPECT_EQ(textAt(parsed.directives[0].where), "WorldBegin");
  EXPECT_EQ(std::get<0>(parsed.directives[1].params[0].values), (std::vector<float>{1, 2}));
}

Param paramOf(const std::string& text) {
  const Parsed parsed("Shape \"s\" " + text);
  Param param = parsed.directives.at(0).params.at(0);
  param.where = param.valueWhere = {};
  return param;
}
std::vector<float> floats(const std::string& text) {
  return std::get<std::vector<float>>(paramOf(text).values);
}
std::vector<int> ints(const std::string& text) {
  return std::get<std::vector<int>>(paramOf(text).values);
}
std::vector<std::string> strings(const std::string& text) {
  return std::get<std::vector<std::string>>(paramOf(text).values);
}

TEST(Parameters, EachTypeNameGivesItsType) {
  struct Case {
    std::string name;
    ParamType type;
    std::string value;
  };
  for (const auto& [name, type, value] :
       std::vector<Case>{{"bool", ParamType::boolean, "\"true\""},
                         {"integer", ParamType::integer, "7"},
                         {"float", ParamType::number, "7"},
                         {"point2", ParamType::point2, "[1 2]"},
                         {"vector2", ParamType::vector2, "[1 2 3 4]"},
                         {"point", ParamType::point3, "[1 2 3]"},
                         {"point3", ParamType::point3, "[1 2 3]"},
                         {"vector", ParamType::vector3, "[1 2 3 4 5 6]"},
                         {"vector3", ParamType::vector3, "[1 2 3]"},
                         {"normal", ParamType::normal, "[1 2 3]"},
                         {"color", ParamType::rgb, "[1 2 3]"},
                         {"rgb", ParamType::rgb, "[1 2 3]"},
                         {"xyz", ParamType::xyz, "[1 2 3]"},
                         {"blackbody", ParamType::blackbody, "[6500 1]"},
                         {"blackbody", ParamType::blackbody, "6500"},
                         {"spectrum", ParamType::spectrum, "[400 1 700 .5]"},
                         {"spectrum", ParamType::spectrum, "\"Al.spd\""},
                         {"string", ParamType::string, "\"v\""},
                         {"texture", ParamType::texture, "[\"v\"]"}}) {
    const Param param = paramOf("\"" + name + " x\" " + value);
    EXPECT_EQ(param.type, type) << name;
    EXPECT_EQ(param.name, "x");
  }
}

TEST(Parameters, EveryTypesOwnNameIsRead) {
  for (int i = 0; i <= static_cast<int>(ParamType::texture); ++i) {
    const auto type = static_cast<ParamType>(i);
    const bool isText = type == ParamType::string || type == ParamType::texture;
    const std::string value =
        isText ? "\"v\"" : (type == ParamType::boolean ? "true" : "[1 2 3 4 5 6]");
    EXPECT_EQ(paramOf(fmt::format("\"{} x\" {}", typeName(type), value)).type, type);
  }
}

TEST(Parameters, NumbersAreReadOnEitherPath) {
  const std::vector<float> expected{1, -2.5F, .5F, 3e10F, 0};
  EXPECT_EQ(floats("\"float x\" [1 -2.5 .5 3e10 0]"), expected);
  EXPECT_EQ(floats("\"float x\" [ +1 -2.5 .5\n# ] \" [\n3E+10 1e-99 ]"), expected);
  EXPECT_EQ(floats("\"float x\" -2"), std::vector<float>{-2});
  EXPECT_EQ(floats("\"float x\" []"), std::vector<float>{});
  EXPECT_EQ(floats("\"point P\" [ # none\n]"), std::vector<float>{});
  EXPECT_EQ(ints("\"integer x\" [1 -2 +3 2.0 1e3 2147483647 -2147483648]"),
            (std::vector<int>{1, -2, 3, 2, 1000, 2147483647, -2147483647 - 1}));
  EXPECT_EQ(ints("\"integer x\" 2."), std::vector<int>{2});
}

TEST(Parameters, BoolsAreQuotedOrBare) {
  EXPECT_EQ(ints("\"bool x\" \"true\""), std::vector<int>{1});
  EXPECT_EQ(ints("\"bool x\" [\"false\"]"), std::vector<int>{0});
  EXPECT_EQ(ints("\"bool x\" true"), std::vector<int>{1});
  EXPECT_EQ(ints("\"bool x\" [true false \"true\"]"), (std::vector<int>{1, 0, 1}));
}

TEST(Parameters, StringsMayHoldAnything) {
  EXPECT_EQ(strings("\"string x\" [\"a\" \"\" \"b c\"]"),
            (std::vector<std::string>{"a", "", "b c"}));
  EXPECT_EQ(strings(R"("string x" "q\" b\\ n\n t\t '\'")"),
            std::vector<std::string>{"q\" b\\ n\n t\t ''"});
  EXPECT_EQ(strings("\"string x\" \"# ] [ \xC3\xA4\xFF\""),
            std::vector<std::string>{"# ] [ \xC3\xA4\xFF"});
  EXPECT_EQ(strings("\"string x\" []"), std::vector<std::string>{});
  const std::string longName(65000, 'x');
  EXPECT_EQ(strings("\"string x\" \"" + longName + "\""), std::vector<std::string>{longName});
}

TEST(Parameters, DeclarationsMayHoldAnyWhiteSpace) {
  EXPECT_EQ(paramOf("\"  float \t\t fov \" 1").name, "fov");
  EXPECT_EQ(paramOf("\"float\tfov\"[1]").name, "fov");
}

TEST(Parameters, PlacesCoverTheDeclarationAndTheValue) {
  const Parsed parsed(
      "Shape \"s\" \"float x\" [ 1 2 ]\n\"string y\" [\"a\"  \"b\"] \"bool z\" true");
  const ParamList& params = parsed.directives.at(0).params;
  ASSERT_EQ(params.size(), 3U);
  EXPECT_EQ(textAt(params[0].where), "\"float x\"");
  EXPECT_EQ(textAt(params[0].valueWhere), "[ 1 2 ]");
  EXPECT_EQ(textAt(params[1].valueWhere), "[\"a\"  \"b\"]");
  EXPECT_EQ(textAt(params[2].valueWhere), "true");
  EXPECT_EQ(textAt(parsed.directives[0].wordsWhere.at(0)), "\"s\"");
}

// The scanner sees the text through a window of 16 kB: lists and strings of every length about
// that must come out whole, and what follows them in its place.
TEST(Parameters, ListsOfAnyLengthAreFollowedByTheRightPlaces) {
  for (int length = 1; length < 40000; length += 1 + length / 7) {
    std::string text = "Shape \"s\" \"integer x\" [";
    for (int i = 0; i < length; ++i) text += std::to_string(i) + " ";
    text += "] \"string y\" \"" + std::string(static_cast<std::size_t>(length), 'y') + "\" #" +
            std::string(static_cast<std::size_t>(length), '#') + "\nWorldEnd";
    const Parsed parsed(text);
    ASSERT_EQ(parsed.directives.size(), 2U);
    const auto& values = std::get<std::vector<int>>(parsed.directives[0].params.at(0).values);
    ASSERT_EQ(values.size(), static_cast<std::size_t>(length));
    for (int i = 0; i < length; ++i) ASSERT_EQ(values[static_cast<std::size_t>(i)], i);
    EXPECT_EQ(textAt(parsed.directives[0].params.at(1).where), "\"string y\"");
    EXPECT_EQ(textAt(parsed.directives[1].where), "WorldEnd");
  }
}

TEST(Parser, PassesOnWhatTheSinkThrows) {
  int count = 0;
  Parser parser([&](Directive&& d) {
    if (++count == 2) throw Error(d.where, "enough");
  });
  EXPECT_THROW(parser.text("t", "WorldBegin\nShape \"s\" \"float x\" [1 2]\nWorldEnd"), Error);
  EXPECT_EQ(count, 2);
  parser.text("t", "WorldEnd");  // and can go on
  EXPECT_EQ(count, 3);
}

TEST(Parser, NamesTheStatementThatMemoryIsTooSmallFor) {
  Parser parser([](Directive&& d) {
    if (d.kind == DirectiveKind::Shape) throw std::bad_alloc();
  });
  try {
    parser.text("t", "WorldBegin\n  Shape \"s\"\nWorldEnd");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "t:2:3: error: out of memory\n 2 |   Shape \"s\"\n   |   ^~~~~");
  }
}

TEST(Parser, HandsOverWhatCameBeforeAnError) {
  int count = 0;
  Parser parser([&](Directive&&) { ++count; });
  EXPECT_THROW(parser.text("t", "WorldBegin AttributeBegin Shpae"), Error);
  EXPECT_EQ(count, 2);
}

}  // namespace
}  // namespace pbrt
