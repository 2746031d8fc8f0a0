// `pbrt-plugin check` as the author of a plug-in runs it.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <map>

#include "tests/command.h"
#include "tests/support.h"

namespace pbrt::test {
namespace {

using testing::ContainsRegex;
using testing::EndsWith;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::Not;

const std::string kGood = PBRT_BUILD_DIR "/lib/pbrt/shapes/sphere.so";
const std::string kBad = PBRT_BUILD_DIR "/tests/bad_plugins/";
const std::string kFlawed = kBad + "shapes/flawed.so";

Outcome check(const std::string& arguments) {
  return Folder().command(PBRT_BUILD_DIR "/bin/pbrt-plugin check " + arguments);
}
std::string flaw(const std::string& name) {
  return kFlawed + " '\"string flaw\" \"" + name + "\"'";
}
// The lines of a text that begin with a word.
int lines(const std::string& text, const std::string& word) {
  std::istringstream in(text);
  int count = 0;
  for (std::string line; std::getline(in, line);) count += line.starts_with(word) ? 1 : 0;
  return count;
}

TEST(PluginCheck, AGoodOneObeysAllLaws) {
  const Outcome o = check(kGood + " '\"float radius\" 2 \"float phimax\" [200]'");
  EXPECT_EQ(o.code, 0) << o.out;
  EXPECT_EQ(o.err, "");
  EXPECT_THAT(o.out, HasSubstr("shape \"sphere\""));
  EXPECT_GT(lines(o.out, "ok "), 20);
  EXPECT_EQ(lines(o.out, "FAIL"), 0);
  const int ok = lines(o.out, "ok "), skipped = lines(o.out, "skipped ");
  EXPECT_THAT(o.out, EndsWith(fmt::format("\n{} laws: {} ok, 0 failed, {} skipped\n", ok + skipped,
                                          ok, skipped)));
  EXPECT_TRUE(std::ranges::all_of(o.out, [](char c) { return c == '\n' || c >= ' '; }));
}

// Those of this project are no better than those of strangers: what laws cannot know of them, they
// are told by a switch, which they name.
struct Meant {
  std::string parameters, finding, options;
};
const std::map<std::string, Meant> kMeant{
    {"filters/box", {"", "--has-steps", "--has-steps"}},
    {"samplers/random", {"", "--independent", "--independent"}},
    {"materials/shinymetal", {"", "--albedo NUMBER", "--albedo 2"}},
    {"materials/uber",
     {"'\"rgb Kd\" [1 1 1] \"rgb Ks\" [1 1 1]'", "--albedo NUMBER", "--albedo 2"}},
    {"shapes/curve",
     {"'\"point3 P\" [0 0 0 1 0 2 2 1 1 3 0.5 3] \"float width\" 0.3'", "--facing-width NUMBER",
      "--facing-width 0.3"}}};

class PluginOfTheBuild : public testing::TestWithParam<std::string> {};

TEST_P(PluginOfTheBuild, Obeys) {
  const auto found = kMeant.find(GetParam());
  const Meant meant = found == kMeant.end() ? Meant() : found->second;
  const std::string arguments =
      fmt::format("--quiet {}/lib/pbrt/{}.so {}", PBRT_BUILD_DIR, GetParam(), meant.parameters);
  if (found != kMeant.end()) {
    const Outcome strict = check(arguments);
    EXPECT_EQ(strict.code, 1);
    EXPECT_THAT(strict.out, HasSubstr("\n         if that is meant: " + meant.finding + "\n"));
  }
  const Outcome o = check(arguments + " " + meant.options);
  if (o.code == 3 &&
      testing::Matches(ContainsRegex("is missing|must name|is needed|values, not 0"))(o.err))
    GTEST_SKIP() << "it needs parameters: " << o.err;
  EXPECT_EQ(o.code, 0) << o.out << o.err;
}

std::vector<std::string> all() {
  std::vector<std::string> names;
  for (std::uint32_t i = 0; i < kPluginKinds; ++i)
    for (const std::string& name : loader().available(static_cast<PluginKind>(i)))
      names.push_back(fmt::format("{}/{}", kindFolder(static_cast<PluginKind>(i)), name));
  return names;
}

INSTANTIATE_TEST_SUITE_P(Every, PluginOfTheBuild, testing::ValuesIn(all()), [](const auto& test) {
  std::string name = test.param;
  std::ranges::replace_if(
      name, [](char c) { return c == '/' || c == '-'; }, '_');
  return name;
});

TEST(PluginCheck, ShowsTheRayThatBreaksALaw) {
  const Outcome o = check(flaw("off-the-surface"));
  EXPECT_EQ(o.code, 1);
  EXPECT_THAT(o.out, HasSubstr("FAIL     points-lie-on-the-surface"));
  EXPECT_THAT(o.out, MatchesRegex("(.|\n)*the point .* is 1e-06 off the surface along its normal "
                                  ".*, its error says 1e-15: the ray o \\((.|\n)*"));
  EXPECT_THAT(o.out, HasSubstr(" failed, "));
}

TEST(PluginCheck, FindsOneThatThreadsConfuse) {
  const Outcome o = check("--law thread-safe " + flaw("shared"));
  EXPECT_EQ(o.code, 1);
  EXPECT_THAT(o.out, HasSubstr("FAIL     thread-safe"));
  EXPECT_THAT(o.out, EndsWith("1 laws: 0 ok, 1 failed, 0 skipped\n"));
}

TEST(PluginCheck, FindsAWrongDensity) {
  const Outcome o = check("--quiet " + flaw("wrong-pdf"));
  EXPECT_EQ(o.code, 1);
  EXPECT_THAT(o.out, HasSubstr("samples-lie-on-the-surface"));
  EXPECT_THAT(o.out, HasSubstr("but pdf() of it is"));
  EXPECT_EQ(lines(o.out, "ok "), 0);
}

TEST(PluginCheck, FindsAParameterThatNobodyReads) {
  const Outcome o = check(kBad + "shapes/forgetful.so");
  EXPECT_EQ(o.code, 1);
  EXPECT_THAT(o.out, HasSubstr("it declares \"size\", but does not read it when it is made"));
  EXPECT_EQ(lines(o.out, "FAIL"), 1);
}

TEST(PluginCheck, OutlivesWhatAPluginDoes) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  constexpr bool sanitized = true;  // a sanitizer ends the process by itself
#else
  constexpr bool sanitized = false;
#endif
  struct Case {
    std::string flaw, says;
    std::string options;
  };
  std::vector<Case> cases{{"crashes", "- it crashed: Aborted"},
                          {"exits", "- it ended the process, with exit code 0"},
                          {"throws", "- it threw what is no std::exception"},
                          {"hangs", "- it did not end within 0.5 s", "--timeout 0.5 "}};
  if (!sanitized)
    cases.insert(cases.end(), {{"overflows", "- it crashed: Segmentation fault"},
                               {"eats-memory", "- it asked for more than 4 GiB of memory"}});
  for (const Case& c : cases) {
    const Outcome o = check(c.options + "--law is-made --law twins " + flaw(c.flaw));
    EXPECT_EQ(o.code, 1) << c.flaw;
    EXPECT_THAT(o.out, HasSubstr("FAIL     is-made"));
    EXPECT_THAT(o.out, HasSubstr(c.says));
    EXPECT_THAT(o.out, EndsWith("1 laws: 0 ok, 1 failed, 0 skipped, 1 not tried\n"));
  }
}

TEST(PluginCheck, TellsOneCauseOnce) {
  const Outcome crash = check(flaw("crashes-later")), thrown = check(flaw("throws-later"));
  for (const Outcome* o : {&crash, &thrown}) {
    EXPECT_EQ(o->code, 1);
    EXPECT_GT(lines(o->out, "FAIL"), 10);
    EXPECT_EQ(lines(o->out, "         - "), 1) << o->out;
    EXPECT_THAT(o->out, HasSubstr(" (as above)\n"));
    EXPECT_THAT(o->out, Not(HasSubstr("if that is meant")));
  }
  EXPECT_THAT(crash.out, HasSubstr("- it crashed: Aborted\n"));
  EXPECT_THAT(thrown.out, HasSubstr("- it threw an Error: no such ray\n"));

  const Outcome bounds = check(flaw("nowhere"));
  EXPECT_EQ(lines(bounds.out, "FAIL"), 1) << bounds.out;
  EXPECT_THAT(bounds.out, HasSubstr("FAIL     bounds-hold-every-hit"));
}

TEST(PluginCheck, WaitsOnlyOnceForWhatHangs) {
  const Outcome o =
      check("--timeout 0.5 --law bounds-hold-every-hit --law twins --law repeatable " +
            flaw("hangs-later"));
  EXPECT_EQ(o.code, 1);
  EXPECT_THAT(o.out, HasSubstr("- it did not end within 0.5 s"));
  EXPECT_THAT(o.out, EndsWith("1 laws: 0 ok, 1 failed, 0 skipped, 2 not tried\n"));
}

TEST(PluginCheck, ShowsWhatThePluginPrints) {
  const Outcome o = check("--law is-made " + flaw("prints"));
  EXPECT_EQ(o.code, 0);
  EXPECT_EQ(o.err, "a word of its own");
}

// A flat curve turns towards every ray: its normal does, and it is at no one place.
TEST(PluginCheck, IsToldWhatLawsCannotKnow) {
  const std::string curve = PBRT_BUILD_DIR
      "/lib/pbrt/shapes/curve.so '\"point3 P\" [0 0 0 1 0 2 2 1 1 3 0.5 3] "
      "\"float width\" 0.3' --quiet ";
  const Outcome strict = check(curve), told = check(curve + "--facing-width 0.3");
  EXPECT_EQ(strict.code, 1);
  EXPECT_THAT(strict.out, HasSubstr("FAIL     points-lie-on-the-surface"));
  EXPECT_THAT(strict.out, HasSubstr("FAIL     normals-do-not-turn-to-the-ray"));
  EXPECT_THAT(strict.out, HasSubstr("\n         if that is meant: --facing-width NUMBER\n"));
  EXPECT_EQ(told.code, 0) << told.out;
}

TEST(PluginCheck, LooksAtTheNameAndTheFolder) {
  const Folder folder;
  std::filesystem::create_directories(folder.path() / "lights");
  std::filesystem::copy(kGood, folder.path() / "lights/ball.so");
  const std::string so = (folder.path() / "lights/ball.so").string();
  const Outcome o = check("--law is-found " + so);
  EXPECT_EQ(o.code, 1);
  EXPECT_THAT(o.out, HasSubstr("it calls itself \"sphere\", so its file has to be sphere.so"));
  EXPECT_THAT(o.out, HasSubstr("it is a shape, but lies in the folder lights"));
}

TEST(PluginCheck, TakesAFileOfThisFolder) {
  const Folder folder;
  std::filesystem::copy(kGood, folder.path() / "sphere.so");
  const Outcome o = folder.command(PBRT_BUILD_DIR "/bin/pbrt-plugin check --quiet sphere.so");
  EXPECT_EQ(o.code, 0) << o.out << o.err;
}

TEST(PluginCheck, ListsLaws) {
  const Outcome o = check("--list " + kFlawed);
  EXPECT_EQ(o.code, 0);
  EXPECT_THAT(o.out, HasSubstr("\nhits-lie-on-the-ray "));
  EXPECT_EQ(lines(o.out, "ok "), 0);
}

TEST(PluginCheck, SaysWhatItCannotUse) {
  struct Case {
    std::string arguments;
    int code;
    std::string says;
  };
  const Case cases[] = {
      {"/nowhere.so", 5, "error: /nowhere.so: .*"},
      {PBRT_SOURCE_DIR "/README.md", 5, "error: .*/README.md: .*"},
      {kBad + "filters/other_abi.so", 5, "error: .*other_abi.so: it was built for plug-in ABI .*"},
      {kBad + "filters/no_entry.so", 5, "error: .*no_entry.so: .*"},
      {PBRT_BUILD_DIR "/lib/pbrt/shapes/trianglemesh.so", 3, "error: trianglemesh: \"P\" is .*"},
      {kGood + " '\"float radius\" -1'", 3, ".*\"radius\" must be above 0, not -1\n.*\\^~\n"},
      {kGood + " '\"float radiu\" 1'", 3, ".*did you mean \"radius\"\\?\n.*"},
      {kGood + " '\"float radius\" [1'", 3, ".*is not closed\n.*"},
      {kGood + " 'radius 1'", 3, "parameters:1:16: error: .*"},
      {kGood + " 'Shape \"cone\"'", 3, "parameters:1:16: error: there may be nothing here but .*"},
      {kGood + " --law thread-saf", 2, "error: there is no law \"thread-saf\".*\"thread-safe\".*"},
      {kGood + " --timeout 0", 2, ".*must be a number above 0.*"},
      {kGood + " --timeout -1", 2, ".*must be a number above 0.*"},
      {kGood + " --albedo nan", 2, ".*must be a number above 0.*"},
      {kGood + " '\"float radius\" 1' '\"float zmin\" 0'", 2, ".*not expected.*"},
      {"''", 2, "file: no name of a file\n.*"},
      {"/", 5, "error: /: .*"},
      {"", 2, ".*file is required.*"},
  };
  for (const Case& c : cases) {
    const Outcome o = check(c.arguments);
    EXPECT_EQ(o.code, c.code) << c.arguments;
    EXPECT_THAT(o.err, MatchesRegex(c.says)) << c.arguments;
    EXPECT_THAT(o.out, Not(HasSubstr("laws:"))) << c.arguments;
  }
}

TEST(PluginCheck, TakesAnyTime) {
  for (const std::string seconds : {"1e9", "1e300"}) {
    const Outcome o = check("--law is-made --timeout " + seconds + " " + kGood);
    EXPECT_EQ(o.code, 0) << o.out << o.err;
  }
}

TEST(PluginCommand, KnowsItsCommands) {
  const Outcome o = Folder().command(PBRT_BUILD_DIR "/bin/pbrt-plugin chek " + kGood);
  EXPECT_EQ(o.code, 2);
  EXPECT_EQ(o.err,
            "error: there is no command \"chek\" (it is one of new, check); did you mean "
            "\"check\"?\n");
  EXPECT_EQ(Folder().command(PBRT_BUILD_DIR "/bin/pbrt-plugin").code, 2);
  EXPECT_EQ(Folder().command(PBRT_BUILD_DIR "/bin/pbrt-plugin ''").code, 2);
  EXPECT_EQ(Folder().command(PBRT_BUILD_DIR "/bin/pbrt-plugin --version").code, 0);
}

}  // namespace
}  // namespace pbrt::test
