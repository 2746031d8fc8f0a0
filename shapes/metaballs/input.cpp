#include "shapes/metaballs/input.h"

#include <fmt/format.h>

#include "core/base/parallel.h"
#include "shapes/metaballs/particles/particles.h"

namespace pbrt::metaballs {
namespace {

// Half the distance of neighbours: the median over some particles of the distance to the nearest
// other, halved. 0 if all are in one place.
float typicalParticleRadius(const std::vector<Point3>& positions) {
  constexpr std::size_t most = 64;
  const std::size_t samples = std::min(most, positions.size());
  std::vector<float> nearest(samples, kInfinity);
  parallelFor(samples, [&](std::size_t i) {
    const Point3 p = positions[i * positions.size() / samples];
    for (const Point3& other : positions) {
      const float d = lengthSquared(other - p);
      nearest[i] = d > 0 ? std::min(nearest[i], d) : nearest[i];
    }
  });
  std::ranges::nth_element(nearest, nearest.begin() + samples / 2);
  const float d = std::sqrt(nearest[samples / 2]);
  return d < kInfinity ? 0.5F * d : 0;
}

// The given values: none, one for all atoms, or one each.
template <class T>
std::vector<T> perAtom(const Params& params, const std::string& name, std::vector<T> values,
                       std::size_t atoms) {
  if (values.size() > 1 && values.size() != atoms)
    params.fail(name, fmt::format("{} values for {} atoms: give one for all, or one for each",
                                  values.size(), atoms));
  return values;
}

template <class T>
const T& pick(const std::vector<T>& values, std::size_t i) {
  return values.size() == 1 ? values[0] : values[i];
}

Particles readParticles(Params& params) {
  const std::filesystem::path file =
      params.file("filename", "particles to take instead of \"P\": .ply .vtk .csv .xyz .txt .bgeo");
  Particles particles;
  particles.positions = params.points("P", "centres of the atoms");
  if (file.empty()) {
    params.require("P");
    return particles;
  }
  if (!particles.positions.empty())
    params.fail("P", "the atoms are given twice, by \"P\" and by \"filename\"");
  try {
    return pbrt::readParticles(file);
  } catch (const Error& error) {
    throw error.at(params.where());
  }
}

// The support radii, one for all or one each.
std::vector<float> readRadii(Params& params, const Particles& particles) {
  std::vector<float> radii =
      perAtom(params, "radius",
              params.numbers("radius",
                             "where an atom's field ends, for all atoms or for each (default 1; "
                             "for a file see radiusscale)",
                             "scene units"),
              particles.positions.size());
  const float scale = params.positive(
      "radiusscale", 4,
      "for particles of a file, unless \"radius\" is given: an atom's radius over that of its "
      "particle, which is the file's or half the usual distance of two neighbours");
  if (!radii.empty()) return radii;
  if (!params.has("filename")) return {1};
  radii = particles.radii;
  if (radii.empty()) {
    radii = {typicalParticleRadius(particles.positions)};
    if (radii[0] == 0)
      params.fail("filename", "the particles have neither radii nor distances: give \"radius\"");
  }
  for (float& radius : radii) radius *= scale;
  return radii;
}

}  // namespace

Input readInput(Params& params) {
  const Particles particles = readParticles(params);
  const std::vector<Point3>& centres = particles.positions;
  const std::vector<float> radii = readRadii(params, particles);
  std::vector<float> strengths =
      perAtom(params, "strength",
              params.numbers("strength",
                             "scale of an atom's field, for all atoms or for each; negative "
                             "carves (default: the file's, or 1)"),
              centres.size());
  if (strengths.empty()) strengths = particles.strengths;
  if (strengths.empty()) strengths = {1};
  std::vector<Spectrum> colors = perAtom(
      params, "color",
      params.spectra("color",
                     "colour of an atom, for all atoms or for each, for the texture "
                     "\"shapecolor\": the surface takes the mean by weight of field (default: the "
                     "file's)"),
      centres.size());
  if (colors.empty()) colors = particles.colors;
  const std::string name =
      params.choice("kernel", kKernels, kKernels[0], "how the field falls with the distance");
  const auto kernel = static_cast<Kernel>(std::ranges::find(kKernels, name) - kKernels.begin());

  float largest = 0;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const auto check = [&](bool good, const char* parameter, float value, std::string_view rule) {
      if (!good)
        params.fail(parameter, fmt::format("atom {} (the first is 0): {} is {}, but {}", i,
                                           parameter, value, rule));
    };
    const Point3& c = centres[i];
    const float radius = pick(radii, i);
    for (int k = 0; k < 3; ++k) check(std::isfinite(c[k]), "P", c[k], "a centre must be finite");
    check(std::isfinite(radius) && radius > 0, "radius", radius,
          "a support radius must be finite and greater than 0: a field over no space has no "
          "surface");
    check(radius > 1e-15F && radius < 1e15F, "radius", radius,
          "it must lie between 1e-15 and 1e15: scale the scene");
    check(std::isfinite(pick(strengths, i)), "strength", pick(strengths, i),
          "a strength must be finite");
    largest = std::max(largest, radius);
  }

  // poly6 is a density: its values scale with 1 / h^3, and so does the default. A lone atom of
  // strength 1 is then a ball of 0.563 h whatever its h.
  const bool density = kernel == Kernel::poly6 && largest > 0;
  const double fallback = density ? 0.5 / std::pow(static_cast<double>(largest), 3) : 0.5;
  const float given = params.number(
      "threshold", static_cast<float>(fallback),
      "value of the field on the surface (poly6: the default is over the largest radius cubed)",
      kernel == Kernel::poly6 ? "per volume" : "");
  const double threshold = params.has("threshold") ? given : fallback;
  if (!std::isfinite(threshold) || threshold <= 0)
    params.fail("threshold",
                fmt::format("the threshold is {}, but it must be finite and greater "
                            "than 0: the field is 0 away from all atoms, so the inside "
                            "would have no end",
                            threshold));

  std::vector<Atom> atoms;
  std::vector<Spectrum> kept;
  atoms.reserve(centres.size());
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const float h = pick(radii, i), strength = pick(strengths, i);
    if (strength == 0) continue;
    const double weight = strength * scale(kernel, h) / threshold;
    if (!(std::abs(weight) < 1e30))
      params.fail("strength", fmt::format("atom {} (the first is 0): its field is {:.0e} times the "
                                          "threshold, but 1e30 is the most",
                                          i, std::abs(weight)));
    atoms.emplace_back(centres[i], h, weight);
    if (!colors.empty()) kept.push_back(pick(colors, i));
  }
  return {Field(kernel, std::move(atoms)), std::move(kept)};
}

}  // namespace pbrt::metaballs
