#pragma once
// The spectra that a scene file may name: those of pbrt-v4, e.g. "metal-Au-eta", "glass-BK7",
// "stdillum-D65".

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/sampled_spectrum.h"

namespace pbrt {

// Empty if there is none of this name.
std::optional<SampledSpectrum> namedSpectrum(std::string_view name);
// Every name, for "did you mean".
std::vector<std::string> spectrumNames();

// Named spectra of lamps have no scale of their own.
bool isIlluminant(std::string_view name);

}  // namespace pbrt
