#include "core/api/medium.h"

#include <fmt/format.h>

#include "core/base/error.h"

namespace pbrt {

Medium::~Medium() = default;

MediumPoint Medium::at(const DPoint3& p) const {
  const DPoint3 q = toMedium_.point(p);
  const bool within = glm::all(glm::lessThanEqual(lo_, q)) && glm::all(glm::lessThanEqual(q, hi_));
  return within ? properties(q) : MediumPoint();
}

MediumPoint Medium::inside(const DPoint3& p) const {
  return properties(glm::clamp(toMedium_.point(p), lo_, hi_));
}

// Kay and Kajiya 1986: slabs. A ray in the plane of a face counts as inside.
std::optional<Interval> Medium::clip(const DPoint3& o, const DVec3& w, Interval t) const {
  if (!bounded()) return t;
  const DPoint3 p = toMedium_.point(o);
  const DVec3 d = toMedium_.vector(w);
  for (int i = 0; i < 3; ++i) {
    if (d[i] == 0) {
      if (p[i] < lo_[i] || p[i] > hi_[i]) return {};
      continue;
    }
    const double a = (lo_[i] - p[i]) / d[i], b = (hi_[i] - p[i]) / d[i];
    t.begin = std::max(t.begin, std::min(a, b));
    t.end = std::min(t.end, std::max(a, b));
  }
  if (!(t.begin < t.end)) return {};
  return t;
}

void Medium::setCells(const glm::ivec3& n, std::vector<Cell> cells, bool glows) {
  constexpr double kMost = 1e7;  // tentative collisions in one cell
  const Transform toRender = toMedium_.inverse();
  double across = 0;  // a cell, no less than its diagonal in render space
  for (int i = 0; i < 3 && bounded(); ++i) {
    DVec3 edge(0);
    edge[i] = (hi_[i] - lo_[i]) / n[i];
    across += glm::length(toRender.vector(edge));
  }
  for (Cell& cell : cells) {
    // One tentative collision or two on the way through a cell.
    if (glows)
      cell.majorant =
          glm::max(cell.majorant, Spectrum(across > 0 ? static_cast<float>(2 / across) : 1.F));
    if (!isFinite(cell.majorant)) throw Error("the medium is denser than can be told in floats");
    const float most = std::max({cell.majorant.x, cell.majorant.y, cell.majorant.z});
    if (!cell.uniform && most * across > kMost)
      throw Error(
          fmt::format("within an optical depth of {:.2g} the medium is not uniform: it is too "
                      "dense to be traced",
                      most * across));
  }
  n_ = n;
  cells_ = std::move(cells);
}

}  // namespace pbrt
