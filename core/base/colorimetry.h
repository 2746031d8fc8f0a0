#pragma once
// How a spectrum becomes a colour.

#include "core/base/sampled_spectrum.h"
#include "core/base/spectrum.h"

namespace pbrt {

// CIE XYZ (1931, 2 degrees) over the integral of y: a spectrum that is 1 everywhere has Y = 1.
DVec3 xyz(const SampledSpectrum& spectrum);

// Light: the colour that the observer sees. The luminance is Y; components that are negative
// because Rec. 709 cannot show the colour become 0, and the rest makes up for them. Y <= 0 is
// black.
Spectrum emittedColour(const SampledSpectrum& spectrum);
// The same at luminance 1, for a spectrum without a scale of its own. Black stays black.
Spectrum colourOfLamp(const SampledSpectrum& spectrum);

// A reflectance, an index of refraction, an absorption: what white light (D65) shows of it,
//   c = (integral of spectrum * D65 * rgb) / (integral of D65 * rgb),
// so that a spectrum that is c everywhere is the grey c. Never below 0 nor above the greatest value
// of the spectrum: what reflects no more than 1 at any wavelength has no component above 1.
Spectrum surfaceColour(const SampledSpectrum& spectrum);

}  // namespace pbrt
