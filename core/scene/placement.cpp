#include "core/scene/placement.h"

namespace pbrt {

namespace {

// Whether the linear part only turns, mirrors and scales alike in all directions: then its columns
// are as long as each other and at right angles.
bool isSimilar(const Transform& t) {
  const glm::dmat3 m(t.matrix());
  const double l2 = lengthSquared(m[0]), tolerance = 1e-12 * l2;
  return std::abs(lengthSquared(m[1]) - l2) < tolerance &&
         std::abs(lengthSquared(m[2]) - l2) < tolerance &&
         std::abs(glm::dot(m[0], m[1])) < tolerance && std::abs(glm::dot(m[0], m[2])) < tolerance &&
         std::abs(glm::dot(m[1], m[2])) < tolerance;
}

float largest(const Vec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

Normal3 unitNormal(const Transform& t, const Normal3& n) {
  return Normal3(glm::normalize(t.normal(DVec3(n))));
}

// A shading normal and its derivatives. With N the inverse transpose, n' = N n / |N n|; of a
// vector's direction only the part across it counts, so dn' is that part of N dn / |N n|.
void transformNormals(const Transform& t, Normal3& n, Normal3& dndu, Normal3& dndv) {
  const DVec3 moved = t.normal(DVec3(n));
  const double scale = 1 / std::sqrt(lengthSquared(moved));
  const DVec3 unit = moved * scale;
  for (Normal3* derivative : {&dndu, &dndv}) {
    const DVec3 d = t.normal(DVec3(*derivative)) * scale;
    *derivative = Normal3(d - glm::dot(d, unit) * unit);
  }
  n = Normal3(unit);
}

// Directions seen through an affine map M: w' = M w / |M w|. An element of solid angle grows by
// |det M| / |M w|^3, so a density per solid angle is divided by that. It is 1 for rotations,
// translations and uniform scales, whatever their size.
class PlacedSampler final : public AreaSampler {
 public:
  PlacedSampler(const AreaSampler& sampler, const Transform& toRender, bool reverse)
      : sampler_(sampler),
        toRender_(toRender),
        toObject_(toRender.inverse()),
        determinant_(std::abs(glm::determinant(glm::dmat3(toRender.matrix())))),
        stretch_(stretch(toRender)),
        similar_(isSimilar(toRender)),
        normalMatrix_(glm::transpose(glm::dmat3(toRender.inverseMatrix())) *
                      ((reverse ? -1 : 1) * std::cbrt(determinant_))),
        reverse_(reverse) {}

  // Exact for similar maps; otherwise as if the map stretched alike in all directions.
  double area() const override {
    const double scale = std::cbrt(determinant_);
    return sampler_.area() * scale * scale;
  }

  AreaSample sample(const DPoint3& from, Point2 u) const override {
    const DPoint3 origin = toObject_.point(from);
    AreaSample s = sampler_.sample(origin, u);
    if (s.pdf == 0) return s;
    s.pdf *= densityFactor(s.p - origin);
    s.p = toRender_.point(s.p);
    s.n = normalMatrix_ * s.n;  // of unit length if the map is similar
    if (!similar_) s.n = glm::normalize(s.n);
    s.error *= stretch_;
    return s;
  }

  float pdf(const DPoint3& from, const DPoint3& p, const Normal3& n) const override {
    const DPoint3 origin = toObject_.point(from), point = toObject_.point(p);
    // Normals go back by the transpose of the map that brought them here.
    return sampler_.pdf(origin, point, unitNormal(toObject_, reverse_ ? -n : n)) *
           densityFactor(point - origin);
  }

  bool mayHit(const DPoint3& from, const DVec3& w) const override {
    return sampler_.mayHit(toObject_.point(from), toObject_.vector(w));
  }

  DirectionCone normals() const override {
    const DirectionCone cone = sampler_.normals();
    // A plane stays one; a wider cone keeps its angle if the map is similar.
    if (cone.cosine < 1 && !similar_) return {};
    return {glm::normalize(normalMatrix_ * cone.axis), cone.cosine};
  }

 private:
  float densityFactor(const DVec3& w) const {
    if (similar_) return 1;
    const double l = std::sqrt(lengthSquared(toRender_.vector(w)) / lengthSquared(w));
    return static_cast<float>(l * l * l / determinant_);
  }

  const AreaSampler& sampler_;
  Transform toRender_, toObject_;
  double determinant_;
  double stretch_;
  bool similar_;
  glm::mat3 normalMatrix_;
  bool reverse_;
};

}  // namespace

double stretch(const Transform& t) {
  const glm::dmat4& m = t.matrix();
  return std::sqrt(lengthSquared(DVec3(m[0])) + lengthSquared(DVec3(m[1])) +
                   lengthSquared(DVec3(m[2])));
}

SurfaceInteraction placedSurface(const Shape& shape, const Transform& toRender, bool reverse,
                                 const Ray& ray, const ShapeHit& hit) {
  const SurfacePoint o = shape.surface(toRender.inverse().ray(ray), hit);
  SurfaceInteraction s;
  s.p = Point3(toRender.point(o.p));
  // Rounding to float moves the point by half an ulp in each coordinate, and the next ray's own
  // arithmetic starts from it.
  s.error = static_cast<float>(o.error * stretch(toRender)) + gammaBound(3) * largest(s.p);
  const float side = reverse ? -1 : 1;
  s.n = unitNormal(toRender, o.n) * side;
  s.ns = (o.ns == Normal3(0) ? o.n : o.ns) * side;
  s.dndu = o.dndu * side;
  s.dndv = o.dndv * side;
  transformNormals(toRender, s.ns, s.dndu, s.dndv);
  s.uv = o.uv;
  s.dpdu = Vec3(toRender.vector(DVec3(o.dpdu)));
  s.dpdv = Vec3(toRender.vector(DVec3(o.dpdv)));
  s.tangent = s.dpdu;
  s.color = shape.color();
  s.objectP = o.p;
  s.primitive = hit.primitive;
  return s;
}

void transformInteraction(SurfaceInteraction& s, const Transform& t) {
  s.p = Point3(t.point(DPoint3(s.p)));
  s.error = static_cast<float>(s.error * stretch(t)) + gammaBound(3) * largest(s.p);
  s.n = unitNormal(t, s.n);
  transformNormals(t, s.ns, s.dndu, s.dndv);
  s.dpdu = Vec3(t.vector(DVec3(s.dpdu)));
  s.dpdv = Vec3(t.vector(DVec3(s.dpdv)));
  s.tangent = Vec3(t.vector(DVec3(s.tangent)));
}

// Embree inverts the map and moves the ray's origin with it in floats: a dozen roundings of numbers
// up to |M^-1| (|p| + |translation|), which come back stretched by |M|.
float instanceError(const Transform& toRender, const Point3& p) {
  const double condition = stretch(toRender) * stretch(toRender.inverse());
  const Vec3 translation(DVec3(toRender.matrix()[3]));
  return gammaBound(12) * static_cast<float>(condition) * (largest(p) + largest(translation));
}

std::unique_ptr<AreaSampler> placedSampler(const AreaSampler& sampler, const Transform& toRender,
                                           bool reverse) {
  return std::make_unique<PlacedSampler>(sampler, toRender, reverse);
}

}  // namespace pbrt
