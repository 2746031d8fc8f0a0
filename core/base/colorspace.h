#pragma once
// The colour spaces in which a scene may give its colours (pbrt-v4's ColorSpace).

#include <array>
#include <optional>
#include <string_view>

#include "core/base/math.h"

namespace pbrt {

enum class ColorSpace : std::uint8_t { srgb, rec2020, aces2065_1, dciP3 };
inline constexpr std::array<std::string_view, 4> kColorSpaceNames = {"srgb", "rec2020",
                                                                     "aces2065-1", "dci-p3"};
std::optional<ColorSpace> colorSpaceByName(std::string_view name);
glm::dmat3 rec709From(ColorSpace space);

}  // namespace pbrt
