#pragma once
// Affine and projective maps, kept with their inverses and in double.

#include "core/base/bounds.h"
#include "core/base/ray.h"

namespace pbrt {

class Transform {
 public:
  Transform() = default;
  // m maps column vectors; the inverse is computed. If m is singular, but for rounding, then
  // `invertible()` is false.
  explicit Transform(const glm::dmat4& m);
  Transform(const glm::dmat4& m, const glm::dmat4& inverse) : m_(m), inverse_(inverse) {}

  static Transform translate(const DVec3& delta);
  static Transform scale(const DVec3& factors);
  static Transform rotate(double degrees, const DVec3& axis);
  // Camera space from world space for a camera at `eye` that looks along +z towards `look`, +y up.
  // x points right as pbrt-v2 and later have it; `mirrored` gives pbrt-v1's opposite x.
  // Not invertible when the three do not span a plane.
  static Transform lookAt(const DPoint3& eye, const DPoint3& look, const DVec3& up, bool mirrored);

  const glm::dmat4& matrix() const { return m_; }
  const glm::dmat4& inverseMatrix() const { return inverse_; }
  Transform inverse() const { return {inverse_, m_}; }
  Transform operator*(const Transform& b) const { return {m_ * b.m_, b.inverse_ * inverse_}; }

  bool invertible() const;
  bool swapsHandedness() const;
  bool isIdentity() const { return m_ == glm::dmat4(1); }

  // Affine use: the last row of the matrix is taken as 0 0 0 1.
  DPoint3 point(const DPoint3& p) const {
    return DPoint3(m_[0]) * p.x + DPoint3(m_[1]) * p.y + DPoint3(m_[2]) * p.z + DPoint3(m_[3]);
  }
  DVec3 vector(const DVec3& v) const {
    return DVec3(m_[0]) * v.x + DVec3(m_[1]) * v.y + DVec3(m_[2]) * v.z;
  }
  // By the inverse transpose; the length is not kept.
  DVec3 normal(const DVec3& n) const {
    return {glm::dot(DVec3(inverse_[0]), n), glm::dot(DVec3(inverse_[1]), n),
            glm::dot(DVec3(inverse_[2]), n)};
  }
  // The box of the transformed box, rounded outward. Empty stays empty.
  Bounds3 bounds(const Bounds3& b) const;
  // With the projective division; for camera matrices.
  DPoint3 project(const DPoint3& p) const;
  // The same points, named by the same t.
  ObjectRay ray(const Ray& r) const {
    return {point(DPoint3(r.o)), vector(DVec3(r.d)), r.tMin, r.tMax};
  }

 private:
  glm::dmat4 m_{1};
  glm::dmat4 inverse_{1};
};

}  // namespace pbrt
