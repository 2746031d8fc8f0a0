#include "shapes/files/ply.h"

#include "formats.h"
#include "quantities.h"

namespace pbrt::particles {

using files::PlyElement, files::PlyFile, files::PlyProperty;

namespace {

// Where the properties of the particles go. Lists mean nothing.
std::vector<std::optional<Target>> prepare(Particles& particles, const PlyElement& vertices,
                                           const Input& input) {
  std::vector<std::string> names;
  for (const PlyProperty& p : vertices.properties) names.push_back(p.lengthType ? "" : p.name);
  const Columns columns = columnsOf(names, input);
  allocate(particles, columns, vertices.count);
  std::vector<std::optional<Target>> targets(columns.size());
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (columns[i]) {
      targets[i] = target(particles, *columns[i]);
      if (columns[i]->quantity == Quantity::color)
        targets[i]->scale = colorScale(vertices.properties[i].type);
    }
  return targets;
}

}  // namespace

Particles readPly(const Input& input) {
  PlyFile file(input);
  for (const PlyElement& element : file.elements()) {
    if (element.name != "vertex") {
      file.skip(element);
      continue;
    }
    file.checkRoom(element);
    Particles particles;
    file.read(element, prepare(particles, element, input));
    return particles;
  }
  input.fail("has no element \"vertex\"");
}

}  // namespace pbrt::particles
