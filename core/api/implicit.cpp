#include "core/api/implicit.h"

namespace pbrt {

ImplicitField::~ImplicitField() = default;

LineRange ImplicitField::along(const DPoint3& o, const DVec3& u, const Range& s,
                               double error) const {
  DPoint3 lo, hi;
  for (int i = 0; i < 3; ++i) {
    const Range x = o[i] + s * u[i] + Range(-error, error);
    lo[i] = x.lo, hi[i] = x.hi;
  }
  const FieldRange box = over(lo, hi);
  return {box.value, box.gradient[0] * u.x + box.gradient[1] * u.y + box.gradient[2] * u.z};
}

glm::dmat3 ImplicitField::hessian(const DPoint3& p) const {
  const double step = 0x1p-17 * glm::length(DVec3(bounds().diagonal()));
  glm::dmat3 h;
  for (int i = 0; i < 3; ++i) {
    DVec3 aside(0);
    aside[i] = step;
    h[i] = (at(p + aside).gradient - at(p - aside).gradient) / (2 * step);
  }
  return h;
}

}  // namespace pbrt
