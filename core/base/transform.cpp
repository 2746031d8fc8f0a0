#include "core/base/transform.h"

#include <glm/gtc/matrix_transform.hpp>

namespace pbrt {

Transform::Transform(const glm::dmat4& m) : m_(m), inverse_(glm::inverse(m)) {}

Transform Transform::translate(const DVec3& delta) {
  return {glm::translate(glm::dmat4(1), delta), glm::translate(glm::dmat4(1), -delta)};
}

Transform Transform::scale(const DVec3& factors) {
  return {glm::scale(glm::dmat4(1), factors), glm::scale(glm::dmat4(1), 1.0 / factors)};
}

Transform Transform::rotate(double degrees, const DVec3& axis) {
  const glm::dmat4 m = glm::rotate(glm::dmat4(1), glm::radians(degrees), axis);
  return {m, glm::transpose(m)};
}

Transform Transform::lookAt(const DPoint3& eye, const DPoint3& look, const DVec3& up,
                            bool mirrored) {
  const DVec3 z = glm::normalize(look - eye);
  const DVec3 side = glm::cross(glm::normalize(up), z);
  // Parallel vectors span a sliver once they are rounded.
  if (!(glm::length(side) > 1e-10)) return Transform(glm::dmat4(0));
  DVec3 x = glm::normalize(side);
  const DVec3 y = glm::cross(z, x);
  if (mirrored) x = -x;
  const glm::dmat4 worldFromCamera(glm::dvec4(x, 0), glm::dvec4(y, 0), glm::dvec4(z, 0),
                                   glm::dvec4(eye, 1));
  return Transform(worldFromCamera).inverse();
}

bool Transform::invertible() const {
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r)
      if (!std::isfinite(m_[c][r]) || !std::isfinite(inverse_[c][r])) return false;
  // Beyond this condition number (of the linear part, Frobenius norm) nothing is left of 53 bits:
  // the matrix is singular but for rounding.
  const auto norm2 = [](const glm::dmat3& m) {
    return lengthSquared(m[0]) + lengthSquared(m[1]) + lengthSquared(m[2]);
  };
  return norm2(glm::dmat3(m_)) * norm2(glm::dmat3(inverse_)) < sqr(1e13);
}

bool Transform::swapsHandedness() const {
  return glm::determinant(glm::dmat3(m_)) < 0;
}

Bounds3 Transform::bounds(const Bounds3& b) const {
  if (b.empty()) return b;
  // Arvo 1990, "Transforming Axis-Aligned Bounding Boxes": each matrix entry adds its smaller
  // product to the low corner and its larger one to the high corner.
  DPoint3 lo(m_[3]), hi(m_[3]);
  for (int c = 0; c < 3; ++c) {
    const DVec3 p = DVec3(m_[c]) * static_cast<double>(b.lo[c]);
    const DVec3 q = DVec3(m_[c]) * static_cast<double>(b.hi[c]);
    lo += glm::min(p, q);
    hi += glm::max(p, q);
  }
  return roundOutward(lo, hi);
}

DPoint3 Transform::project(const DPoint3& p) const {
  const glm::dvec4 q = m_ * glm::dvec4(p, 1);
  return DPoint3(q) / q.w;
}

}  // namespace pbrt
