#pragma once
// Media that were measured.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/spectrum.h"

namespace pbrt {

// Per millimetre. Scattering is the reduced one, as of a medium that scatters all ways alike.
struct NamedMedium {
  Spectrum absorption{0}, scattering{0};
};

// By the names that pbrt-v3 and v4 have for them; empty if there is none.
std::optional<NamedMedium> namedMedium(std::string_view name);
std::vector<std::string> mediumNames();

}  // namespace pbrt
