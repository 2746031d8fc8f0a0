#pragma once
// The spectra of lamps. All are relative: only their shape has a meaning.

#include "core/base/sampled_spectrum.h"

namespace pbrt {

// A black body (Planck's law) over its peak, which may lie outside of the visible. 0 K or less is
// black.
SampledSpectrum blackbody(double kelvin);

// A phase of daylight of correlated colour temperature 4000 to 7000 K (CIE 15:2004, section 3.1).
SampledSpectrum daylight(double kelvin);

// The standard illuminants A, D50 and D65.
SampledSpectrum illuminantA();
SampledSpectrum illuminantD50();
const SampledSpectrum& illuminantD65();

// The fluorescent lamps F1 to F12.
SampledSpectrum fluorescent(int number);

}  // namespace pbrt
