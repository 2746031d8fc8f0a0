#pragma once
// A quantity that depends on the wavelength: a lamp's power, a reflectance, an index of refraction.

#include <map>

#include "core/base/cie_tables.h"

namespace pbrt {

// Linear between its samples; the first and the last value hold beyond them, as in pbrt-v2 and v3.
class SampledSpectrum {
 public:
  using Samples = std::map<double, double>;  // value by wavelength in nm

  // At least one sample.
  explicit SampledSpectrum(Samples samples) : samples_(std::move(samples)) {}

  double at(double nm) const;
  const Samples& samples() const { return samples_; }

 private:
  Samples samples_;
};

inline SampledSpectrum constantSpectrum(double value) {
  return SampledSpectrum(SampledSpectrum::Samples{{0, value}});
}

// A function of the wavelength in nm, sampled where the colour-matching functions are.
template <class Function>
SampledSpectrum sampleVisible(Function f) {
  SampledSpectrum::Samples samples;
  for (std::size_t i = 0; i < kColourMatching.size(); ++i) {
    const double nm = kVisibleBegin + kVisibleStep * static_cast<double>(i);
    samples.emplace(nm, f(nm));
  }
  return SampledSpectrum(std::move(samples));
}

}  // namespace pbrt
