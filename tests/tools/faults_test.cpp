// Plug-ins that fail in the middle of a render: each fails in one column of the picture, of 8 by 8
// pixels with two samples each.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <map>

#include "core/base/image.h"
#include "tests/command.h"

namespace pbrt::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr int kSize = 8, kColumn = 5, kFaults = 2 * kSize;
const std::string kPlugins = PBRT_BUILD_DIR "/tests/bad_plugins";

// Where the parameters of one part may come in.
using Parts = std::map<std::string, std::string>;

// The column sees x = 0.375.
std::string fault(const std::string& kind, const std::string& more = "") {
  return "\"string fault\" \"" + kind + "\" \"float from\" 0.3 \"float to\" 0.4 " + more;
}

std::string scene(Parts parts) {
  const bool ownLight = parts.contains("integrators");
  return "LookAt 0 0 -3  0 0 0  0 1 0\nCamera \"faulty\" " + parts["cameras"] +
         fmt::format("\nFilm \"image\" \"integer xresolution\" {0} \"integer yresolution\" {0}\n",
                     kSize) +
         "PixelFilter " +
         (parts.contains("filters") ? "\"faulty\" " + parts["filters"] : "\"box\"") +
         "\nSampler \"faulty\" \"integer pixelsamples\" 2 " + parts["samplers"] +
         (ownLight ? "\nSurfaceIntegrator \"faulty\" " + parts["integrators"]
                   : "\nSurfaceIntegrator \"directlighting\"") +
         "\nVolumeIntegrator \"emission\"\nWorldBegin\nVolume \"faulty\" " + parts["volumes"] +
         "\nLightSource \"faulty\" " + parts["lights"] +
         "\nTexture \"grey\" \"color\" \"faulty\" " + parts["textures"] + "\nMaterial " +
         (parts.contains("materials") ? "\"faulty\" " + parts["materials"]
                                      : "\"matte\" \"texture Kd\" \"grey\"") +
         "\nShape \"faulty\" " + parts["shapes"] + "\nWorldEnd\n";
}

Outcome render(const Folder& folder, const Parts& parts, const std::string& options = "") {
  folder.write("scene.pbrt", scene(parts));
  return folder.pbrt("--plugin-path " + kPlugins + " --quiet --log-level warning " + options +
                     " --outfile out.exr scene.pbrt");
}

std::string label(const std::string& kind) {
  return kind + "/faulty (" + kPlugins + "/" + kind + "/faulty.so)";
}

// The column is black, and all else has the bits that it would have had.
void expectOneBlackColumn(const Folder& folder) {
  const Image image = readImage(folder.path() / "out.exr");
  const Folder other;
  ASSERT_EQ(render(other, {}).code, 0);
  const Image good = readImage(other.path() / "out.exr");
  for (const char* name : {"R", "G", "B", "A"})
    for (int i = 0; i < kSize * kSize; ++i) {
      const float seen = image.channel(name)->at(i);
      if (i % kSize != kColumn)
        EXPECT_EQ(seen, good.channel(name)->at(i)) << name << ' ' << i;
      else
        EXPECT_EQ(seen, *name == 'A' ? 1 : 0) << i;
    }
}

struct Case {
  std::string kind;
  std::string parameters;
  std::string says;
  std::string blamed = "";  // if not itself
};

class Faults : public testing::TestWithParam<Case> {};

const std::string kNotANumber = " gave what is not a number, or infinite";

TEST_P(Faults, AreCountedAndLocatedAndTheRestIsRendered) {
  const Case& c = GetParam();
  const Folder folder;
  folder.write("scene.pbrt", scene({{c.kind, c.parameters}}));
  const Outcome o = folder.pbrt("--plugin-path " + kPlugins + " --outfile out.exr scene.pbrt");
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(o.err, HasSubstr(fmt::format(
                         "warning: {} samples failed and count as black; first: pixel ({}, 0), "
                         "sample 0: {}{}",
                         kFaults, kColumn, c.blamed.empty() ? label(c.kind) : c.blamed, c.says)));
  if (c.kind != "integrators") expectOneBlackColumn(folder);
}

INSTANTIATE_TEST_SUITE_P(
    Thrown, Faults,
    testing::Values(
        Case{"shapes", fault("throws"), " threw: no such luck"},
        Case{"shapes", fault("throws-int", "\"string in\" \"occluded\""),
             " threw: what is no std::exception"},
        Case{"shapes", fault("throws", "\"string in\" \"surface\""), " threw: no such luck"},
        Case{"materials", fault("throws-error"), " threw: no such ray"},
        Case{"textures", fault("throws"), " threw: no such luck"},
        Case{"lights", fault("throws-int"), " threw: what is no std::exception"},
        Case{"cameras", fault("throws"), " threw: no such luck"},
        Case{"integrators", fault("throws"), " threw: no such luck"},
        Case{"integrators", fault("throws", "\"string in\" \"look\""), " threw: no such luck"}));

INSTANTIATE_TEST_SUITE_P(
    NotANumber, Faults,
    testing::Values(Case{"materials", fault("nan"), kNotANumber},
                    Case{"lights", fault("nan"), kNotANumber},
                    Case{"lights", fault("infinite"), kNotANumber},
                    Case{"cameras", fault("nan"), kNotANumber},
                    Case{"cameras", fault("infinite", "\"string in\" \"weight\""), kNotANumber},
                    Case{"integrators", fault("nan"), kNotANumber},
                    // A texture counts as a part of the material that asks it.
                    Case{"textures", fault("nan"), kNotANumber,
                         "materials/matte (" PBRT_BUILD_DIR "/lib/pbrt/materials/matte.so)"}));

TEST(FaultsOfSamples, HaveTheirPixelAndNumber) {
  const Folder folder;
  for (const std::string kind : {"nan", "throws"}) {
    const std::string where = "\"integer pixel\" [3 4] \"integer sample\" 1 \"string fault\" ";
    folder.write("scene.pbrt", scene({{"samplers", where + "\"" + kind + "\""}}));
    const Outcome o = folder.pbrt("--plugin-path " + kPlugins + " --outfile out.exr scene.pbrt");
    EXPECT_EQ(o.code, 0);
    EXPECT_THAT(o.err, HasSubstr("warning: 1 sample failed and counts as black; it is: pixel (3, "
                                 "4), sample 1: " +
                                 label("samplers")));
  }
}

TEST(FaultsOfMedia, AreFound) {
  const Folder folder;
  folder.write("scene.pbrt", scene({{"volumes", fault("nan")}}));
  const Outcome o = folder.pbrt("--plugin-path " + kPlugins + " --outfile out.exr scene.pbrt");
  EXPECT_EQ(o.code, 0);
  EXPECT_THAT(o.err, HasSubstr("pixel (5, 0), sample 0: " + label("volumes") + kNotANumber));
}

// What a shape gives shows in what is stored beside the picture.
TEST(FaultsOfSurfaces, AreFoundWhereTheyAreStored) {
  const Folder folder;
  folder.write("scene.pbrt", scene({{"shapes", fault("nan", "\"string in\" \"surface\"")}}));
  const Outcome o =
      folder.pbrt("--plugin-path " + kPlugins + " --aov normal --outfile out.exr scene.pbrt");
  EXPECT_EQ(o.code, 0);
  EXPECT_THAT(o.err, HasSubstr("pixel (5, 0), sample 0: " + label("shapes") + kNotANumber));
  const Image image = readImage(folder.path() / "out.exr");
  for (const float z : *image.channel("N.Z")) EXPECT_TRUE(std::isfinite(z));
}

// What every pixel needs is no matter of single samples.
TEST(FaultsOfFilters, EndTheRender) {
  const Folder folder;
  for (const auto& [kind, says] : {std::pair("nan", " gives the weight nan at (0.3"),
                                   {"infinite", " gives the weight inf at"},
                                   {"throws", " threw: no such luck"}}) {
    const Outcome o = render(folder, {{"filters", fault(kind)}});
    EXPECT_EQ(o.code, 5) << kind;
    EXPECT_THAT(o.err, HasSubstr("error: " + label("filters") + says));
  }
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out.exr"));
}

TEST(FaultsOfMaking, NameThePluginAndTheStatement) {
  const Folder folder;
  for (const std::string kind : {"shapes", "materials", "lights", "cameras", "volumes"})
    for (const std::string how : {"throws", "throws-int"}) {
      const Outcome o =
          render(folder, {{kind, "\"bool making\" \"true\" \"string fault\" \"" + how + "\""}});
      EXPECT_EQ(o.code, 5) << kind;
      EXPECT_THAT(o.err, AllOf(StartsWith("scene.pbrt:"), HasSubstr(": error: " + label(kind)),
                               HasSubstr(" threw: ")));
    }
  for (const auto& [kind, in] :
       {std::pair("shapes", "bounds"), std::pair("integrators", "prepare")}) {
    const Outcome o = render(
        folder, {{kind, "\"string fault\" \"throws\" \"string in\" \"" + std::string(in) + "\""}});
    EXPECT_EQ(o.code, 5);
    EXPECT_THAT(o.err, HasSubstr("error: " + label(kind) + " threw: no such luck"));
  }
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out.exr"));
}

TEST(Strict, EndsAtTheFirstFaultAndKeepsTheOldPicture) {
  const Folder folder;
  folder.write("out.exr", "an old picture");
  const Outcome o =
      render(folder, {{"materials", fault("nan")}}, "--strict --checkpoint part.film");
  EXPECT_EQ(o.code, 5);
  EXPECT_THAT(o.err, HasSubstr("error: 8 samples failed and count as black; first: pixel (5, 0), "
                               "sample 0: " +
                               label("materials") + kNotANumber));
  EXPECT_EQ(contents(folder.path() / "out.exr"), "an old picture");

  const std::string resume = "--checkpoint part.film --resume ";
  const Outcome again = render(folder, {{"materials", fault("nan")}}, "--strict " + resume);
  EXPECT_EQ(again.code, 3);
  EXPECT_THAT(again.err, HasSubstr("8 samples failed"));

  folder.write("scene.pbrt", scene({{"materials", fault("nan")}}));
  const Outcome rest =
      folder.pbrt("--plugin-path " + kPlugins + " " + resume + "--outfile out.exr scene.pbrt");
  EXPECT_EQ(rest.code, 0) << rest.err;
  EXPECT_THAT(rest.err, HasSubstr("16 samples failed and count as black; first: pixel (5, 0), "
                                  "sample 1: "));
  expectOneBlackColumn(folder);
}

TEST(Strict, DoesNothingToARenderWithoutFaults) {
  const Folder folder;
  EXPECT_EQ(render(folder, {}, "--strict").code, 0);
}

// With more memory the samples that failed are none, so they are saved nowhere.
TEST(OutOfMemory, EndsTheRenderAndKeepsTheLastCheckpoint) {
  const Folder folder;
  const Parts parts{{"samplers", "\"integer sample\" 1 \"string fault\" \"eats-memory\""}};
  const std::string film = "--checkpoint part.film ";
  const Outcome first = render(folder, {{"materials", fault("eats-memory")}}, film);
  EXPECT_EQ(first.code, 3);
  EXPECT_THAT(first.err, HasSubstr("error: out of memory: 8 samples failed"));
  EXPECT_EQ(folder.files(), 1U) << "the scene";
  ASSERT_EQ(render(folder, parts, "--samples 0..1 " + film).code, 0);
  const std::string before = contents(folder.path() / "part.film");
  const Outcome o = render(folder, parts, "--samples 0..2 --resume " + film);
  EXPECT_EQ(o.code, 3);
  EXPECT_THAT(o.err, HasSubstr("part.film is as it was last saved: go on with --resume"));
  EXPECT_EQ(contents(folder.path() / "part.film"), before);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

class Crashes : public testing::TestWithParam<std::pair<std::string, int>> {};

TEST_P(Crashes, NameThePixelAndThePlugin) {
  const auto& [how, signal] = GetParam();
  const Folder folder;
  for (const std::string kind : {"shapes", "materials", "textures", "lights", "cameras"}) {
    const Outcome o = render(folder, {{kind, fault(how)}});
    EXPECT_EQ(o.code, 128 + signal) << kind;
    EXPECT_THAT(o.err, HasSubstr("error: " + kind + "/faulty crashed at ")) << kind;
    EXPECT_THAT(o.err, HasSubstr(", sample 0 (" + kPlugins)) << kind;
    // Shapes see blocks of rays at once.
    const std::string place = kind == "shapes" ? " of the block from (4, 0)" : " at pixel (5, 0)";
    EXPECT_THAT(o.err, HasSubstr(place + ", sample 0 ("));
  }
  const Outcome made =
      render(folder, {{"lights", "\"bool making\" \"true\" \"string fault\" \"" + how + "\""}});
  EXPECT_EQ(made.code, 128 + signal);
  EXPECT_THAT(made.err,
              HasSubstr("lights/faulty crashed while it made what scene.pbrt:10 asks for"));
}

INSTANTIATE_TEST_SUITE_P(Signals, Crashes,
                         testing::Values(std::pair("null", SIGSEGV), std::pair("aborts", SIGABRT),
                                         std::pair("divides", SIGFPE),
                                         std::pair("overflows", SIGSEGV)));

TEST(CrashesLater, LeaveTheCheckpointWhole) {
  const Folder folder;
  const Parts parts{{"samplers",
                     "\"integer pixel\" [3 4] \"integer sample\" 3 "
                     "\"string fault\" \"null\""}};
  const std::string film = "--checkpoint part.film ";
  ASSERT_EQ(render(folder, parts, "--samples 0..2 " + film).code, 0);
  const std::string before = contents(folder.path() / "part.film");
  const Outcome crash = render(folder, parts, "--samples 0..5 --resume " + film);
  EXPECT_EQ(crash.code, 128 + SIGSEGV);
  EXPECT_THAT(crash.err, HasSubstr("error: samplers/faulty crashed at pixel (3, 4), sample 3 ("));
  EXPECT_THAT(crash.err,
              HasSubstr("\n  part.film holds the samples so far: go on with --resume\n"));
  EXPECT_EQ(contents(folder.path() / "part.film"), before);
  EXPECT_EQ(render(folder, parts, "--samples 0..3 --resume " + film).code, 0);
}

TEST(CrashesOfAFrame, AdviseNothingOfTheFrameBefore) {
  const Folder folder;
  folder.write("part1.pbrt", "");
  folder.write("part2.pbrt", "Material \"faulty\" " + fault("null"));
  folder.write("scene.pbrt", scene({{"materials", "Include \"part#.pbrt\""}}));
  const Outcome o = folder.pbrt("--plugin-path " + kPlugins +
                                " --frames 1-2 --checkpoint '#.film' --outfile '#.exr' scene.pbrt");
  EXPECT_EQ(o.code, 128 + SIGSEGV);
  EXPECT_THAT(o.err, AllOf(HasSubstr("materials/faulty crashed"), Not(HasSubstr("1.film"))));
}

#endif

}  // namespace
}  // namespace pbrt::test
