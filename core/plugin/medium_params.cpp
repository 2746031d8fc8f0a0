#include "core/plugin/medium_params.h"

#include <fmt/format.h>

#include "core/base/named_media.h"

namespace pbrt {

Spectrum readNonNegative(Params& p, const std::string& name, float fallback,
                         std::string_view meaning) {
  const Spectrum value = p.spectrum(name, Spectrum(fallback), meaning);
  for (int c = 0; c < 3; ++c)
    if (!(value[c] >= 0 && std::isfinite(value[c])))
      p.fail(name, fmt::format("must not be negative, but is {}", value[c]));
  return value;
}

std::vector<float> readDensities(Params& p, const std::string& name, std::string_view meaning) {
  std::vector<float> values = p.numbers(name, meaning);
  for (const float v : values)
    if (!(v >= 0 && std::isfinite(v)))
      p.fail(name, fmt::format("must not be negative, but is {}", v));
  return values;
}

MediumParams readMedium(Params& p) {
  const std::string preset = p.text("preset", "", "of measured media, e.g. \"Wholemilk\"");
  std::optional<NamedMedium> named;
  if (!preset.empty()) {
    named = namedMedium(preset);
    if (!named)
      p.fail("preset", fmt::format("there is no medium \"{}\"{}", shown(preset),
                                   didYouMean(preset, mediumNames())));
  }
  MediumParams medium;
  medium.unit.absorption = named && !p.has("sigma_a")
                               ? named->absorption
                               : readNonNegative(p, "sigma_a", 1, "absorption per unit length");
  medium.unit.scattering = named && !p.has("sigma_s")
                               ? named->scattering
                               : readNonNegative(p, "sigma_s", 1, "scattering per unit length");
  const float scale = p.nonNegative("scale", 1, "multiplies sigma_a and sigma_s");
  medium.unit.absorption *= scale;
  medium.unit.scattering *= scale;
  medium.g = p.inRange("g", 0, -0.999F, 0.999F,
                       "mean cosine of scattering: above 0 forward, below 0 backward");
  medium.unit.emission = p.emission("Le", Spectrum(0), "radiance that the medium emits");
  for (int c = 0; c < 3; ++c)
    if (!(medium.unit.emission[c] >= 0)) p.fail("Le", "must not be negative");
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
