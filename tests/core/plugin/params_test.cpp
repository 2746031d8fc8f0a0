// Reading parameters: defaults, values, and the error for everything that is wrong.

#include "core/plugin/params.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "core/plugin/plugin.h"
#include "tests/support.h"

namespace pbrt {
namespace {

using test::flag;
using test::integers;
using test::number;
using test::rgb;
using test::text;
using test::value;

const Source kSource{"scene", "statement declaration value"};
const Location kStatement{&kSource, 0, 9}, kDeclaration{&kSource, 10, 11}, kValue{&kSource, 22, 5};

Param placed(Param p) {
  p.where = kDeclaration;
  p.valueWhere = kValue;
  return p;
}

Params reader(const ParamList& list) {
  return {"shapes/thing", kStatement, {&list}};
}

// The diagnostic with which `read` fails.
template <class Read>
Diagnostic failure(Read read) {
  try {
    read();
  } catch (const Error& error) {
    return error.diagnostics().at(0);
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

TEST(Params, AbsentGivesTheDefault) {
  const ParamList none;
  Params p = reader(none);
  EXPECT_EQ(p.number("a", 1.5F, ""), 1.5F);
  EXPECT_EQ(p.positive("a", 2, ""), 2);
  EXPECT_EQ(p.nonNegative("a", 0, ""), 0);
  EXPECT_EQ(p.inRange("a", 3, 0, 4, ""), 3);
  EXPECT_FALSE(p.optionalNumber("a", ""));
  EXPECT_EQ(p.integer("a", 7, 0, 9, ""), 7);
  EXPECT_TRUE(p.flag("a", true, ""));
  EXPECT_EQ(p.text("a", "t", ""), "t");
  constexpr std::string_view kChoices[] = {"x", "y"};
  EXPECT_EQ(p.choice("a", kChoices, "y", ""), "y");
  EXPECT_EQ(p.point("a", {1, 2, 3}, ""), Point3(1, 2, 3));
  EXPECT_EQ(p.vector("a", {1, 2, 3}, ""), Vec3(1, 2, 3));
  EXPECT_EQ(p.spectrum("a", {1, 2, 3}, ""), Spectrum(1, 2, 3));
  EXPECT_EQ(p.floatTexture("a", 4, "")({}), 4);
  EXPECT_EQ(p.spectrumTexture("a", Spectrum(5), "")({}), Spectrum(5));
  EXPECT_FALSE(p.optionalFloatTexture("a", ""));
  EXPECT_TRUE(p.numbers("a", "").empty() && p.integers("a", "").empty() &&
              p.points2("a", "").empty() && p.points("a", "").empty() &&
              p.vectors("a", "").empty() && p.normals("a", "").empty() &&
              p.spectra("a", "").empty());
  EXPECT_FALSE(p.has("a"));
}

TEST(Params, GivenGivesTheValue) {
  const ParamList list = {number("n", 2),
                          integers("i", {3}),
                          flag("f", true),
                          text("t", "y"),
                          rgb("c", 0.1F, 0.2F, 1),
                          value(ParamType::point3, "p", {1, 2, 3}),
                          value(ParamType::number, "l", {1, 2, 3, 4})};
  Params p = reader(list);
  EXPECT_EQ(p.number("n", 0, ""), 2);
  EXPECT_EQ(p.number("i", 0, ""), 3) << "an integer is a number";
  EXPECT_EQ(p.optionalNumber("n", ""), 2);
  EXPECT_EQ(p.integer("i", 0, 0, 9, ""), 3);
  EXPECT_TRUE(p.flag("f", false, ""));
  EXPECT_EQ(p.text("t", "", ""), "y");
  constexpr std::string_view kChoices[] = {"x", "y"};
  EXPECT_EQ(p.choice("t", kChoices, "x", ""), "y");
  EXPECT_EQ(p.spectrum("c", Spectrum(0), ""), Spectrum(0.1F, 0.2F, 1));
  EXPECT_EQ(p.spectrumTexture("c", Spectrum(0), "")({}), Spectrum(0.1F, 0.2F, 1));
  EXPECT_EQ(p.floatTexture("n", 0, "")({}), 2);
  EXPECT_EQ(p.texture<Spectrum>("n", 0, "")({}), Spectrum(2)) << "grey stands for a colour";
  EXPECT_EQ(p.point("p", {}, ""), Point3(1, 2, 3));
  EXPECT_EQ(p.numbers("l", "").size(), 4U);
  EXPECT_EQ(p.points2("l", ""), (std::vector<Point2>{{1, 2}, {3, 4}}));
  p.refuseUnread();
}

TEST(Params, WrongTypesCountsAndRangesNameThePlace) {
  const ParamList list = {placed(text("s", "word")),
                          placed(value(ParamType::number, "two", {1, 2})),
                          placed(number("minus", -1)), placed(integers("many", {50})),
                          placed(value(ParamType::number, "none", {}))};
  Params p = reader(list);
  const auto expect = [](const Diagnostic& d, std::size_t column, const std::string& message) {
    EXPECT_EQ(d.column, column) << d.message;
    EXPECT_NE(d.message.find(message), std::string::npos) << d.message;
    EXPECT_TRUE(d.message.starts_with("shapes/thing: ")) << d.message;
  };
  expect(failure([&] { p.number("s", 0, ""); }), 23, "has type \"string\" but must be \"float\"");
  expect(failure([&] { p.spectrum("minus", {}, ""); }), 23, "must be \"rgb\" or \"spectrum\"");
  expect(failure([&] { p.integer("minus", 0, 0, 9, ""); }), 23, "must be \"integer\"");
  expect(failure([&] { p.points("s", ""); }), 23, "must be \"point3\"");
  expect(failure([&] { p.number("two", 0, ""); }), 23, "needs 1 number, not 2");
  expect(failure([&] { p.number("none", 0, ""); }), 11, "needs 1 number, not 0");
  expect(failure([&] { p.numbers("two", ""), p.integers("two", ""); }), 23, "\"integer\"");
  expect(failure([&] { p.positive("minus", 1, ""); }), 23, "must be above 0, not -1");
  expect(failure([&] { p.nonNegative("minus", 1, ""); }), 23, "must not be below 0, but is -1");
  expect(failure([&] { p.inRange("minus", 1, 0, 2, ""); }), 23, "must be from 0 to 2, not -1");
  expect(failure([&] { p.integer("many", 1, 0, 9, ""); }), 23, "must be from 0 to 9, not 50");
  constexpr std::string_view kChoices[] = {"world", "wood"};
  expect(failure([&] { p.choice("s", kChoices, "wood", ""); }), 23,
         "it is one of world, wood); did you mean");
  expect(failure([&] { p.require("absent"); }), 1, "\"absent\" is missing");
}

TEST(Params, XyzIsConvertedWhereverAColourMayStand) {
  // The white point of Rec. 709 is grey there.
  const std::vector<float> white = {0.95047F, 1, 1.08883F};
  std::vector<float> twice = white;
  twice.insert(twice.end(), white.begin(), white.end());
  const ParamList list = {value(ParamType::xyz, "one", white), value(ParamType::xyz, "two", twice)};
  Params p = reader(list);
  std::vector<Spectrum> colours = p.spectra("two", "");
  colours.push_back(p.spectrum("one", {}, ""));
  colours.push_back(p.spectrumTexture("one", {}, "")({}));
  ASSERT_EQ(colours.size(), 4U);
  for (const Spectrum& c : colours)
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(c[i], 1, 1e-4);
}

TEST(Params, ATextureWhereThereIsNoLibraryIsAnError) {
  const ParamList list = {
      placed({ParamType::texture, "t", {}, {}, std::vector<std::string>{"wood"}})};
  Params p = reader(list);
  EXPECT_EQ(failure([&] { p.floatTexture("t", 0, ""); }).column, 23U);
  EXPECT_EQ(failure([&] { p.spectrumTexture("t", {}, ""); }).column, 23U);
  EXPECT_EQ(failure([&] { p.number("t", 0, ""); }).column, 23U);
}

TEST(Params, TheFirstListWinsThenTheDefaults) {
  const ParamList shape = {number("a", 1)}, material = {number("a", 2), number("b", 3)},
                  defaults = {number("a", 7), number("b", 8), number("c", 9)};
  Params p("thing", kStatement, {&shape, &material}, nullptr, {}, &defaults);
  EXPECT_EQ(p.number("a", 0, ""), 1);
  EXPECT_EQ(p.number("b", 0, ""), 3);
  EXPECT_EQ(p.number("c", 0, ""), 9);
  EXPECT_EQ(p.number("d", 5, ""), 5);
  EXPECT_TRUE(p.unread(0).empty());
  EXPECT_TRUE(p.unread(1).empty()) << "a hidden parameter counts as read";
  EXPECT_FALSE(p.has("c")) << "a default was not given";
}

TEST(Params, TheLastOfTheSameNameInAListCounts) {
  const ParamList list = {number("a", 1), number("a", 2)};
  Params p = reader(list);
  EXPECT_EQ(p.number("a", 0, ""), 2);
  p.refuseUnread();
}

TEST(Params, AWarningIsPlacedAtTheValueThatCounts) {
  ParamList first = {placed(number("a", 1))}, second = {number("a", 2)};
  second[0].valueWhere = kStatement;
  std::vector<Diagnostic> got;
  const Params p("thing", kStatement, {&first, &second}, nullptr,
                 [&](const Diagnostic& d) { got.push_back(d); });
  p.warn("a", "is odd");
  ASSERT_EQ(got.size(), 1U);
  EXPECT_EQ(got[0].column, 23U);
  EXPECT_EQ(got[0].severity, Severity::warning);
}

TEST(Params, AllUnreadNamesAreReportedAtOnce) {
  const ParamList list = {placed(number("raduis", 1)), number("radius", 1), number("zzz", 1)};
  Params p = reader(list);
  p.number("radius", 0, "");
  ASSERT_EQ(p.unread().size(), 2U);
  try {
    p.refuseUnread();
    FAIL();
  } catch (const Error& error) {
    ASSERT_EQ(error.diagnostics().size(), 2U);
    EXPECT_EQ(error.diagnostics()[0].column, 11U);
    EXPECT_NE(error.diagnostics()[0].message.find("did you mean \"radius\"?"), std::string::npos);
    EXPECT_EQ(error.diagnostics()[1].message.find("did you mean"), std::string::npos);
  }
}

TEST(Params, ListsNeedWholeValues) {
  const ParamList list = {placed(value(ParamType::number, "uv", {1, 2, 3}))};
  Params p = reader(list);
  EXPECT_NE(failure([&] { p.points2("uv", ""); }).message.find("not a multiple of 2"),
            std::string::npos);
}

TEST(Params, FilesAreFoundFromTheScenesFolder) {
  const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) / fmt::format("params-{}", getpid());
  std::filesystem::create_directories(folder / "sub");
  std::ofstream(folder / "sub" / "a.ply") << "ply";
  const Source scene{(folder / "scene.pbrt").string(), "\"sub/a.ply\" \"sub/b.ply\""};
  const auto named = [&](const std::string& path, std::size_t begin) {
    Param p = text("filename", path);
    p.where = p.valueWhere = {&scene, begin, 11};
    return ParamList{p};
  };
  const auto read = [](const ParamList& list) { return reader(list).file("filename", ""); };

  EXPECT_EQ(read(named("sub/a.ply", 0)), folder / "sub" / "a.ply");
  const std::string whole = (folder / "sub" / "a.ply").string();
  EXPECT_EQ(read(named(whole, 0)), whole);
  EXPECT_TRUE(read({}).empty());

  const ParamList missing = named("sub/b.ply", 12);
  const Diagnostic d = failure([&] { read(missing); });
  EXPECT_EQ(d.column, 13U);
  EXPECT_NE(d.message.find((folder / "sub" / "b.ply").string()), std::string::npos);

  // A scene that is no file.
  const ParamList piped = {placed(text("filename", "sub/a.ply"))};
  EXPECT_NE(failure([&] { read(piped); }).message.find(": sub/a.ply"), std::string::npos);

  // As exporters on Windows write it.
  EXPECT_EQ(read(named("sub\\a.ply", 0)), folder / "sub/a.ply");

  // Another folder, after that of the scene: that of the first scene file, say.
  std::filesystem::create_directories(folder / "main" / "sub");
  const auto readAlso = [&](const std::string& file) {
    const ParamList list = named(file, 0);
    Params p = reader(list);
    p.alsoSearch(folder / "main");
    return p.file("filename", "");
  };
  std::ofstream(folder / "main" / "sub" / "a.ply") << "another";
  std::ofstream(folder / "main" / "sub" / "c.ply") << "ply";
  EXPECT_EQ(readAlso("sub/a.ply"), folder / "sub/a.ply");
  EXPECT_EQ(readAlso("sub/c.ply"), folder / "main/sub/c.ply");
  const std::string tried =
      fmt::format("not there: {0}/sub/d, {0}/main/sub/d, sub/d", folder.string());
  EXPECT_TRUE(failure([&] { readAlso("sub/d"); }).message.ends_with(tried));

  // What is there but cannot be read as a file.
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  for (const char* other : {"sub", "pipe", "/dev/null"})
    EXPECT_NE(failure([&] { read(named(other, 0)); }).message.find("which is not a file"),
              std::string::npos)
        << other;
  std::filesystem::remove_all(folder);
}

TEST(Params, DescribingRecordsEveryDeclaration) {
  std::vector<Declaration> found;
  Params p = Params::describing("thing", found);
  EXPECT_TRUE(p.describing());
  EXPECT_EQ(p.positive("radius", 1.5F, "how far", "m"), 1.5F);
  p.points("P", "corners");
  p.require("P");
  p.texture<Spectrum>("Kd", 0.5F, "");
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].name, "radius");
  EXPECT_EQ(found[0].type, "float");
  EXPECT_EQ(found[0].defaultValue, "1.5");
  EXPECT_EQ(found[0].meaning, "how far");
  EXPECT_EQ(found[0].unit, "m");
  EXPECT_EQ(found[1].defaultValue, "-");
  EXPECT_EQ(found[2].type, "rgb, spectrum or texture");
}

}  // namespace
}  // namespace pbrt
