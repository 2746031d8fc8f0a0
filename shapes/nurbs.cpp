// A NURBS patch, as a fixed grid of triangles with the normals of the true surface.
//
// Piegl and Tiller 1997, "The NURBS Book" (2nd edition): basis functions (2.5), their derivatives
// (2.7), derivatives of rational surfaces (4.20).

#include <fmt/format.h>

#include "core/plugin/plugin.h"

namespace pbrt {

namespace {

// One parametric direction.
struct Axis {
  int count = 0;  // of control points
  int order = 0;  // degree + 1
  std::vector<float> knots;
  double begin = 0, end = 0;  // the part that is drawn

  double at(double s) const { return (1 - s) * begin + s * end; }
};

Axis readAxis(Params& p, const std::string& u) {
  Axis axis;
  const std::string count = "n" + u, order = u + "order", knots = u + "knots";
  axis.count = p.integer(count, 2, 2, 1 << 20, "control points along " + u);
  axis.order = p.integer(order, 2, 2, 32, "degree along " + u + ", plus one");
  axis.knots = p.numbers(knots, "knots along " + u + ": points plus order, never falling");
  for (const std::string& name : {count, order, knots}) p.require(name);
  if (p.describing()) axis.knots = {0, 0, 1, 1};

  const auto n = static_cast<std::size_t>(axis.count), k = static_cast<std::size_t>(axis.order);
  if (k > n) p.fail(order, fmt::format("needs as many control points, but {} is {}", count, n));
  if (axis.knots.size() != n + k)
    p.fail(knots, fmt::format("has {} numbers; {} plus {} are {}", axis.knots.size(), count, order,
                              n + k));
  if (!std::is_sorted(axis.knots.begin(), axis.knots.end())) p.fail(knots, "must never fall");
  const float lo = axis.knots[k - 1], hi = axis.knots[n];
  if (!(lo < hi)) p.fail(knots, "leave no range in which the patch is defined");
  axis.begin = p.inRange(u + "0", lo, lo, hi,
                         "where the patch begins along " + u + ", in the numbers of " + knots +
                             "; all of it if absent");
  axis.end = p.inRange(u + "1", hi, lo, hi, "where it ends along " + u + ", likewise");
  if (!(axis.begin < axis.end)) p.fail(u + "1", "must be above " + u + "0");
  return axis;
}

// The basis functions that are not zero at a parameter, and their derivatives.
struct Basis {
  int first = 0;  // the control point of the first of them
  std::vector<double> value, derivative;
};

Basis evaluate(const Axis& axis, double t) {
  const std::vector<float>& knots = axis.knots;
  const int degree = axis.order - 1;
  // The span knots[span] <= t < knots[span + 1]; at the very end the last one that is not empty.
  const auto above = std::upper_bound(knots.begin() + degree, knots.begin() + axis.count, t);
  auto span = static_cast<int>(above - knots.begin()) - 1;
  while (knots[span] == knots[span + 1]) --span;

  // Cox and de Boor, one degree at a time. No denominator vanishes: each is at least as long as
  // the span.
  Basis basis{span - degree, {1}, {}};
  for (int k = 1; k <= degree; ++k) {
    std::vector<double> value(k + 1), derivative(k + 1);
    for (int i = 0; i < k; ++i) {
      const double lo = knots[span - k + 1 + i], hi = knots[span + 1 + i];
      const double part = basis.value[i] / (hi - lo);
      value[i] += (hi - t) * part;
      value[i + 1] += (t - lo) * part;
      derivative[i] -= k * part;
      derivative[i + 1] += k * part;
    }
    basis.value = std::move(value);
    basis.derivative = std::move(derivative);
  }
  return basis;
}

struct Patch {
  Axis u, v;
  std::vector<glm::dvec4> points;  // weighted; u runs fastest

  struct At {
    DPoint3 p;
    DVec3 normal;  // dpdu x dpdv
  };
  At at(const Basis& bu, const Basis& bv) const {
    glm::dvec4 s(0), su(0), sv(0);
    for (std::size_t j = 0; j < bv.value.size(); ++j)
      for (std::size_t i = 0; i < bu.value.size(); ++i) {
        const std::size_t row = static_cast<std::size_t>(bv.first) + j;
        const glm::dvec4& c = points[row * u.count + bu.first + i];
        s += bu.value[i] * bv.value[j] * c;
        su += bu.derivative[i] * bv.value[j] * c;
        sv += bu.value[i] * bv.derivative[j] * c;
      }
    const DPoint3 p = DVec3(s) / s.w;
    return {p, glm::cross((DVec3(su) - su.w * p) / s.w, (DVec3(sv) - sv.w * p) / s.w)};
  }
};

std::vector<glm::dvec4> readPoints(Params& p, const Axis& u, const Axis& v) {
  const std::vector<Point3> plain = p.points("P", "control points, u running fastest");
  const std::vector<float> weighted = p.numbers("Pw", "instead of P: x w, y w, z w and w of each");
  if (p.describing()) return {};
  std::vector<glm::dvec4> points;
  for (const Point3& c : plain) points.emplace_back(c, 1);
  if (plain.empty()) {
    p.require("Pw");
    for (std::size_t i = 0; i + 3 < weighted.size(); i += 4) {
      points.emplace_back(weighted[i], weighted[i + 1], weighted[i + 2], weighted[i + 3]);
      if (!(points.back().w > 0)) p.fail("Pw", fmt::format("has a weight of {}", points.back().w));
    }
  }
  const std::size_t n = static_cast<std::size_t>(u.count) * v.count;
  if (points.size() != n || (plain.empty() && weighted.size() != 4 * n))
    p.fail(plain.empty() ? "Pw" : "P", fmt::format("must be {} points (nu times nv)", n));
  return points;
}

}  // namespace

class Nurbs final : public MeshShape {
 public:
  explicit Nurbs(Params& p) {
    Patch patch{readAxis(p, "u"), readAxis(p, "v"), {}};
    patch.points = readPoints(p, patch.u, patch.v);
    if (p.describing()) return;

    for (std::uint32_t j = 0; j < kGrid; ++j)
      for (std::uint32_t i = 0; i < kGrid; ++i)
        addVertex(patch, i / (kGrid - 1.0), j / (kGrid - 1.0));
    for (std::uint32_t j = 0; j + 1 < kGrid; ++j)
      for (std::uint32_t i = 0; i + 1 < kGrid; ++i) {
        const std::uint32_t a = j * kGrid + i, b = a + 1, c = b + kGrid, d = a + kGrid;
        mesh_.indices.insert(mesh_.indices.end(), {a, b, c, a, c, d});
      }
  }

 private:
  static constexpr std::uint32_t kGrid = 30;  // vertices along each side

  // (s, t) in [0, 1]^2 over the part that is drawn.
  void addVertex(const Patch& patch, double s, double t) {
    const auto at = [&](double x, double y) {
      return patch.at(evaluate(patch.u, patch.u.at(x)), evaluate(patch.v, patch.v.at(y)));
    };
    const Patch::At here = at(s, t);
    // Where an edge shrinks to a point, the normal is that of its neighbourhood.
    DVec3 normal = here.normal;
    if (lengthSquared(normal) < 1e-20 * lengthSquared(at(0.5, 0.5).normal))
      normal = at(s + 1e-4 * (0.5 - s), t + 1e-4 * (0.5 - t)).normal;
    const double length = glm::length(normal);
    mesh_.positions.emplace_back(here.p);
    mesh_.normals.emplace_back(length > 0 ? normal / length : normal);
    mesh_.uv.emplace_back(patch.u.at(s), patch.v.at(t));
  }
};

}  // namespace pbrt

PBRT_PLUGIN(Shape, pbrt::Nurbs, "nurbs",
            "a smooth curved patch, pulled into form by a net of control points")
