#pragma once
// What the CIE has measured and laid down: the standard observer and the standard lamps.

#include <array>
#include <cstdint>

namespace pbrt {

// The colour-matching functions x, y, z of the 1931 observer (2 degrees), at 360, 365 ... 830 nm.
extern const std::array<std::array<double, 3>, 95> kColourMatching;
inline constexpr double kVisibleBegin = 360;  // nm
inline constexpr double kVisibleStep = 5;

// The mean S0 and the two variations S1, S2 of daylight, at 300, 310 ... 830 nm.
extern const std::array<std::array<double, 3>, 54> kDaylight;

// The lamps F1 to F12, relative power in hundredths, at 380, 385 ... 780 nm.
extern const std::array<std::array<std::uint16_t, 81>, 12> kFluorescent;

}  // namespace pbrt
