// Bilinear patches: four corners each, and between them straight lines both ways. A parallelogram
// if the corners are one, else a hyperbolic paraboloid.

#include <array>
#include <bit>
#include <mutex>

#include "core/base/rng.h"
#include "core/base/warp.h"
#include "core/plugin/mesh_params.h"
#include "core/plugin/plugin.h"

namespace pbrt {

namespace {

template <class V>
V mix(double t, const V& a, const V& b) {
  return (1 - t) * a + t * b;
}

// P(u, v) and what is like it: the corners in the order (0, 0), (1, 0), (0, 1), (1, 1).
template <class V>
struct Bilinear {
  std::array<V, 4> at;

  V operator()(double u, double v) const {
    return mix(v, mix(u, at[0], at[1]), mix(u, at[2], at[3]));
  }
  V du(double v) const { return mix(v, at[1] - at[0], at[3] - at[2]); }
  V dv(double u) const { return mix(u, at[2] - at[0], at[3] - at[1]); }
  V dudv() const { return (at[0] - at[1]) - (at[2] - at[3]); }
};
using Patch = Bilinear<DPoint3>;

DVec3 normal(const Patch& p, double u, double v) {
  return glm::cross(p.du(v), p.dv(u));
}

struct Root {
  double t = std::numeric_limits<double>::quiet_NaN(), u = 0, v = 0;
};

double determinant(const DVec3& a, const DVec3& b, const DVec3& c) {
  return glm::dot(a, glm::cross(b, c));
}

// Where a line crosses the patch (Reshetov 2019, "Cool Patches: A Geometric Approach to
// Ray/Bilinear Patch Intersections"): the line and the patch's line of constant u have no volume
// between them, which is quadratic in u. NaN where there is none.
std::array<Root, 2> crossings(const Patch& patch, const ObjectRay& ray) {
  const auto& [p00, p10, p01, p11] = patch.at;
  const DVec3& d = ray.d;
  // From afar t begins at the point nearest to the patch, so that nothing large cancels.
  const DPoint3 centre = patch(0.5, 0.5);
  const double size2 = std::max(lengthSquared(p11 - p00), lengthSquared(p10 - p01));
  double start = glm::dot(centre - ray.o, d) / lengthSquared(d);
  if (start * start * lengthSquared(d) <= size2) start = 0;
  const DPoint3 o = ray.at(start);

  const double c = determinant(p00 - o, d, p01 - p00);
  const double a = glm::dot(glm::cross(p10 - p00, p01 - p11), d);
  const double b = (determinant(p10 - o, d, p11 - p10) - a - c) / 2;
  const double discriminant = b * b - a * c;
  std::array<Root, 2> roots;
  if (!(discriminant >= 0)) return roots;
  const double q = -b - std::copysign(std::sqrt(discriminant), b);
  // A flat patch has one crossing: the other u is infinite, or 0 / 0.
  const std::array<double, 2> us{q / a, c / q};
  // Neighbours share their sides: what rounding puts just beyond one still counts.
  constexpr double kSlack = 1e-12;
  const auto within = [](double x) { return x >= -kSlack && x <= 1 + kSlack; };
  for (int i = 0; i < 2; ++i) {
    const double u = us[i];
    if (!within(u)) continue;
    const DPoint3 from = mix(u, p00, p10);
    const DVec3 along = mix(u, p01, p11) - from, across = glm::cross(d, along);
    const double v = determinant(from - o, d, across) / lengthSquared(across);
    if (!within(v)) continue;
    const double t = determinant(from - o, along, across) / lengthSquared(across);
    roots[i] = {start + t, std::clamp(u, 0.0, 1.0), std::clamp(v, 0.0, 1.0)};
  }
  return roots;
}

}  // namespace

class BilinearMesh final : public Shape, public AreaSampler {
 public:
  explicit BilinearMesh(Params& p) : positions_(p.points("P", "positions of the vertices")) {
    p.require("P");
    indices_ = readIndices(p, 4, positions_.size());
    uv_ = p.points2("uv", "texture coordinates of the vertices");
    normals_ = p.normals("N", "shading normals of the vertices");
    p.integers("faceIndices", "each face's number in a Ptex file; not used, as there is no Ptex");
    if (!p.text("emissionfilename", "", "picture of what shines; not known yet").empty())
      p.warn("emissionfilename", "is not known yet: the shape shines evenly");
    if (p.describing()) return;
    checkVertices(p, "P", positions_, positions_.size());
    checkVertices(p, "uv", uv_, positions_.size());
    checkVertices(p, "N", normals_, positions_.size());
    for (std::uint32_t i = 0; i < primitives(); ++i) box_.add(bounds(i));
  }

  std::uint32_t primitives() const override {
    return static_cast<std::uint32_t>(indices_.size() / 4);
  }
  Bounds3 bounds(std::uint32_t primitive) const override {
    Bounds3 box;
    for (const DPoint3& corner : patch(primitive).at) box.add(Point3(corner));
    return box;
  }

  std::optional<ShapeHit> intersect(const ObjectRay& ray, std::uint32_t primitive) const override {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Root& root : crossings(patch(primitive), ray))
      if (root.t > ray.tMin && root.t <= ray.tMax) nearest = std::min(nearest, root.t);
    if (std::isinf(nearest)) return {};
    return ShapeHit{float(nearest), 0, 0, primitive};
  }

  SurfacePoint surface(const ObjectRay& ray, const ShapeHit& hit) const override {
    const auto [a, b] = crossings(patch(hit.primitive), ray);
    const double apart = std::abs(a.t - hit.t);  // NaN if there is no such crossing
    const Root& root = apart <= std::abs(b.t - hit.t) || std::isnan(b.t) ? a : b;
    return at(hit.primitive, root.u, root.v);
  }

  const AreaSampler* areaSampler() const override {
    std::call_once(measured_, [&] {
      double sum = 0;
      for (std::uint32_t i = 0; i < primitives(); ++i)
        cumulative_.push_back(sum += patchArea(patch(i)));
    });
    return area() > 0 ? this : nullptr;
  }
  double area() const override { return cumulative_.empty() ? 0 : cumulative_.back(); }
  AreaSample sample(const DPoint3& from, Point2 u) const override {
    const double x = u.x * area();
    const auto chosen = std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, x);
    const double before = chosen == cumulative_.begin() ? 0 : *(chosen - 1);
    const auto primitive = static_cast<std::uint32_t>(chosen - cumulative_.begin());
    const Patch p = patch(primitive);
    // Uniform in (u, v) is denser where the patch is narrow: such points are kept as often as they
    // stand for area, or drawn again. Of a parallelogram the first is kept.
    double most = 0;  // of a convex function: in a corner
    for (const double v : {0.0, 1.0})
      for (const double w : {0.0, 1.0}) most = std::max(most, glm::length(normal(p, v, w)));
    glm::dvec2 uv((x - before) / (*chosen - before), u.y);
    Rng rng(hash(std::bit_cast<std::uint32_t>(u.x), std::bit_cast<std::uint32_t>(u.y)));
    while (rng.uniform() * most > glm::length(normal(p, uv.x, uv.y)))
      uv = {rng.uniform(), rng.uniform()};
    const SurfacePoint s = at(primitive, uv.x, uv.y);
    return {s.p, s.error, s.n, uniformAreaPdf(from, s.p, s.n, area())};
  }
  float pdf(const DPoint3& from, const DPoint3& p, const Normal3& n) const override {
    return uniformAreaPdf(from, p, n, area());
  }
  bool mayHit(const DPoint3& from, const DVec3& w) const override {
    double near = 0, far = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
      const double slack = 1e-9 * (std::abs(from[i]) + std::abs(box_.lo[i]) + std::abs(box_.hi[i]));
      const double a = (box_.lo[i] - slack - from[i]) / w[i];
      const double b = (box_.hi[i] + slack - from[i]) / w[i];
      near = std::max(near, std::min(a, b));
      far = std::min(far, std::max(a, b));
    }
    return !(near > far);
  }

 private:
  // The values of a patch's vertices.
  template <class To, class From>
  Bilinear<To> corners(const std::vector<From>& values, std::uint32_t primitive) const {
    const std::uint32_t* i = &indices_[4 * std::size_t{primitive}];
    return {{To(values[i[0]]), To(values[i[1]]), To(values[i[2]]), To(values[i[3]])}};
  }
  Patch patch(std::uint32_t primitive) const { return corners<DPoint3>(positions_, primitive); }

  // The integral of |dP/du x dP/dv|, by Simpson's rule over cells.
  static double patchArea(const Patch& p) {
    constexpr int kCells = 16;
    double sum = 0;
    for (int j = 0; j <= 2 * kCells; ++j)
      for (int i = 0; i <= 2 * kCells; ++i) {
        const auto weight = [](int k) { return k == 0 || k == 2 * kCells ? 1 : k % 2 ? 4 : 2; };
        sum +=
            weight(i) * weight(j) * glm::length(normal(p, i / (2.0 * kCells), j / (2.0 * kCells)));
      }
    return sum / sqr(6.0 * kCells);
  }

  SurfacePoint at(std::uint32_t primitive, double u, double v) const {
    const Patch patch = this->patch(primitive);
    const DPoint3 p = patch(u, v);
    const DVec3 dpdu = patch.du(v), dpdv = patch.dv(u), bend = patch.dudv();
    DVec3 n = glm::cross(dpdu, dpdv);
    double length = glm::length(n);
    // In a corner where two corners are one: the normal of its neighbourhood.
    if (!(length > 0)) n = normal(patch, mix(1e-6, u, 0.5), mix(1e-6, v, 0.5));
    n = lengthSquared(n) > 0 ? glm::normalize(n) : DVec3(0, 0, 1);
    // Of a vector's direction only the part across it counts: d(n / |n|) = (dn)_across / |n|.
    const auto across = [](const DVec3& dn, const DVec3& unit, double size) {
      return size > 0 ? (dn - glm::dot(dn, unit) * unit) / size : DVec3(0);
    };
    DVec3 dndu = across(glm::cross(dpdu, bend), n, length);
    DVec3 dndv = across(glm::cross(bend, dpdv), n, length);

    SurfacePoint s;
    s.p = p;
    const auto& [a, b, c, d] = patch.at;
    const DVec3 largest =
        glm::max(glm::max(glm::abs(a), glm::abs(b)), glm::max(glm::abs(c), glm::abs(d)));
    s.error = 1e-14 * (largest.x + largest.y + largest.z);
    s.uv = {u, v};
    if (!normals_.empty()) {
      const auto given = corners<DVec3>(normals_, primitive);
      const DVec3 ns = given(u, v);
      if (const double size = glm::length(ns); size > 0) {
        s.ns = ns / size;
        if (glm::dot(n, ns) < 0) n = -n;
        dndu = across(given.du(v), ns / size, size);
        dndv = across(given.dv(u), ns / size, size);
      }
    }
    s.n = n;
    s.dpdu = dpdu, s.dpdv = dpdv, s.dndu = dndu, s.dndv = dndv;
    if (!uv_.empty()) {
      // By the given coordinates (s, t): the inverse of d(s, t) / d(u, v).
      const auto given = corners<glm::dvec2>(uv_, primitive);
      s.uv = given(u, v);
      const glm::dvec2 du = given.du(v), dv = given.dv(u);
      if (const double area = du.x * dv.y - du.y * dv.x; std::abs(area) > 0) {
        s.dpdu = (dv.y * dpdu - du.y * dpdv) / area;
        s.dpdv = (du.x * dpdv - dv.x * dpdu) / area;
        s.dndu = (dv.y * dndu - du.y * dndv) / area;
        s.dndv = (du.x * dndv - dv.x * dndu) / area;
      }
    }
    return s;
  }

  std::vector<Point3> positions_;
  std::vector<std::uint32_t> indices_;
  std::vector<Point2> uv_;
  std::vector<Normal3> normals_;
  // Made when the shape shines: area of all patches up to and including the i-th.
  mutable std::vector<double> cumulative_;
  mutable std::once_flag measured_;
  Bounds3 box_;
};

}  // namespace pbrt

PBRT_PLUGIN(Shape, pbrt::BilinearMesh, "bilinearmesh", "curved patches between four corners each")
