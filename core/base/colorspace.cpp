#include "core/base/colorspace.h"

#include <array>

namespace pbrt {

namespace {

using glm::dmat3;
using Xy = glm::dvec2;

// Chromaticities of the primaries and of white.
struct Primaries {
  std::string_view name;
  Xy red, green, blue, white;
};

// XYZ = (0.95047, 1, 1.08883) of ASTM E308, which is what the spectrum of D65 integrates to.
constexpr Xy kD65{0.312727, 0.329023};

// In the order of ColorSpace. ITU-R BT.709-6, ITU-R BT.2020-2, SMPTE ST 2065-1, and SMPTE RP 431-2
// with the white of D65, as pbrt-v4 has it (Display P3).
constexpr std::array kSpaces{
    Primaries{"srgb", {0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, kD65},
    Primaries{"rec2020", {0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, kD65},
    Primaries{"aces2065-1", {0.7347, 0.2653}, {0, 1}, {0.0001, -0.0770}, {0.32168, 0.33767}},
    Primaries{"dci-p3", {0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, kD65}};

DVec3 withZ(const Xy& c) {
  return {c.x, c.y, 1 - c.x - c.y};
}

// XYZ of a chromaticity at luminance 1.
DVec3 xyz(const Xy& c) {
  return withZ(c) / c.y;
}

// RGB to XYZ: the primaries are the columns, scaled so that (1, 1, 1) is white at luminance 1.
dmat3 toXyz(const Primaries& space) {
  const dmat3 p(withZ(space.red), withZ(space.green), withZ(space.blue));
  const DVec3 scale = glm::inverse(p) * xyz(space.white);
  return {p[0] * scale.x, p[1] * scale.y, p[2] * scale.z};
}

// XYZ seen under one white to XYZ that looks the same under another: each response of the eye's
// cones is scaled by itself (von Kries), cones by the Bradford matrix (Lam 1985).
dmat3 adaptation(const Xy& from, const Xy& to) {
  const dmat3 cones =
      glm::transpose(dmat3(0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685,
                           1.0296));  // written row by row
  const DVec3 gain = (cones * xyz(to)) / (cones * xyz(from));
  return glm::inverse(cones) * dmat3(gain.x, 0, 0, 0, gain.y, 0, 0, 0, gain.z) * cones;
}

}  // namespace

std::optional<ColorSpace> findColorSpace(std::string_view name) {
  for (std::size_t i = 0; i < kSpaces.size(); ++i)
    if (kSpaces[i].name == name) return static_cast<ColorSpace>(i);
  return {};
}

std::vector<std::string> colorSpaceNames() {
  std::vector<std::string> names;
  for (const Primaries& space : kSpaces) names.emplace_back(space.name);
  return names;
}

glm::dmat3 toRec709(ColorSpace from) {
  const Primaries& space = kSpaces[static_cast<std::size_t>(from)];
  return rec709FromXyz() * adaptation(space.white, kD65) * toXyz(space);
}

const glm::dmat3& rec709FromXyz() {
  static const dmat3 matrix = glm::inverse(toXyz(kSpaces[0]));
  return matrix;
}

}  // namespace pbrt
