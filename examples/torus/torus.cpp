// A torus about the z axis, a tube whose middle is a circle:
//   (sqrt(x^2 + y^2) - major)^2 + z^2 = minor^2.

#include <array>

#include "core/plugin/plugin.h"

using namespace pbrt;

static constexpr double kTurn = 2 * std::numbers::pi;

// The real roots of s^3 + p s + q, ascending, by Viete's formula; if there is but one, that thrice.
static std::array<double, 3> cubicRoots(double p, double q) {
  const double discriminant = sqr(q / 2) + p * p * p / 27;
  if (discriminant >= 0) {
    const double u = -std::cbrt(q / 2 + std::copysign(std::sqrt(discriminant), q));
    const double s = u != 0 ? u - p / (3 * u) : 0;
    return {s, s, s};
  }
  const double m = std::sqrt(-p / 3), angle = std::acos(std::clamp(-q / 2 / (m * m * m), -1., 1.));
  const auto root = [&](int i) { return 2 * m * std::cos((angle + i * kTurn) / 3); };
  return {root(1), root(-1), root(0)};
}

class Torus final : public Shape {
 public:
  explicit Torus(Params& p)
      : major_(p.positive("majorradius", 1, "of the middle of the tube", "scene units")),
        minor_(p.positive("minorradius", 0.25F, "of the tube", "scene units")) {
    if (!(minor_ < major_ && minor_ > 1e-6 * major_))
      p.fail("minorradius", "must be below majorradius, and above a millionth of it");
  }
  Bounds3 bounds(std::uint32_t) const override { return roundOutward(-corner_, corner_); }

  std::optional<ShapeHit> intersect(const ObjectRay& ray, std::uint32_t) const override {
    // The line by its distance s from its point o that is nearest to the centre: p = o + s d, so
    // that nothing cancels from afar. A sphere about the torus says how far to look.
    const double length = glm::length(ray.d), middle = -glm::dot(ray.o, ray.d) / sqr(length);
    const DVec3 d = ray.d / length, o = ray.at(middle);
    const double m2 = sqr(major_), r2 = sqr(minor_), o2 = lengthSquared(o);
    const double reach = std::sqrt(std::max(0., sqr(corner_.x) - o2));
    double t = std::max(ray.tMin, middle - reach / length);
    const double last = std::min(ray.tMax, middle + reach / length);
    if (!(reach > 0 && t < last)) return {};
    // Squared, the equation is (|p|^2 + major^2 - minor^2)^2 - 4 major^2 (x^2 + y^2) = 0. Between
    // the roots of the derivative this rises or falls, so that no crossing is missed.
    const auto turns = cubicRoots(o2 + m2 - r2 - 2 * m2 * (d.x * d.x + d.y * d.y),
                                  -2 * m2 * (o.x * d.x + o.y * d.y));
    bool out = distance(ray, t).x > 0;
    for (const double s : {turns[0], turns[1], turns[2], reach}) {
      const double next = std::clamp(middle + s / length, t, last);
      if ((distance(ray, next).x > 0) != out) {
        const double hit = crossing(ray, t, next, out);
        if (hit > ray.tMin) return ShapeHit{float(hit), float(hit - float(hit))};
        out = !out;
      }
      t = next;
    }
    return {};  // a hit's u keeps what its t loses
  }

  SurfacePoint surface(const ObjectRay& ray, const ShapeHit& hit) const override {
    const DPoint3 p = ray.at(double{hit.t} + hit.u);
    const double rho = std::sqrt(p.x * p.x + p.y * p.y);
    const DVec3 away(p.x / rho, p.y / rho, 0), up(0, 0, 1), east(-away.y, away.x, 0);
    const glm::dvec2 n2 = glm::normalize(glm::dvec2(rho - major_, p.z));  // along away and up
    const DVec3 n = n2.x * away + n2.y * up, dndu = kTurn * n2.x * east;
    const DVec3 dndv = kTurn * (n2.x * up - n2.y * away), q = major_ * away + minor_ * n;
    const auto turn = [](double y, double x) { return std::atan2(y, x) / kTurn + (y < 0 ? 1 : 0); };
    const Point2 uv(turn(p.y, p.x), turn(n2.y, n2.x));
    const DVec3 dpdu = kTurn * major_ * east + minor_ * dndu;
    return {q, 4e-15 * major_, n, Normal3(0), uv, dpdu, minor_ * dndv, dndu, dndv};
  }

 private:
  // How far the ray is off the tube at t, below zero within, and how that changes with t.
  glm::dvec2 distance(const ObjectRay& ray, double t) const {
    const DPoint3 p = ray.at(t);
    const double rho = std::sqrt(p.x * p.x + p.y * p.y), off = rho - major_;
    const double tube = std::sqrt(off * off + p.z * p.z);
    return {tube - minor_, (off / rho * (p.x * ray.d.x + p.y * ray.d.y) + p.z * ray.d.z) / tube};
  }
  // Where the ray comes in (or out) between a and b: Newton's steps, halves where those go astray.
  double crossing(const ObjectRay& ray, double a, double b, bool in) const {
    double t = 0.5 * (a + b);
    for (int i = 0; i < 100 && a < t && t < b; ++i) {
      const glm::dvec2 at = distance(ray, t);
      ((at.x > 0) == in ? a : b) = t;
      const double next = t - at.x / at.y;
      if (next == t) break;
      t = next > a && next < b ? next : 0.5 * (a + b);
    }
    return t;
  }
  double major_, minor_;
  DVec3 corner_{major_ + minor_, major_ + minor_, minor_};
};

PBRT_PLUGIN(Shape, Torus, "torus", "a ring: a tube about a circle")
