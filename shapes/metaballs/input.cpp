#include "shapes/metaballs/input.h"

#include <fmt/format.h>

#include "shapes/metaballs/atoms.h"
#include "shapes/metaballs/particles/particles.h"

namespace pbrt::metaballs {
namespace {

// The given values: none, one for all atoms, or one each.
template <class T>
std::vector<T> perAtom(const Params& params, const std::string& name, std::vector<T> values,
                       std::size_t atoms) {
  if (values.size() > 1 && values.size() != atoms)
    params.fail(name, fmt::format("{} values for {} atoms: give one for all, or one for each",
                                  values.size(), atoms));
  return values;
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
  Particles particles = readParticles(params);
  AtomValues values;
  values.radii = readRadii(params, particles);
  values.centres = std::move(particles.positions);
  const std::size_t count = values.centres.size();
  values.strengths =
      perAtom(params, "strength",
              params.numbers("strength",
                             "scale of an atom's field, for all atoms or for each; negative "
                             "carves (default: the file's, or 1)"),
              count);
  if (values.strengths.empty()) values.strengths = std::move(particles.strengths);
  if (values.strengths.empty()) values.strengths = {1};
  std::vector<Spectrum> colors = perAtom(
      params, "color",
      params.spectra("color",
                     "colour of an atom, for all atoms or for each, for the texture "
                     "\"shapecolor\": the surface takes the mean by weight of field (default: the "
                     "file's)"),
      count);
  if (colors.empty()) colors = std::move(particles.colors);
  const std::string name =
      params.choice("kernel", kKernels, kKernels[0], "how the field falls with the distance");
  values.kernel = static_cast<Kernel>(std::ranges::find(kKernels, name) - kKernels.begin());
  values.threshold = defaultThreshold(values.kernel, largestRadius(values));
  const float given = params.number(
      "threshold", static_cast<float>(values.threshold),
      "value of the field on the surface (poly6: the default is over the largest radius cubed)",
      values.kernel == Kernel::poly6 ? "per volume" : "");
  if (params.has("threshold")) values.threshold = given;

  Atoms made = makeAtoms(values, [&](const char* parameter, const std::string& message) {
    params.fail(parameter, message);
  });
  std::vector<Spectrum> kept;
  if (!colors.empty())
    for (const std::uint32_t i : made.numbers) kept.push_back(pick(colors, i));
  return {Field(values.kernel, std::move(made.atoms)), std::move(kept)};
}

}  // namespace pbrt::metaballs
