#include "shapes/metaballs/roots.h"

namespace pbrt::metaballs {
namespace {

std::optional<double> find(const Field& field, const Cell& cell, AtomList list,
                           const ObjectRay& ray, bool any, Effort* effort, double tolerance) {
  Effort own;
  const DVec3 overlap = kOverlap * DVec3(cell.box.diagonal());
  RayQuery query{
      &ray, DPoint3(cell.box.lo) - overlap, DPoint3(cell.box.hi) + overlap, cell.box.centre(), any,
      0,    effort ? effort : &own};
  if (tolerance > 0) {
    query.acceptable = kInfinity;
    for (const std::uint32_t j : list)
      query.acceptable =
          std::min(query.acceptable, tolerance * static_cast<double>(field.atoms()[j].radius));
  }
  return loops().find(field.kernel(), field.atoms(), list, query);
}

}  // namespace

std::optional<double> firstCrossing(const Field& field, const Cell& cell, AtomList list,
                                    const ObjectRay& ray, Effort* effort, double tolerance) {
  return find(field, cell, list, ray, false, effort, tolerance);
}

bool crosses(const Field& field, const Cell& cell, AtomList list, const ObjectRay& ray) {
  return find(field, cell, list, ray, true, nullptr, 0).has_value();
}

}  // namespace pbrt::metaballs
