#include "particles.h"

#include <fmt/format.h>

#include <algorithm>

#include "formats.h"
#include "shapes/files/scanner.h"

namespace pbrt {
namespace particles {
namespace {

Particles readByName(const Input& input) {
  std::filesystem::path name = files::lowered(input.name());
  if (name.extension() == ".gz") name = name.stem();
  const std::string suffix = name.extension().string();
  if (suffix == ".ply") return readPly(input);
  if (suffix == ".vtk") return readVtk(input);
  if (suffix == ".xyz") return isRaw(input) ? readRaw(input) : readTable(input);
  if (suffix == ".csv" || suffix == ".txt") return readTable(input);
  if (suffix == ".bgeo" || suffix == ".bhclassic") return readBgeo(input);
  if (suffix == ".vtu" || suffix == ".vtp")
    input.fail("is VTK's XML format, which is not read; save it as legacy .vtk or as .ply");
  input.fail(
      fmt::format("\"{}\" is not a suffix of particle files, which are .ply .vtk .csv .xyz "
                  ".txt .bgeo .bhclassic, and each with .gz",
                  suffix));
}

bool isFinite(float x) {
  return std::isfinite(x);
}

template <class V>
void checkFinite(const std::vector<V>& values, std::string_view what, const Input& input) {
  const auto bad = std::find_if(values.begin(), values.end(), [](const V& value) {
    using pbrt::isFinite;
    using particles::isFinite;
    return !isFinite(value);
  });
  if (bad != values.end())
    input.fail(fmt::format("particle {} (the first is 0): its {} is not finite",
                           bad - values.begin(), what));
}

Particles readChecked(const Input& input) {
  if (input.bytes().empty()) input.fail("is empty");
  Particles particles = readByName(input);
  if (particles.positions.empty()) input.fail("holds no particles");
  checkFinite(particles.positions, "position", input);
  checkFinite(particles.radii, "radius", input);
  checkFinite(particles.colors, "colour", input);
  checkFinite(particles.velocities, "velocity", input);
  checkFinite(particles.strengths, "strength", input);
  return particles;
}

}  // namespace
}  // namespace particles

Particles readParticles(const std::filesystem::path& file) {
  return particles::readChecked(particles::Input(file));
}

Particles readParticles(std::string name, std::string bytes) {
  return particles::readChecked({std::move(name), std::move(bytes)});
}

}  // namespace pbrt
