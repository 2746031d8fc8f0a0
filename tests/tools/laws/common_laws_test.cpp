// The laws of every plug-in find those that say what is not true of their parameters.

#include <gmock/gmock.h>

#include "tests/laws.h"

namespace pbrt {
namespace {

using laws::Judge;

// A triangle that reads its parameters by `read`.
template <auto read>
class Triangle final : public MeshShape {
 public:
  explicit Triangle(Params& p) {
    read(p);
    mesh_.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh_.indices = {0, 1, 2};
  }
};

using Create = void* (*)(Params&, const void*);

Judge judged(Create create, std::string_view name, const ParamList& params,
             const char* summary = "of this test") {
  PluginInfo plugin{};
  plugin.kind = PluginKind::shape;
  plugin.name = "own";
  plugin.summary = summary;
  plugin.create = create;
  Judge judge;
  for (const laws::Law& law : laws::commonLaws())
    if (law.name == name) law.check({&plugin, params, {}}, judge);
  return judge;
}
template <auto read>
Judge judged(std::string_view name, const ParamList& params = {},
             const char* summary = "of this test") {
  return judged(createPlugin<Shape, Triangle<read>>, name, params, summary);
}

template <auto read>
std::string finding(std::string_view law, const ParamList& params = {}) {
  const Judge judge = judged<read>(law, params);
  return judge.failures() == 1 ? judge.findings()[0] : fmt::format("{} failures", judge.failures());
}

using testing::HasSubstr;

constexpr std::string_view kReads = "reads-what-it-declares";
constexpr std::string_view kDescribes = "describes-itself";
constexpr std::string_view kNames = "names-what-it-needs";

constexpr auto kGood = [](Params& p) {
  constexpr std::string_view kinds[] = {"flat", "round", "rough"};
  const std::string kind = p.choice("type", kinds, "flat", "what it looks like");
  if (kind == "round" || p.describing()) p.positive("width", 1, "of what is round");
  p.integer("n", 3, 1, 9, "how many");
  p.text("filename", "", "a file");
  p.points("P", "points");
  p.spectrum("colour", Spectrum(0.5F), "its colour");
  p.point("centre", Point3(1, 2, 3), "its centre");
  if (p.flag("fog", false, "whether there is fog") || p.describing())
    p.optionalNumber("density", "of the fog");
  p.floatTexture("depth", kInfinity, "how deep it is");
};

TEST(CommonLaws, LetTheGoodOnePass) {
  for (const laws::Law& law : laws::commonLaws()) {
    const Judge judge = judged<kGood>(law.name, {test::text("type", "round")});
    EXPECT_EQ(judge.failures(), 0U) << law.name << ": " << judge.findings()[0];
    EXPECT_GT(judge.trials(), 0U) << law.name;
  }
}

TEST(CommonLaws, FindWhatIsDeclaredButNotRead) {
  constexpr auto forgets = [](Params& p) {
    if (p.describing()) p.number("forgotten", 1, "nobody reads it");
  };
  EXPECT_THAT(finding<forgets>(kReads), HasSubstr("it declares \"forgotten\", but does not read"));
}

TEST(CommonLaws, FindDefaultsThatAreNone) {
  constexpr auto zero = [](Params& p) {
    if (p.describing())
      p.number("width", 0, "above 0");
    else
      p.positive("width", 1, "above 0");
  };
  EXPECT_THAT(finding<zero>(kReads), HasSubstr("said to be 0 by default"));
  EXPECT_THAT(finding<zero>(kReads), HasSubstr("must be above 0"));
}

TEST(CommonLaws, FindPoorDescriptions) {
  constexpr auto fails = [](Params& p) {
    if (p.points("P", "points").empty()) p.fail("P", "is missing");
  };
  constexpr auto twice = [](Params& p) { p.number("n", 1, "one"), p.number("n", 1, "again"); };
  constexpr auto mute = [](Params& p) { p.number("n", 1, ""); };
  constexpr auto blank = [](Params& p) { p.number("two words", 1, "two"); };
  EXPECT_THAT(finding<fails>(kDescribes), HasSubstr("ask Params::describing()"));
  EXPECT_THAT(finding<twice>(kDescribes), HasSubstr("declared twice"));
  EXPECT_THAT(finding<mute>(kDescribes), HasSubstr("has no meaning"));
  EXPECT_THAT(finding<blank>(kDescribes), HasSubstr("\"two words\""));
  EXPECT_EQ(judged<kGood>(kDescribes, {}, "").failures(), 1U);
}

TEST(CommonLaws, FindErrorsThatDoNotTellWhatIsNeeded) {
  constexpr auto needs = [](Params& p) {
    p.points("P", "points");
    p.require("P");
  };
  constexpr auto hides = [](Params& p) {
    if (p.points("P", "points").empty() && !p.describing()) throw Error("something is missing");
  };
  EXPECT_EQ(judged<needs>(kNames).failures(), 0U);
  EXPECT_THAT(finding<hides>(kNames), HasSubstr("something is missing"));
}

TEST(CommonLaws, ThrowIfItCannotBeMade) {
  EXPECT_THROW(judged<kGood>(laws::kMade, {test::number("n", 1.5F)}), Error);
  EXPECT_THROW(judged<kGood>(laws::kMade, {test::number("unknown", 1)}), Error);

  const Create nothing = [](Params&, const void*) -> void* { return nullptr; };
  EXPECT_THROW(judged(nothing, laws::kMade, {}), Error);
}

}  // namespace
}  // namespace pbrt
