#pragma once
// Systems of RGB, and the one that the renderer carries light in: linear Rec. 709.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/spectrum.h"

namespace pbrt {

enum class ColorSpace : std::uint8_t { srgb, rec2020, aces2065_1, dci_p3 };

// By the name that a scene file of pbrt-v4 uses: "srgb", "rec2020", "aces2065-1", "dci-p3".
std::optional<ColorSpace> findColorSpace(std::string_view name);
// Every name, for "did you mean".
std::vector<std::string> colorSpaceNames();

// From linear RGB of a space to linear Rec. 709, white to white (1, 1, 1). What lies outside of
// Rec. 709 gets negative components.
glm::dmat3 toRec709(ColorSpace from);

// From CIE XYZ to linear Rec. 709; D65 of luminance Y = 1 becomes (1, 1, 1).
const glm::dmat3& rec709FromXyz();

}  // namespace pbrt
