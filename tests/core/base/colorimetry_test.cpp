// Spectra to colours: laws, and colours that were published.

#include "core/base/colorimetry.h"

#include <gtest/gtest.h>

#include <complex>

#include "core/base/colorspace.h"
#include "core/base/illuminants.h"
#include "core/base/named_spectra.h"

namespace pbrt {
namespace {

using Samples = SampledSpectrum::Samples;

void expectNear(const Spectrum& a, const Spectrum& b, double tolerance) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << i;
}

// CIE 15:2004: the sums of the tables at 1 nm are 106.865, 106.857 and 106.892.
TEST(Colorimetry, TheColourMatchingFunctionsHaveTheirPublishedSums) {
  double sums[3] = {};
  for (const auto& row : kColourMatching)
    for (int i = 0; i < 3; ++i) sums[i] += 5 * row[i];
  EXPECT_NEAR(sums[0], 106.865, 2e-3);
  EXPECT_NEAR(sums[1], 106.857, 1e-3);
  EXPECT_NEAR(sums[2], 106.892, 2e-3);
}

TEST(Colorimetry, AConstantSpectrumIsAGreySurface) {
  for (const double c : {0., 0.18, 0.5, 1., 1.5, 12.25})
    EXPECT_EQ(surfaceColour(constantSpectrum(c)), Spectrum(static_cast<float>(c)));
}

TEST(Colorimetry, AConstantSpectrumIsLightOfThatLuminance) {
  EXPECT_NEAR(luminance(emittedColour(constantSpectrum(3))), 3, 1e-3);
  // Equal energy is pinkish under the white of D65: the columns' sums of the matrix.
  expectNear(emittedColour(constantSpectrum(1)), rec709FromXyz() * DVec3(1), 5e-4);
}

TEST(Colorimetry, DaylightIsWhite) {
  expectNear(colourOfLamp(illuminantD65()), Spectrum(1), 2e-4);
}

TEST(Colorimetry, LampsHaveLuminanceOne) {
  for (const std::string& name : spectrumNames())
    if (isIlluminant(name)) {
      EXPECT_NEAR(luminance(colourOfLamp(*namedSpectrum(name))), 1, 1e-6) << name;
    }
  // Below 1900 K, and in green laser light, a component of Rec. 709 would be negative.
  std::vector<SampledSpectrum> saturated = {SampledSpectrum(Samples{{531, 0}, {532, 1}, {533, 0}}),
                                            SampledSpectrum(Samples{{480, 0}, {485, 1}, {490, 0}})};
  for (const double kelvin : {100., 900., 1500., 1e6, 1e30}) saturated.push_back(blackbody(kelvin));
  for (const SampledSpectrum& s : saturated) {
    const Spectrum c = colourOfLamp(s);
    EXPECT_NEAR(luminance(c), 1, 1e-6);
    EXPECT_GE(std::min({c.x, c.y, c.z}), 0);
  }
  EXPECT_TRUE(isBlack(colourOfLamp(constantSpectrum(0))));
  EXPECT_TRUE(isBlack(emittedColour(constantSpectrum(-1))));
  EXPECT_TRUE(isBlack(emittedColour(SampledSpectrum(Samples{{450, 1}, {500, -2}}))));
}

// A line narrower than the tables' step, beside their wavelengths, keeps its power.
TEST(Colorimetry, NoLineIsMissed) {
  for (const double at : {532., 557.5, 588.9}) {
    const DVec3 line = xyz(SampledSpectrum(Samples{{at - 0.5, 0}, {at, 2}, {at + 0.5, 0}}));
    const auto i = static_cast<std::size_t>((at - 360) / 5);
    const double y = std::lerp(kColourMatching[i][1], kColourMatching[i + 1][1],
                               (at - 360) / 5 - static_cast<double>(i));
    EXPECT_NEAR(line.y * 106.857, y, 1e-3 * y) << at;
  }
}

TEST(Colorimetry, LightAddsUp) {
  const SampledSpectrum a(Samples{{400, 1}, {555, 2}, {700, 5}});
  const SampledSpectrum b(Samples{{423, 3}, {610, 1}});
  Samples both;
  for (const SampledSpectrum* s : {&a, &b})
    for (const auto& [nm, value] : s->samples()) both[nm] = a.at(nm) + b.at(nm);
  expectNear(emittedColour(SampledSpectrum(both)), emittedColour(a) + emittedColour(b), 2e-3);
}

TEST(Colorimetry, NoReflectanceIsAboveItsSpectrum) {
  for (double edge = 380; edge < 780; edge += 10)
    for (const bool isLong : {false, true}) {
      const double before = isLong ? 0 : 0.9, after = isLong ? 0.9 : 0;
      const Spectrum c =
          surfaceColour(SampledSpectrum(Samples{{edge - 1, before}, {edge + 1, after}}));
      EXPECT_GE(std::min({c.x, c.y, c.z}), 0) << edge;
      EXPECT_LE(std::max({c.x, c.y, c.z}), 0.9F) << edge;
    }
}

// Reflectances of metals, seen frontally, in linear Rec. 709 (Akenine-Moeller, Haines and Hoffman
// 2018, Real-Time Rendering, table 9.2); gold's red is 1.022 there, above what gold reflects of any
// light (0.98).
TEST(Colorimetry, MetalsReflectAsPublished) {
  struct Case {
    const char* metal;
    Spectrum reflectance;
  };
  for (const auto& [metal, expected] :
       {Case{"Ag", {0.972F, 0.960F, 0.915F}}, Case{"Al", {0.913F, 0.922F, 0.924F}},
        Case{"Au", {0.975F, 0.782F, 0.344F}}, Case{"Cu", {0.955F, 0.638F, 0.538F}}}) {
    SCOPED_TRACE(metal);
    const std::string name = std::string("metal-") + metal;
    const SampledSpectrum eta = *namedSpectrum(name + "-eta"), k = *namedSpectrum(name + "-k");
    const auto frontal = [](double n, double kappa) {
      const std::complex<double> index(n, kappa);
      return std::norm((index - 1.) / (index + 1.));
    };
    const auto reflectance = [&](double nm) { return frontal(eta.at(nm), k.at(nm)); };
    expectNear(surfaceColour(sampleVisible(reflectance)), expected, 4e-3);
    // Renderers of RGB take the indices as colours; that this is not exact is theirs.
    const Spectrum n = surfaceColour(eta), kappa = surfaceColour(k);
    Spectrum byColour;
    for (int i = 0; i < 3; ++i) byColour[i] = static_cast<float>(frontal(n[i], kappa[i]));
    expectNear(byColour, expected, 0.02);
  }
}

}  // namespace
}  // namespace pbrt
