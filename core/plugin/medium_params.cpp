#include "core/plugin/medium_params.h"

#include <fmt/format.h>

#include "core/base/named_media.h"

namespace pbrt {

void checkNonNegative(const Params& p, const std::string& name, std::span<const float> values) {
  for (const float v : values)
    if (!(v >= 0 && std::isfinite(v)))
      p.fail(name, fmt::format("must {}, but is {}", v < 0 ? "not be negative" : "be finite", v));
}

Spectrum readNonNegative(Params& p, const std::string& name, float fallback,
                         std::string_view meaning) {
  const Spectrum value = p.spectrum(name, Spectrum(fallback), meaning);
  checkNonNegative(p, name, {&value.x, 3});
  return value;
}

std::vector<float> readDensities(Params& p, const std::string& name, std::string_view meaning) {
  std::vector<float> values = p.numbers(name, meaning);
  checkNonNegative(p, name, values);
  return values;
}

float readRadianceScale(Params& p) {
  return p.nonNegative(
      "radiancescale", 1,
      "multiplies that radiance: pbrt-v4 does not divide it by the integral of the CIE's y");
}

MediumParams readMedium(Params& p) {
  const std::string preset = p.text("preset", "", "of measured media, e.g. \"Wholemilk\"");
  const bool presetFirst =
      p.flag("presetfirst", false, "preset goes before sigma_a and sigma_s (pbrt-v4)");
  std::optional<NamedMedium> named;
  if (!preset.empty()) {
    named = namedMedium(preset);
    if (!named)
      p.fail("preset", fmt::format("there is no medium \"{}\"{}", shown(preset),
                                   didYouMean(preset, mediumNames())));
  }
  const auto read = [&](const std::string& name, Spectrum NamedMedium::*measured,
                        std::string_view meaning) {
    if (named && !p.has(name)) return (*named).*measured;
    const Spectrum given = readNonNegative(p, name, 1, meaning);
    if (!named) return given;
    p.warn(name,
           presetFirst ? "without effect beside \"preset\"" : "takes the place of \"preset\"");
    return presetFirst ? (*named).*measured : given;
  };
  MediumParams medium;
  medium.unit.absorption = read("sigma_a", &NamedMedium::absorption, "absorption per unit length");
  medium.unit.scattering = read("sigma_s", &NamedMedium::scattering, "scattering per unit length");
  const float scale = p.nonNegative("scale", 1, "multiplies sigma_a and sigma_s");
  medium.unit.absorption *= scale;
  medium.unit.scattering *= scale;
  medium.g = p.inRange("g", 0, -0.999F, 0.999F,
                       "mean cosine of scattering: above 0 forward, below 0 backward");
  medium.unit.emission = p.emission("Le", Spectrum(0), "radiance that the medium emits");
  checkNonNegative(p, "Le", {&medium.unit.emission.x, 3});
  if (p.flag("thermal", true,
             "Le is that of a black body: what is emitted goes with sigma_a; else Le is emitted by "
             "a unit length"))
    medium.unit.emission *= medium.unit.absorption;
  return medium;
}

MediumBox readMediumBox(Params& p) {
  const DPoint3 a(p.point("p0", Point3(0), "a corner of the box"));
  const DPoint3 b(p.point("p1", Point3(1), "the opposite corner"));
  for (int i = 0; i < 3; ++i)
    if (a[i] == b[i]) p.fail("p1", "makes the box flat");
  return {glm::min(a, b), glm::max(a, b)};
}

glm::ivec3 readVoxels(Params& p) {
  constexpr int kMost = 1 << 20;
  const int nx = p.integer("nx", 1, 1, kMost, "voxels in x");
  const int ny = p.integer("ny", 1, 1, kMost, "voxels in y");
  const int nz = p.integer("nz", 1, 1, kMost, "voxels in z");
  return {nx, ny, nz};
}

void checkVoxels(const Params& p, const std::string& name, const glm::ivec3& n, std::size_t count) {
  const double voxels = double{1} * n.x * n.y * n.z;
  if (static_cast<double>(count) != voxels && !p.describing())
    p.fail(name,
           fmt::format("needs {} x {} x {} = {:.0f} values, not {}", n.x, n.y, n.z, voxels, count));
}

}  // namespace pbrt
