// The spectra that have names, and the materials behind them.

#include "core/base/named_spectra.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/optical_constants.h"

namespace pbrt {
namespace {

TEST(NamedSpectra, AreThoseOfPbrt4) {
  const std::vector<std::string> names = spectrumNames();
  const auto isThere = [&](const std::string& name) {
    EXPECT_TRUE(namedSpectrum(name)) << name;
    EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
  };
  for (const std::string metal : {"Ag", "Al", "Au", "Cu", "CuZn", "MgO", "TiO2"})
    for (const std::string part : {"-eta", "-k"}) isThere("metal-" + metal + part);
  for (const std::string glass :
       {"BK7", "BAF10", "FK51A", "LASF9", "F5", "F10", "F11", "SF5", "SF10", "SF11"})
    isThere("glass-" + glass);
  for (const std::string lamp : {"A", "D50", "D65"}) isThere("stdillum-" + lamp);
  for (int i = 1; i <= 12; ++i) isThere("stdillum-F" + std::to_string(i));
  isThere("illum-acesD60");
  EXPECT_EQ(names.size(), 14U + 10 + 3 + 12 + 1);
  for (const std::string none : {"", "glass-", "metal-Au", "stdillum-F0", "stdillum-F13"})
    EXPECT_FALSE(namedSpectrum(none)) << none;
}

TEST(NamedSpectra, AreFiniteAndNotNegative) {
  for (const std::string& name : spectrumNames()) {
    const SampledSpectrum spectrum = *namedSpectrum(name);
    EXPECT_FALSE(spectrum.samples().empty()) << name;
    for (const auto& [nm, value] : spectrum.samples()) {
      EXPECT_TRUE(std::isfinite(value)) << name << ' ' << nm;
      EXPECT_GE(value, 0) << name << ' ' << nm;
    }
  }
}

// Schott's data sheets: the index at the d line of helium and the Abbe number
// V = (n_d - 1) / (n_F - n_C).
TEST(NamedSpectra, GlassesHaveTheIndicesOfTheirMaker) {
  struct Case {
    std::string name;
    double nd, vd;
  };
  for (const auto& [name, nd, vd] :
       {Case{"BK7", 1.51680, 64.17}, Case{"BAF10", 1.67003, 47.11}, Case{"FK51A", 1.48656, 84.47},
        Case{"LASF9", 1.85025, 32.17}, Case{"F5", 1.67271, 32.25}, Case{"SF10", 1.72828, 28.53},
        Case{"SF11", 1.78472, 25.68}}) {
    SCOPED_TRACE(name);
    const auto glass = std::ranges::find(kGlasses, name, &Glass::name);
    ASSERT_NE(glass, kGlasses.end());
    const double d = 587.5618, f = 486.1327, c = 656.2725;
    EXPECT_NEAR(glass->index(d), nd, 1.1e-5);
    EXPECT_NEAR((glass->index(d) - 1) / (glass->index(f) - glass->index(c)), vd, 0.01);
    EXPECT_NEAR(namedSpectrum("glass-" + name)->at(d), nd, 1.2e-5) << "sampled";
  }
}

// Stephens and Malitson 1952 measured 1.7373 for the D lines; DeVore 1951 has rutile's indices in
// table I.
TEST(NamedSpectra, CrystalsHaveTheirMeasuredIndices) {
  EXPECT_NEAR(magnesiaIndex(589.3), 1.7374, 1e-4);
  EXPECT_NEAR(magnesiaIndex(404.7), 1.7610, 2e-4);
  EXPECT_NEAR(rutileIndex(500), 3.03, 0.01);
  EXPECT_NEAR(rutileIndex(600), 2.90, 0.01);
  EXPECT_NEAR(rutileIndex(700), 2.83, 0.01);
}

TEST(NamedSpectra, TheConstantsOfMetalsAscendOverTheVisible) {
  for (const Metal& metal : kMetals) {
    SCOPED_TRACE(std::string(metal.name));
    EXPECT_TRUE(
        std::ranges::is_sorted(metal.constants, std::less_equal<>(), &OpticalConstants::nm));
    EXPECT_LE(metal.constants.front().nm, 360);
    EXPECT_GE(metal.constants.back().nm, 830);
  }
}

}  // namespace
}  // namespace pbrt
