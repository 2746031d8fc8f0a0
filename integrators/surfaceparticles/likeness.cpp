#include "integrators/surfaceparticles/likeness.h"

#include <cmath>

namespace pbrt::surfels {
namespace {

glm::dmat3 gram(const Transform& t) {
  const glm::dmat3 l(t.matrix());
  return glm::transpose(l) * l;
}

double trace(const glm::dmat3& m) {
  return m[0][0] + m[1][1] + m[2][2];
}

}  // namespace

Likeness::Likeness(const ImplicitSurface& surface) : field(surface.field) {
  const glm::dmat3 g = gram(surface.toRender);
  std::size_t k = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j <= i; ++j) form[k++] = std::llround(0x1p20 * g[i][j] / trace(g));
}

double scaleBetween(const Transform& from, const Transform& to) {
  const double scale = std::sqrt(trace(gram(to)) / trace(gram(from)));
  const double step = std::exp2(std::ilogb(scale) - 20);
  return std::round(scale / step) * step;
}

// Lengths grow by the scale, curvatures shrink by it. With the orthogonal part Q of the map, the
// bend, a map from tangents to changes of the normal, becomes Q B Q^T.
Surfel placed(const Surfel& surfel, const Transform& map, double scale) {
  Surfel s = surfel;
  s.p = map.point(surfel.p);
  s.n = Normal3(glm::normalize(map.vector(DVec3(surfel.n))));
  s.radius = static_cast<float>(scale * surfel.radius);
  const glm::dmat3 q = glm::dmat3(map.matrix()) / scale;
  const float* b = surfel.bend;
  const glm::dmat3 bend(b[0], b[3], b[4], b[3], b[1], b[5], b[4], b[5], b[2]);
  const glm::dmat3 turned = q * bend * glm::transpose(q) / scale;
  const double parts[6] = {turned[0][0], turned[1][1], turned[2][2],
                           turned[1][0], turned[2][0], turned[2][1]};
  for (int i = 0; i < 6; ++i) s.bend[i] = static_cast<float>(parts[i]);
  return s;
}

}  // namespace pbrt::surfels
