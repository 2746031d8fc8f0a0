// Hairs, blades of grass, ribbons: strips about cubic Bezier curves. Those of the types flat and
// cylinder face every ray.

#include <fmt/format.h>

#include "core/plugin/mesh_params.h"
#include "core/plugin/plugin.h"
#include "shapes/curve/search.h"

namespace pbrt::curve {

namespace {

constexpr std::array<std::string_view, 2> kBases{"bezier", "bspline"};
constexpr std::array<std::string_view, 3> kTypes{"flat", "cylinder", "ribbon"};

// Uniform B-splines and quadratic pieces as cubic Bezier curves, which they are.
Bezier cubic(const Point3* given, bool bspline, int degree) {
  std::array<DVec3, 4> p{};
  for (int i = 0; i <= degree; ++i) p[i] = DVec3(given[i]);
  if (degree == 3) {
    if (!bspline) return p;
    return {(p[0] + 4.0 * p[1] + p[2]) / 6.0, (2.0 * p[1] + p[2]) / 3.0, (p[1] + 2.0 * p[2]) / 3.0,
            (p[1] + 4.0 * p[2] + p[3]) / 6.0};
  }
  if (bspline) p[0] = 0.5 * (p[0] + p[1]), p[2] = 0.5 * (p[1] + p[2]);
  return {p[0], (p[0] + 2.0 * p[1]) / 3.0, (2.0 * p[1] + p[2]) / 3.0, p[2]};
}

}  // namespace

class Curve final : public Shape {
 public:
  explicit Curve(Params& p) {
    const std::vector<Point3> points = p.points("P", "control points");
    p.require("P");
    const bool bspline =
        p.choice("basis", kBases, "bezier", "what the points control") == "bspline";
    const auto degree = static_cast<std::size_t>(p.integer("degree", 3, 2, 3, "of the curve"));
    const std::string type = p.choice("type", kTypes, "flat", "what it looks like from near");
    const float width = p.nonNegative("width", 1, "width", "scene units");
    const float first = p.nonNegative("width0", width, "width where it begins", "scene units");
    const float last = p.nonNegative("width1", width, "width where it ends", "scene units");
    const std::vector<Normal3> normals =
        p.normals("N", "normals of a ribbon: one at the ends of each segment");
    depth_ = static_cast<int>(p.inRange("splitdepth", 3, 0, 16, "segments are halved as often"));
    if (p.describing()) return;
    ribbon_ = type == "ribbon", tube_ = type == "cylinder";

    checkVertices(p, "P", points, points.size());
    const std::size_t step = bspline ? 1 : degree;
    if (points.size() <= degree || (points.size() - 1 - degree) % step != 0)
      p.fail("P",
             fmt::format("has {} points; a {} of degree {} needs {} and {} for each segment more",
                         points.size(), bspline ? "bspline" : "bezier", degree, degree + 1, step));
    if (!(std::max(first, last) > 0)) p.fail("width", "must not be 0 at both ends");
    const std::size_t count = (points.size() - 1 - degree) / step + 1;
    if (count > std::size_t{1} << (31 - depth_)) p.fail("splitdepth", "makes too many pieces");
    if (ribbon_) checkNormals(p, normals, count);
    if (!ribbon_ && p.has("N")) p.warn("N", "is read, but only ribbons have normals of their own");
    for (std::size_t i = 0; i < count; ++i) {
      Segment s{cubic(&points[i * step], bspline, static_cast<int>(degree))};
      for (std::size_t end = 0; end < 2; ++end) {
        s.half[end] = 0.5 * mix(double(i + end) / double(count), double(first), double(last));
        if (ribbon_) s.normal[end] = glm::normalize(DVec3(normals[i + end]));
      }
      if (ribbon_) s.turn = angleBetween(s.normal[0], s.normal[1]);
      segments_.push_back(s);
    }
  }

  std::uint32_t primitives() const override {
    return static_cast<std::uint32_t>(segments_.size() << depth_);
  }
  Bounds3 bounds(std::uint32_t primitive) const override {
    const Segment& s = segmentOf(primitive);
    const auto [u0, u1] = rangeOf(primitive);
    const Bezier b = part(s.points, u0, u1);
    const double h = std::max(s.halfWidth(u0), s.halfWidth(u1));
    return roundOutward(glm::min(glm::min(b[0], b[1]), glm::min(b[2], b[3])) - h,
                        glm::max(glm::max(b[0], b[1]), glm::max(b[2], b[3])) + h);
  }
  std::optional<ShapeHit> intersect(const ObjectRay& ray, std::uint32_t primitive) const override {
    const auto [u0, u1] = rangeOf(primitive);
    return Search(segmentOf(primitive), ray, !ribbon_).nearest(u0, u1, primitive);
  }

  SurfacePoint surface(const ObjectRay& ray, const ShapeHit& hit) const override {
    const Segment& segment = segmentOf(hit.primitive);
    const double u = double{hit.u} + hit.v, h = segment.halfWidth(u);
    const CurvePoint c = evaluate(segment.points, u);
    const DVec3 d = glm::normalize(ray.d);
    const Turning turning = ribbon_ ? normalAt(segment.normal, segment.turn, u) : Turning{d};
    const DVec3 across = glm::cross(turning.n, c.tangent);
    const double length = glm::length(across);
    const DVec3 e = across / length;
    const DVec3 away = ray.o - c.p, flat = e - glm::dot(e, d) * d;
    const double a = std::clamp(glm::dot(away, flat) / lengthSquared(flat), -h, h);

    // With g = N x c' and e = g / |g|: e' is what is across e of g' / |g|, and e'' that of
    // (g'' - 2 |g|' e') / |g|, but for what is along e. N'' is -turn^2 N.
    const DVec3 g1 =
        (glm::cross(turning.derivative, c.tangent) + glm::cross(turning.n, c.bend)) / length;
    const DVec3 g2 =
        (glm::cross(-sqr(segment.turn) * turning.n, c.tangent) +
         2.0 * glm::cross(turning.derivative, c.bend) + glm::cross(turning.n, c.third)) /
        length;
    const DVec3 turned = g1 - glm::dot(g1, e) * e;
    const DVec3 turnedTwice = g2 - 2 * glm::dot(g1, e) * turned;
    const double side = ribbon_ ? 1 : -1;
    const DVec3 t = glm::normalize(c.tangent), middle = side * glm::cross(t, e);

    SurfacePoint s;
    // What faces the ray is met where this is nearest to c, also where e is doubtful, as the curve
    // runs along the ray.
    s.p = c.p + (ribbon_ ? a * e : away - glm::dot(away, d) * d);
    s.uv = Point2(u, 0.5 + (h > 0 ? 0.5 * a / h : 0));
    DVec3 n, dndu(0), dndv(0);
    if (tube_) {
      // As pbrt has it: the front half of a tube, whose normal turns evenly over the width.
      const double theta = (double{s.uv.y} - 0.5) * std::numbers::pi;
      const DVec3 round = std::cos(theta) * e - std::sin(theta) * middle;
      const DVec3 bend = (c.bend - glm::dot(c.bend, t) * t) / glm::length(c.tangent);
      n = std::cos(theta) * middle + std::sin(theta) * e;
      dndu = std::cos(theta) * side * (glm::cross(bend, e) + glm::cross(t, turned)) +
             std::sin(theta) * turned;
      dndv = std::numbers::pi * round;
      s.dpdu = c.tangent, s.dpdv = 2 * h * round;
    } else {
      const double widening = h > 0 ? a / h * (segment.half[1] - segment.half[0]) : 0;
      const DVec3 dpdu = c.tangent + a * turned + widening * e;
      n = glm::cross(dpdu, e);
      const double size = std::copysign(glm::length(n), glm::dot(n, middle));  // folds turn it over
      n = size != 0 ? n / size : middle;
      if (size != 0) {
        dndu = (glm::cross(c.bend + 2 * widening * turned + a * turnedTwice, e) +
                glm::cross(dpdu, turned)) /
               size;
        dndv = 2 * h * glm::cross(turned, e) / size;
      }
      s.dpdu = dpdu, s.dpdv = 2 * h * e;
    }
    s.n = n;
    s.dndu = dndu - glm::dot(dndu, n) * n;
    s.dndv = dndv - glm::dot(dndv, n) * n;
    // Other rays meet the strip elsewhere, if it faces them, but within the tube of radius h about
    // c: who leaves p starts beyond the tube, at its tangent plane. (n is rounded to floats.)
    const DVec3 reach = glm::abs(c.p) + h;
    s.error = 1e-14 * (reach.x + reach.y + reach.z);
    if (!ribbon_) s.error += (1 + 1e-6) * (h + std::abs(a * glm::dot(e, n)));
    return s;
  }

 private:
  const Segment& segmentOf(std::uint32_t primitive) const { return segments_[primitive >> depth_]; }
  std::array<double, 2> rangeOf(std::uint32_t primitive) const {
    const double pieces = double(1U << depth_), i = primitive & ((1U << depth_) - 1);
    return {i / pieces, (i + 1) / pieces};
  }

  static double angleBetween(const DVec3& a, const DVec3& b) {
    return 2 * std::atan2(glm::length(a - b), glm::length(a + b));  // Kahan 2006
  }
  static void checkNormals(const Params& p, const std::vector<Normal3>& normals,
                           std::size_t segments) {
    if (!p.has("N")) p.fail("N", "is missing: a ribbon needs normals");
    checkVertices(p, "N", normals, segments + 1);
    for (std::size_t i = 0; i <= segments; ++i) {
      if (normals[i] == Normal3(0)) p.fail("N", fmt::format("is 0 at number {}", i));
      if (i > 0 && !(angleBetween(glm::normalize(DVec3(normals[i - 1])),
                                  glm::normalize(DVec3(normals[i]))) < 3.14))
        p.fail("N", fmt::format("turns by 180 degrees from number {} to {}, which says not how",
                                i - 1, i));
    }
  }

  bool ribbon_ = false, tube_ = false;
  int depth_ = 0;
  std::vector<Segment> segments_;
};

}  // namespace pbrt::curve

PBRT_PLUGIN(Shape, pbrt::curve::Curve, "curve",
            "a hair, a blade of grass or a ribbon along a curve")
