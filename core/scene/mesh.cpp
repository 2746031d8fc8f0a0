#include "core/scene/mesh.h"

#include "core/base/warp.h"

namespace pbrt {

namespace {

struct Corners {
  std::uint32_t a, b, c;
};

Corners corners(const TriangleMesh& mesh, std::size_t triangle) {
  const std::uint32_t* i = &mesh.indices[3 * triangle];
  return {i[0], i[1], i[2]};
}

// The plane of a triangle: its unit normal by the winding, zero if there is no area, and a bound on
// the distance between the plane as the ray tracer computes it and a point interpolated on it.
//
// Both come from a few float operations on coordinates of the size of the corners. The ray tracer's
// normal is a product of two edges, of which a component k is uncertain by a few units in the last
// place of the triangle's extent e_k. So a component of the normal is uncertain by as many of the
// product of the other two extents, and moves the plane, at the far end, by that times e_k over
// |ab x ac|: e_x e_y e_z / |ab x ac| for each component. That is about the longest edge, but more
// for needles, of whose plane nothing is left in the end, and nothing in a coordinate plane.
struct Plane {
  Normal3 n{0};
  float error = 0;
};
Plane planeOf(const Point3& a, const Point3& b, const Point3& c) {
  // In double, as the squares of edges below 1e-12 or above 1e9 leave float.
  const DVec3 ab = DVec3(b) - DVec3(a), ac = DVec3(c) - DVec3(a), n = glm::cross(ab, ac);
  const double doubleArea = std::sqrt(lengthSquared(n));
  if (!(doubleArea > 0)) return {};
  const double inverse = 1 / doubleArea;
  const DVec3 extent = glm::max(glm::max(glm::abs(ab), glm::abs(ac)), glm::abs(ac - ab));
  const double longest = std::max({extent.x, extent.y, extent.z});
  const double tilted = std::min(3 * extent.x * extent.y * extent.z * inverse, 1e6 * longest);
  const Vec3 size = glm::max(glm::abs(a), glm::max(glm::abs(b), glm::abs(c)));
  return {Normal3(n * inverse),
          gammaBound(8) * (std::max({size.x, size.y, size.z}) + static_cast<float>(tilted))};
}

// The interpolated normal, of any length; zero if the mesh has none.
Normal3 vertexNormal(const TriangleMesh& mesh, const Corners& t, float wa, float wb, float wc) {
  if (mesh.normals.empty()) return Normal3(0);
  return wa * mesh.normals[t.a] + wb * mesh.normals[t.b] + wc * mesh.normals[t.c];
}

class MeshSampler final : public AreaSampler {
 public:
  MeshSampler(const TriangleMesh& mesh, bool flip, bool reverse)
      : mesh_(mesh), flip_(flip), reverse_(reverse) {
    double sum = 0;
    cumulative_.reserve(mesh.triangles());
    for (std::size_t i = 0; i < mesh.triangles(); ++i) {
      const Corners t = corners(mesh, i);
      const DPoint3 a(mesh.positions[t.a]), b(mesh.positions[t.b]), c(mesh.positions[t.c]);
      sum += 0.5 * glm::length(glm::cross(b - a, c - a));
      cumulative_.push_back(sum);
    }
    for (const Point3& p : mesh.positions) bounds_.add(p);
    normals_ = coneOfNormals();
  }

  double area() const override { return cumulative_.empty() ? 0 : cumulative_.back(); }

  AreaSample sample(const DPoint3& from, Point2 u) const override {
    // The part of u.x that did not choose the triangle is uniform again within it.
    const double x = u.x * area();
    const auto chosen = std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, x);
    const double before = chosen == cumulative_.begin() ? 0 : *(chosen - 1);
    const auto rest = static_cast<float>((x - before) / (*chosen - before));
    const Corners t = corners(mesh_, static_cast<std::size_t>(chosen - cumulative_.begin()));
    const Point3 a = mesh_.positions[t.a], b = mesh_.positions[t.b], c = mesh_.positions[t.c];
    const Point2 w = uniformTriangle({std::clamp(rest, 0.F, kOneMinusEpsilon), u.y});

    AreaSample s;
    const float wc = 1 - w.x - w.y;
    s.p = DPoint3(a) * double(w.x) + DPoint3(b) * double(w.y) + DPoint3(c) * double(wc);
    const Plane plane = planeAt(t, w.x, w.y, wc);
    s.error = plane.error;
    s.n = plane.n;
    s.pdf = pdf(from, s.p, s.n);
    return s;
  }

  float pdf(const DPoint3& from, const DPoint3& p, const Normal3& n) const override {
    return uniformAreaPdf(from, p, n, area());
  }

  bool mayHit(const DPoint3& from, const DVec3& w) const override {
    double near = 0, far = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
      const double slack =
          1e-5 * (std::abs(from[i]) + std::abs(bounds_.lo[i]) + std::abs(bounds_.hi[i]));
      const double a = (bounds_.lo[i] - slack - from[i]) / w[i];
      const double b = (bounds_.hi[i] + slack - from[i]) / w[i];
      near = std::max(near, std::min(a, b));
      far = std::min(far, std::max(a, b));
    }
    return !(near > far);
  }
  DirectionCone normals() const override { return normals_; }

 private:
  // At a point of a triangle, the normal on the side that meshSurface() says, or the light would
  // shine to the other one.
  Plane planeAt(const Corners& t, float wa, float wb, float wc) const {
    Plane plane = planeOf(mesh_.positions[t.a], mesh_.positions[t.b], mesh_.positions[t.c]);
    const Normal3 ns = vertexNormal(mesh_, t, wa, wb, wc);
    plane.n = faceForward(flip_ ? -plane.n : plane.n, reverse_ ? -ns : ns);
    return plane;
  }

  // About the mean normal.
  DirectionCone coneOfNormals() const {
    DVec3 sum(0);
    for (std::size_t i = 0; i < mesh_.triangles(); ++i)
      sum += (cumulative_[i] - (i > 0 ? cumulative_[i - 1] : 0)) *
             DVec3(planeAt(corners(mesh_, i), 1 / 3.F, 1 / 3.F, 1 / 3.F).n);
    if (!(lengthSquared(sum) > 1e-6 * sqr(area()))) return {};
    DirectionCone cone{glm::normalize(sum), 1};
    // The side goes by the interpolated normal: if it is another one anywhere, then at a corner.
    for (std::size_t i = 0; i < mesh_.triangles(); ++i)
      for (int k = 0; k < 3; ++k) {
        const Normal3 n =
            planeAt(corners(mesh_, i), k == 0 ? 1 : 0, k == 1 ? 1 : 0, k == 2 ? 1 : 0).n;
        cone.cosine = std::min(cone.cosine, glm::dot(cone.axis, n));
      }
    return cone;
  }

  const TriangleMesh& mesh_;
  bool flip_, reverse_;
  std::vector<double> cumulative_;  // area of all triangles up to and including the i-th
  Bounds3 bounds_;
  DirectionCone normals_;
};

}  // namespace

void transformMesh(TriangleMesh& mesh, const Transform& toScene) {
  if (!toScene.isIdentity()) {
    for (Point3& p : mesh.positions) p = Point3(toScene.point(DPoint3(p)));
    for (Normal3& n : mesh.normals) n = Normal3(toScene.normal(DVec3(n)));
    for (Vec3& t : mesh.tangents) t = Vec3(toScene.vector(DVec3(t)));
  }
  for (Normal3& n : mesh.normals)
    if (const float l2 = lengthSquared(n); l2 > 0) n /= std::sqrt(l2);

  // A triangle without area has no normal, and rounding may let a ray hit it.
  std::size_t kept = 0;
  for (std::size_t i = 0; i < mesh.triangles(); ++i) {
    const Corners t = corners(mesh, i);
    if (planeOf(mesh.positions[t.a], mesh.positions[t.b], mesh.positions[t.c]).n == Normal3(0))
      continue;
    for (int k = 0; k < 3; ++k) mesh.indices[kept++] = mesh.indices[3 * i + k];
  }
  mesh.indices.resize(kept);
}

SurfaceInteraction meshSurface(const TriangleMesh& mesh, const Hit& hit, bool flip, bool reverse) {
  const Corners t = corners(mesh, hit.primitive);
  const Point3 a = mesh.positions[t.a], b = mesh.positions[t.b], c = mesh.positions[t.c];
  const float wb = hit.u, wc = hit.v, wa = 1 - wb - wc;
  const Vec3 ab = b - a, ac = c - a;

  SurfaceInteraction s;
  s.p = wa * a + wb * b + wc * c;
  const Plane plane = planeOf(a, b, c);
  s.error = plane.error;
  s.n = flip ? -plane.n : plane.n;

  const bool hasUv = !mesh.uv.empty();
  const Point2 uva = hasUv ? mesh.uv[t.a] : Point2(0, 0);
  const Point2 uvb = hasUv ? mesh.uv[t.b] : Point2(1, 0);
  const Point2 uvc = hasUv ? mesh.uv[t.c] : Point2(1, 1);
  s.uv = wa * uva + wb * uvb + wc * uvc;

  // p(u, v) is linear over the triangle: solve ab = dpdu du1 + dpdv dv1, ac = dpdu du2 + dpdv dv2;
  // the normals' derivatives follow by the same inverse.
  const Vec2 d1 = uvb - uva, d2 = uvc - uva;
  const float determinant = d1.x * d2.y - d1.y * d2.x;
  const bool solvable = std::abs(determinant) > 1e-12F * (lengthSquared(d1) + lengthSquared(d2));
  const float inverse = solvable ? 1 / determinant : 0;
  if (solvable) {
    s.dpdu = (d2.y * ab - d1.y * ac) * inverse;
    s.dpdv = (d1.x * ac - d2.x * ab) * inverse;
  } else {
    const Frame frame = Frame::fromZ(s.n);
    s.dpdu = frame.x;
    s.dpdv = frame.y;
  }

  s.ns = s.n;
  const Normal3 ns = vertexNormal(mesh, t, wa, wb, wc);
  if (const float l2 = lengthSquared(ns); l2 > 0) {
    const float scale = (reverse ? -1 : 1) / std::sqrt(l2);
    s.ns = ns * scale;
    s.n = faceForward(s.n, s.ns);
    if (solvable) {
      // Of a vector's direction only the part across it counts: d(n / |n|) = (dn)_across / |n|.
      const Normal3 nab = mesh.normals[t.b] - mesh.normals[t.a];
      const Normal3 nac = mesh.normals[t.c] - mesh.normals[t.a];
      const auto across = [&](const Normal3& dn) { return dn - glm::dot(dn, s.ns) * s.ns; };
      s.dndu = across((d2.y * nab - d1.y * nac) * (inverse * scale));
      s.dndv = across((d1.x * nac - d2.x * nab) * (inverse * scale));
    }
  }
  s.tangent = s.dpdu;
  if (!mesh.tangents.empty())
    s.tangent = wa * mesh.tangents[t.a] + wb * mesh.tangents[t.b] + wc * mesh.tangents[t.c];
  return s;
}

std::unique_ptr<AreaSampler> meshSampler(const TriangleMesh& mesh, bool flip, bool reverse) {
  auto sampler = std::make_unique<MeshSampler>(mesh, flip, reverse);
  if (!(sampler->area() > 0)) return nullptr;
  return sampler;
}

}  // namespace pbrt
