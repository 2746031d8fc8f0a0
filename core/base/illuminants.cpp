#include "core/base/illuminants.h"

#include <cmath>

namespace pbrt {

namespace {

// The second radiation constant hc/k, in nm K (CODATA 2018).
constexpr double kC2 = 1.438776877e7;

// The standard illuminants are older than today's value of c2: 1.4380e7 when D65 was laid down,
// 1.4350e7 for A. The shape of Planck's law depends on c2 / T alone, so that the spectrum stays the
// same if the temperature rises with c2.
constexpr double kD = 1.4388 / 1.4380;
constexpr double kA = kC2 / 1.4350e7;

}  // namespace

// With x = c2 / (nm T), radiance per wavelength goes as x^5 / (e^x - 1) at a fixed T. Its
// derivative is zero where x = 5 (1 - e^-x): x = 4.965114 (Wien's displacement law).
SampledSpectrum blackbody(double kelvin) {
  constexpr double kPeak = 4.965114231744276;
  if (!(kelvin > 0)) return constantSpectrum(0);
  return sampleVisible([kelvin](double nm) {
    const double x = kC2 / (nm * kelvin);
    return std::pow(x / kPeak, 5) * (std::expm1(kPeak) / std::expm1(x));
  });
}

// The mean of many measured daylights and their two main variations (Judd, MacAdam and Wyszecki
// 1964), mixed so as to have the wanted chromaticity; to three decimals, as the CIE has it.
SampledSpectrum daylight(double kelvin) {
  const double t = 1000 / kelvin;
  const double x = ((-4.6070 * t + 2.9678) * t + 0.09911) * t + 0.244063;
  const double y = (-3 * x + 2.870) * x - 0.275;
  const double m = 0.0241 + 0.2562 * x - 0.7341 * y;
  const double m1 = std::round(1000 * (-1.3515 - 1.7703 * x + 5.9114 * y) / m) / 1000;
  const double m2 = std::round(1000 * (0.0300 - 31.4424 * x + 30.0717 * y) / m) / 1000;
  SampledSpectrum::Samples samples;
  double nm = 300;
  for (const auto& [s0, s1, s2] : kDaylight) {
    samples.emplace(nm, s0 + m1 * s1 + m2 * s2);
    nm += 10;
  }
  return SampledSpectrum(std::move(samples));
}

SampledSpectrum illuminantA() {
  return blackbody(2848 * kA);
}

SampledSpectrum illuminantD50() {
  return daylight(5000 * kD);
}

const SampledSpectrum& illuminantD65() {
  static const SampledSpectrum d65 = daylight(6500 * kD);
  return d65;
}

SampledSpectrum fluorescent(int number) {
  SampledSpectrum::Samples samples;
  double nm = 380;
  for (const std::uint16_t hundredths : kFluorescent.at(static_cast<std::size_t>(number - 1))) {
    samples.emplace(nm, hundredths / 100.);
    nm += 5;
  }
  return SampledSpectrum(std::move(samples));
}

}  // namespace pbrt
