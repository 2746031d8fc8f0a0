#include "core/base/colorimetry.h"

#include <algorithm>
#include <array>
#include <vector>

#include "core/base/colorspace.h"
#include "core/base/illuminants.h"

namespace pbrt {

namespace {

DVec3 colourMatching(double nm) {
  const double at = (nm - kVisibleBegin) / kVisibleStep;
  const auto i = std::min(static_cast<std::size_t>(at), kColourMatching.size() - 2);
  const auto row = [](const std::array<double, 3>& v) { return DVec3(v[0], v[1], v[2]); };
  return glm::mix(row(kColourMatching[i]), row(kColourMatching[i + 1]),
                  at - static_cast<double>(i));
}

// The integral of a * b * (x, y, z) over the wavelengths of the colour-matching functions, by the
// trapezoidal rule: at every 5 nm it is the sum of products by which the CIE and ASTM E308 define
// the colours of their tables. The samples of `a` in between count as well, so that no line is
// missed; `b` has samples at multiples of 5 nm alone.
DVec3 integrate(const SampledSpectrum& a, const SampledSpectrum& b) {
  std::vector<double> nodes;
  for (std::size_t i = 0; i < kColourMatching.size(); ++i)
    nodes.push_back(kVisibleBegin + kVisibleStep * static_cast<double>(i));
  const double end = nodes.back();
  for (auto s = a.samples().upper_bound(kVisibleBegin); s != a.samples().end() && s->first < end;
       ++s)
    nodes.push_back(s->first);
  std::sort(nodes.begin(), nodes.end());

  const auto f = [&](double nm) { return a.at(nm) * b.at(nm) * colourMatching(nm); };
  DVec3 sum(0);
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    const double lo = nodes[i - 1];
    const double hi = nodes[i];
    sum += (hi - lo) / 2 * (f(lo) + f(hi));
  }
  return sum;
}

Spectrum shown(const DVec3& xyzOfLight) {
  const Spectrum rgb = glm::max(rec709FromXyz() * xyzOfLight, 0.);
  const float y = luminance(rgb);
  return y > 0 && xyzOfLight.y > 0 ? rgb * (static_cast<float>(xyzOfLight.y) / y) : Spectrum(0);
}

}  // namespace

DVec3 xyz(const SampledSpectrum& spectrum) {
  static const SampledSpectrum one = constantSpectrum(1);
  static const double wholeY = integrate(one, one).y;
  return integrate(spectrum, one) / wholeY;
}

Spectrum emittedColour(const SampledSpectrum& spectrum) {
  return shown(xyz(spectrum));
}

Spectrum colourOfLamp(const SampledSpectrum& spectrum) {
  const DVec3 light = xyz(spectrum);
  return light.y > 0 ? shown(light / light.y) : Spectrum(0);
}

Spectrum surfaceColour(const SampledSpectrum& spectrum) {
  const auto seen = [](const SampledSpectrum& s) {
    return rec709FromXyz() * integrate(s, illuminantD65());
  };
  static const DVec3 white = seen(constantSpectrum(1));
  const auto greatest =
      std::max_element(spectrum.samples().begin(), spectrum.samples().end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  return glm::max(glm::min(seen(spectrum) / white, greatest->second), 0.);
}

}  // namespace pbrt
