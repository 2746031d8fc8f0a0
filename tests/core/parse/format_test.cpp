// What is printed is the same scene.

#include "core/parse/format.h"

#include <fmt/format.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/base/rng.h"
#include "tests/core/parse/parsing.h"

namespace pbrt {
namespace {

namespace fs = std::filesystem;

// A directive without its places; numbers as their bits, so that -0 is not 0.
struct Meaning {
  explicit Meaning(const Directive& d) : kind(d.kind), words(d.words), params(d.params) {
    for (std::size_t i = 0; i < bits.size(); ++i)
      bits[i] = std::bit_cast<std::uint64_t>(d.numbers[i]);
  }
  bool operator==(const Meaning& other) const {
    return kind == other.kind && words == other.words && bits == other.bits &&
           std::ranges::equal(params, other.params, same);
  }
  static bool same(const Param& a, const Param& b) {
    if (a.type != b.type || a.name != b.name || a.values.index() != b.values.index()) return false;
    const auto* floats = std::get_if<std::vector<float>>(&a.values);
    if (!floats) return a.values == b.values;
    return std::ranges::equal(*floats, std::get<std::vector<float>>(b.values), {},
                              std::bit_cast<std::uint32_t, float>,
                              std::bit_cast<std::uint32_t, float>);
  }

  DirectiveKind kind;
  std::vector<std::string> words;
  std::array<std::uint64_t, 16> bits{};
  ParamList params;
};

struct Printed {
  std::string text;
  std::vector<Meaning> scene;
};

template <class Read>
Printed print(Read read) {
  Printed out;
  Formatter formatter;
  Parser parser([&](Directive&& d) {
    out.text += formatter.print(d);
    out.scene.emplace_back(d);
  });
  read(parser);
  return out;
}
Printed printText(const std::string& text) {
  return print([&](Parser& parser) { parser.text("t", text); });
}

// Also that what is printed is printed as it is.
void expectSame(const Printed& first, const std::string& name) {
  const Printed second = printText(first.text);
  EXPECT_TRUE(first.scene == second.scene) << name;
  EXPECT_EQ(first.text, second.text) << name;
}

std::string printed(const std::string& text) {
  const Printed out = printText(text);
  expectSame(out, text);
  return out.text;
}

TEST(Format, OneStatementALine) {
  EXPECT_EQ(
      printed("LookAt 0 1 5e0  0 0 -0  0 1.50 0 Camera \"perspective\" \"float   fov\" [ 40 ]"),
      "LookAt 0 1 5 0 0 -0 0 1.5 0\nCamera \"perspective\" \"float fov\" 40\n");
  EXPECT_EQ(printed("ActiveTransform All Translate [1 2 3] MediumInterface \"\" \"a\""),
            "ActiveTransform All\nTranslate 1 2 3\nMediumInterface \"\" \"a\"\n");
  EXPECT_EQ(printed("Transform [1 0 0 0 0 1 0 0 0 0 1 0 .1 1e-9 1e300 1]"),
            "Transform [1 0 0 0 0 1 0 0 0 0 1 0 0.1 1e-09 1e+300 1]\n");
}

TEST(Format, TypesKeepTheirSpelling) {
  for (const char* type : {"point", "point3", "vector", "vector3", "color", "rgb", "normal3"}) {
    const std::string text = fmt::format("Shape \"s\" \"{} x\" [1 2 3]\n", type);
    EXPECT_EQ(printed(text), text);
  }
}

TEST(Format, ValuesOfEveryType) {
  for (const char* value :
       {"\"bool b\" \"true\"", "\"bool b\" false", "\"bool b\" [\"true\" \"false\"]",
        "\"bool b\" [true false]", "\"integer i\" -2147483648", "\"integer i\" []",
        "\"string s\" \"a\\\"\\\\\\n\\t\\r\\b\\f#]\"", "\"string s\" [\"\" \"\xC3\xA4\"]",
        "\"spectrum s\" \"Au\"", "\"spectrum s\" [400 1 700 0.5]", "\"blackbody L\" 6500",
        "\"blackbody L\" [6500 2]", "\"xyz c\" [1 2 3]", "\"point2 uv\" [0 1]",
        "\"vector2 w\" [-0 1e-45]", "\"texture t\" \"marble\"", "\"float x\" 3.4028235e+38"}) {
    const std::string text = fmt::format("Shape \"s\" {}\n", value);
    EXPECT_EQ(printed(text), text);
  }
}

TEST(Format, OptionsKeepOrLackTheirType) {
  for (const char* text : {"Option \"seed\" 7\n", "Option \"integer seed\" 7\n",
                           "Option \"disablepixeljitter\" true\n", "Option \"string a\" \"b\"\n"})
    EXPECT_EQ(printed(text), text);
  EXPECT_EQ(printed("Option \"a\" 2.0 Option \"b\" [1.50]"), "Option \"a\" 2\nOption \"b\" 1.5\n");
}

TEST(Format, BlocksAreIndented) {
  EXPECT_EQ(
      printed("WorldBegin AttributeBegin ObjectBegin \"o\" TransformBegin Identity "
              "TransformEnd ObjectEnd AttributeEnd AttributeEnd WorldEnd"),
      "WorldBegin\nAttributeBegin\n  ObjectBegin \"o\"\n    TransformBegin\n"
      "      Identity\n    TransformEnd\n  ObjectEnd\nAttributeEnd\nAttributeEnd\nWorldEnd\n");
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "AttributeBegin ";
  EXPECT_LT(printed(deep).size(), 10000000U);
}

TEST(Format, LongStatementsAreWrapped) {
  std::string list = "Shape \"mesh\" \"integer indices\" [0 1 2] \"point P\" [";
  for (int i = 0; i < 1000; ++i) list += fmt::format("{} ", 0.125 * i);
  list += "-1 -1]";
  const std::string text = printed("AttributeBegin " + list);
  EXPECT_TRUE(
      text.starts_with("AttributeBegin\n  Shape \"mesh\"\n      \"integer indices\" [0 1 2]\n"
                       "      \"point P\" [\n        0 0.125 0.25 "));
  EXPECT_TRUE(text.ends_with(" -1 -1\n      ]\n"));
  std::size_t longest = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    longest = std::max(longest, end - at);
    at = end + 1;
  }
  EXPECT_LE(longest, 100U);
  EXPECT_GT(longest, 90U);
}

TEST(Format, NumbersKeepEveryBit) {
  Rng rng(1);
  std::string floats, doubles;
  for (int i = 0; i < 100000; ++i) {
    const auto f = std::bit_cast<float>(rng.bits());
    if (std::isfinite(f)) floats += fmt::format("{:.9g} ", f);
  }
  for (int i = 0; i < 16; ++i)
    doubles +=
        fmt::format("{:.17g} ", std::ldexp(rng.uniform() - 0.3, static_cast<int>(i * 9) - 60));
  printed("Shape \"s\" \"float x\" [" + floats + "]\nTransform [" + doubles + "]");
}

TEST(Format, IncludesComeInTheirPlace) {
  const fs::path folder =
      fs::path(testing::TempDir()) / ("pbrt_format_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "b.pbrt") << "Shape \"b\"";
  const Printed out = print([&](Parser& parser) {
    parser.text("t", "AttributeBegin # gone\nInclude \"b.pbrt\" AttributeEnd", folder);
  });
  fs::remove_all(folder);
  EXPECT_EQ(out.text, "AttributeBegin\n  Shape \"b\"\nAttributeEnd\n");
}

// Ours, the fuzzer's, and other people's where they are at hand.
TEST(Format, EveryScene) {
  const fs::path root = PBRT_SOURCE_DIR;
  int scenes = 0;
  for (const fs::path& folder :
       {root / "scenes", root / "tests/fuzz/seeds", root / "../shared/scenes"}) {
    if (!fs::exists(folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (entry.path().extension() != ".pbrt" ||
          entry.path().parent_path().filename() == "geometry")
        continue;
      expectSame(print([&](Parser& parser) { parser.file(entry.path()); }), entry.path());
      ++scenes;
    }
  }
  EXPECT_GT(scenes, 10);
}

}  // namespace
}  // namespace pbrt
