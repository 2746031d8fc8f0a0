// Every way in which a scene file gives a colour.

#include <fmt/format.h>
#include <unistd.h>

#include <fstream>

#include "core/base/colorimetry.h"
#include "core/base/illuminants.h"
#include "core/base/named_spectra.h"
#include "tests/support.h"

namespace pbrt {
namespace {

using test::number;
using test::rgb;
using test::value;

Param named(std::string parameter, std::string spectrum) {
  return {ParamType::spectrum,
          std::move(parameter),
          {},
          {},
          std::vector<std::string>{std::move(spectrum)}};
}
Param blackbodies(std::vector<float> v) {
  return value(ParamType::blackbody, "c", std::move(v));
}
Param samples(std::vector<float> v) {
  return value(ParamType::spectrum, "c", std::move(v));
}

Spectrum light(Param p) {
  const ParamList list = {std::move(p)};
  return Params("thing", {}, {&list}).emission("c", Spectrum(-1), "");
}
Spectrum surface(Param p) {
  const ParamList list = {std::move(p)};
  return Params("thing", {}, {&list}).spectrum("c", Spectrum(-1), "");
}
std::string problem(Param p) {
  try {
    light(std::move(p));
  } catch (const Error& error) {
    return error.diagnostics().at(0).message;
  }
  return "";
}

TEST(ParamsColour, SamplesAreOfASurfaceOrOfALight) {
  const SampledSpectrum s(SampledSpectrum::Samples{{450, 0.25}, {550, 0.5}, {650, 1}});
  const std::vector<float> flat = {450, 0.25F, 550, 0.5F, 650, 1};
  EXPECT_EQ(surface(samples(flat)), surfaceColour(s));
  EXPECT_EQ(light(samples(flat)), emittedColour(s));
  EXPECT_NE(surfaceColour(s), emittedColour(s));
  EXPECT_EQ(surface(samples({500, 0.25F})), Spectrum(0.25F));
}

TEST(ParamsColour, SamplesAreSortedWithAWarningButNotTwice) {
  const ParamList list = {samples({650, 1, 450, 0.25F, 550, 0.5F})};
  std::vector<Diagnostic> warnings;
  Params p("thing", {}, {&list}, nullptr, [&](const Diagnostic& d) { warnings.push_back(d); });
  EXPECT_EQ(p.spectrum("c", {}, ""), surface(samples({450, 0.25F, 550, 0.5F, 650, 1})));
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].message.find("do not ascend"), std::string::npos);
  EXPECT_EQ(problem(samples({450, 1, 450, 1})), "the spectrum has two values at 450 nm");
  EXPECT_NE(problem(samples({-1, 1})).find("above 0 nm"), std::string::npos);
  EXPECT_NE(problem(samples({})).find("needs pairs"), std::string::npos);
}

TEST(ParamsColour, NamesAreThoseOfTheCatalogue) {
  EXPECT_EQ(surface(named("c", "metal-Cu-k")), surfaceColour(*namedSpectrum("metal-Cu-k")));
  for (const char* lamp : {"stdillum-D65", "stdillum-A", "stdillum-F2", "illum-acesD60"}) {
    EXPECT_EQ(light(named("c", lamp)), colourOfLamp(*namedSpectrum(lamp))) << lamp;
    EXPECT_NEAR(luminance(light(named("c", lamp))), 1, 1e-6) << lamp;
  }
}

TEST(ParamsColour, AMissingFileOfPbrtsOwnMetalsIsThatMetal) {
  for (const char* file :
       {"spds/Cu.eta.spd", "../other/Cu.eta.spd", "Cu.eta.spd", "spds\\Cu.eta.spd"})
    EXPECT_EQ(surface(named("c", file)), surface(named("c", "metal-Cu-eta"))) << file;
  EXPECT_EQ(surface(named("c", "spds/Ag.k.spd")), surface(named("c", "metal-Ag-k")));
  for (const char* file : {"Cu.spd", ".eta.spd", "spds/Xx.k.spd", "Cu.eta.spd/x"})
    EXPECT_NE(problem(named("c", file)).find("neither a file"), std::string::npos) << file;
}

TEST(ParamsColour, AnUnknownNameIsExplained) {
  const std::string text = problem(named("c", "metal-au-eta"));
  EXPECT_NE(text.find("is \"metal-au-eta\", which is neither a file (metal-au-eta) nor one of the "
                      "named spectra; did you mean \"metal-Au-eta\"?"),
            std::string::npos)
      << text;
  EXPECT_EQ(problem(named("c", "zzzzzzzz")).find("did you mean"), std::string::npos);
}

TEST(ParamsColour, AFileIsReadAndItsErrorsAreItsOwn) {
  const auto path =
      std::filesystem::path(::testing::TempDir()) / fmt::format("params-colour-{}.spd", getpid());
  std::ofstream(path) << "450 .25\n550 .5\n650 1\n";
  EXPECT_EQ(light(named("c", path.string())), light(samples({450, 0.25F, 550, 0.5F, 650, 1})));
  std::ofstream(path) << "450 .25\n550 blue\n";
  try {
    light(named("c", path.string()));
    ADD_FAILURE() << "nothing was thrown";
  } catch (const Error& error) {
    ASSERT_EQ(error.diagnostics().size(), 2U);
    EXPECT_EQ(error.diagnostics()[0].file, path.string());
    EXPECT_EQ(error.diagnostics()[0].line, 2U);
    EXPECT_EQ(error.diagnostics()[0].column, 5U);
    EXPECT_EQ(error.diagnostics()[1].severity, Severity::note);
  }
  std::filesystem::remove(path);
}

TEST(ParamsColour, BlackBodiesHaveAScaleOrLuminanceOne) {
  const Spectrum peak = emittedColour(blackbody(3000));
  EXPECT_EQ(light(blackbodies({3000, 2})), 2.F * peak);
  EXPECT_EQ(light(blackbodies({3000, 2, 6000, 0.5F})),
            2.F * peak + 0.5F * emittedColour(blackbody(6000)));
  const Spectrum one = light(blackbodies({3000}));
  EXPECT_NEAR(luminance(one), 1, 1e-6);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(one[i] / one.x, peak[i] / peak.x, 1e-5);
  EXPECT_EQ(surface(blackbodies({3000, 2})), 2.F * peak) << "it shines, wherever it stands";

  EXPECT_NE(problem(blackbodies({0, 1})).find("above 0 K, not 0"), std::string::npos);
  EXPECT_NE(problem(blackbodies({-5})).find("above 0 K, not -5"), std::string::npos);
  EXPECT_NE(problem(blackbodies({1})).find("no visible light at 1 K"), std::string::npos);
  EXPECT_NE(problem(blackbodies({})).find("needs 1 colour, not 0"), std::string::npos);
}

TEST(ParamsColour, ListsHoldSeveral) {
  const Spectrum metal = surfaceColour(*namedSpectrum("metal-Au-eta"));
  const ParamList list = {rgb("rgb", 1, 2, 3),
                          {ParamType::spectrum,
                           "names",
                           {},
                           {},
                           std::vector<std::string>{"metal-Au-eta", "metal-Au-eta"}},
                          value(ParamType::blackbody, "hot", {3000, 1, 4000, 1}),
                          value(ParamType::spectrum, "one", {500, 0.5F}),
                          value(ParamType::rgb, "four", {1, 2, 3, 4})};
  Params p("thing", {}, {&list});
  EXPECT_EQ(p.spectra("rgb", ""), (std::vector<Spectrum>{{1, 2, 3}}));
  EXPECT_EQ(p.spectra("names", ""), (std::vector<Spectrum>{metal, metal}));
  EXPECT_EQ(p.spectra("hot", "").size(), 2U);
  EXPECT_EQ(p.spectra("one", ""), (std::vector<Spectrum>{Spectrum(0.5F)}));
  EXPECT_THROW(p.spectra("four", ""), Error);
  EXPECT_THROW(p.spectrum("names", {}, ""), Error) << "one is wanted";
}

TEST(ParamsColour, TexturesMayBeSpectraOrGreys) {
  const ParamList list = {samples({500, 0.25F}), number("grey", 2)};
  Params p("thing", {}, {&list});
  EXPECT_EQ(p.spectrumTexture("c", {}, "")({}), Spectrum(0.25F));
  EXPECT_EQ(p.texture<Spectrum>("c", 0, "")({}), Spectrum(0.25F));
  EXPECT_EQ(p.texture<Spectrum>("grey", 0, "")({}), Spectrum(2));
  EXPECT_THROW(p.spectrumTexture("grey", {}, ""), Error) << "a float is no colour";
  EXPECT_THROW(p.floatTexture("c", 0, ""), Error) << "nor a colour a float";
}

TEST(ParamsColour, OptionalOnesAreEmptyWithoutAValueOrADefault) {
  const ParamList list = {samples({500, 0.25F})}, defaults = {rgb("d", 1, 2, 3)};
  Params p("thing", {}, {&list}, nullptr, {}, &defaults);
  EXPECT_EQ(p.optionalSpectrum("c", ""), Spectrum(0.25F));
  EXPECT_EQ(p.optionalSpectrum("d", ""), Spectrum(1, 2, 3));
  EXPECT_FALSE(p.optionalSpectrum("e", ""));
  EXPECT_EQ((*p.optionalSpectrumTexture("c", ""))({}), Spectrum(0.25F));
  EXPECT_EQ((*p.optionalSpectrumTexture("d", ""))({}), Spectrum(1, 2, 3));
  EXPECT_FALSE(p.optionalSpectrumTexture("e", ""));
  p.refuseUnread();
}

TEST(ParamsColour, ARefractiveIndexIsANumberOrThatOfTheSodiumLine) {
  const ParamList list = {number("n", 1.33F),
                          named("glass", "glass-BK7"),
                          named("gas", "glass"),
                          value(ParamType::spectrum, "line", {589.2F, 1, 589.4F, 3}),
                          value(ParamType::spectrum, "zero", {500, 0}),
                          number("minus", -1),
                          rgb("rgb", 1, 1, 1)};
  Params p("thing", {}, {&list});
  EXPECT_EQ(p.refractiveIndex("n", 1.5F, ""), 1.33F);
  EXPECT_EQ(p.refractiveIndex("absent", 1.5F, ""), 1.5F);
  EXPECT_NEAR(p.refractiveIndex("glass", 1.5F, ""), 1.51673, 1e-5);  // Schott: n_D
  EXPECT_NEAR(p.refractiveIndex("line", 1.5F, ""), 2, 1e-3);
  for (const char* bad : {"gas", "zero", "minus", "rgb"})
    EXPECT_THROW(p.refractiveIndex(bad, 1.5F, ""), Error) << bad;
}

TEST(ParamsColour, DescribingTellsWhatMayStand) {
  std::vector<Declaration> found;
  Params p = Params::describing("thing", found);
  p.spectrum("a", Spectrum(0.5F), "");
  p.emission("b", {1, 2, 3}, "");
  p.spectrumTexture("c", Spectrum(0), "");
  p.optionalSpectrum("d", "");
  p.optionalSpectrumTexture("e", "");
  p.refractiveIndex("f", 1.5F, "");
  p.spectra("g", "");
  ASSERT_EQ(found.size(), 7U);
  const char* types[] = {"rgb or spectrum", "rgb or spectrum",          "rgb, spectrum or texture",
                         "rgb or spectrum", "rgb, spectrum or texture", "float or spectrum",
                         "rgb or spectrum"};
  const char* defaults[] = {"0.5 0.5 0.5", "1 2 3", "0 0 0", "-", "-", "1.5", "-"};
  for (int i = 0; i < 7; ++i) {
    EXPECT_EQ(found[i].type, types[i]) << i;
    EXPECT_EQ(found[i].defaultValue, defaults[i]) << i;
  }
}

}  // namespace
}  // namespace pbrt
