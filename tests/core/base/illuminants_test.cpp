// Lamps: the chromaticities that the CIE publishes, and Planck's law.

#include "core/base/illuminants.h"

#include <gtest/gtest.h>

#include "core/base/colorimetry.h"

namespace pbrt {
namespace {

struct Xy {
  double x, y;
};

void expectChromaticity(const SampledSpectrum& s, const Xy& expected, double tolerance) {
  const DVec3 c = xyz(s);
  const double sum = c.x + c.y + c.z;
  EXPECT_NEAR(c.x / sum, expected.x, tolerance);
  EXPECT_NEAR(c.y / sum, expected.y, tolerance);
}

// CIE 15:2004, to five and to four decimals.
TEST(Illuminants, HaveTheChromaticitiesOfTheCie) {
  expectChromaticity(illuminantA(), {0.44757, 0.40745}, 3e-5);
  expectChromaticity(illuminantD50(), {0.34567, 0.35851}, 3e-5);
  expectChromaticity(illuminantD65(), {0.31272, 0.32903}, 3e-5);
  constexpr Xy kLamps[] = {{0.3131, 0.3371}, {0.3721, 0.3751}, {0.4091, 0.3941}, {0.4402, 0.4031},
                           {0.3138, 0.3452}, {0.3779, 0.3882}, {0.3129, 0.3292}, {0.3458, 0.3586},
                           {0.3741, 0.3727}, {0.3458, 0.3588}, {0.3805, 0.3769}, {0.4370, 0.4042}};
  for (int i = 0; i < 12; ++i) {
    SCOPED_TRACE(i + 1);
    expectChromaticity(fluorescent(i + 1), kLamps[i], 6e-5);
  }
  expectChromaticity(constantSpectrum(1), {1. / 3, 1. / 3}, 6e-5);
}

// ISO 11664-2.
TEST(Illuminants, HaveTheTabulatedValues) {
  const SampledSpectrum& d65 = illuminantD65();
  EXPECT_NEAR(d65.at(300), 0.0341, 1e-4);
  EXPECT_NEAR(d65.at(405), 87.1204, 1e-3);
  EXPECT_NEAR(d65.at(560), 100, 1e-9);
  EXPECT_NEAR(d65.at(700), 71.6091, 1e-3);
  EXPECT_NEAR(d65.at(830), 60.3125, 1e-3);
  const SampledSpectrum a = illuminantA();
  EXPECT_NEAR(100 * a.at(400) / a.at(560), 14.7080, 1e-3);
  EXPECT_NEAR(100 * a.at(700) / a.at(560), 198.261, 1e-3);
}

TEST(Illuminants, ABlackBodyFollowsPlancksLaw) {
  const auto planck = [](long double nm, long double kelvin) {
    constexpr long double h = 6.62607015e-34L, c = 299792458, k = 1.380649e-23L;
    const long double l = nm * 1e-9L;
    return 2 * h * c * c / std::pow(l, 5.L) / std::expm1(h * c / (l * k * kelvin));
  };
  for (const double kelvin : {800., 2856., 6504., 40000.}) {
    // Wien: b = 2.897771955e6 nm K.
    const long double peak = planck(2.897771955e6L / kelvin, kelvin);
    const SampledSpectrum s = blackbody(kelvin);
    for (const double nm : {360., 450., 555., 830.})
      EXPECT_NEAR(s.at(nm) / static_cast<double>(planck(nm, kelvin) / peak), 1, 1e-7) << kelvin;
  }
  expectChromaticity(blackbody(6504), {0.3135, 0.3236}, 1e-4);  // Planckian locus
}

TEST(Illuminants, ABlackBodyIsFiniteAtEveryTemperature) {
  for (const double kelvin : {-1., 0., 1e-40, 1., 1e12, 3e38}) {
    const SampledSpectrum s = blackbody(kelvin);
    for (const auto& [nm, value] : s.samples()) {
      EXPECT_GE(value, 0) << kelvin;
      EXPECT_LE(value, 1 + 1e-12) << kelvin;
    }
  }
}

}  // namespace
}  // namespace pbrt
