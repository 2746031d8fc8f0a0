// A unit sphere with one flaw.

#include <array>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "core/base/rng.h"
#include "core/base/warp.h"
#include "core/plugin/plugin.h"

namespace {

using namespace pbrt;

constexpr std::array kFlaws = std::to_array<std::string_view>(
    {"none",
     // of bounds(), intersect(), occluded()
     "tight-bounds", "infinite-bounds", "nowhere", "late-hits", "other-primitive", "loses-hits",
     "no-shadow", "behind", "beyond", "not-a-number",
     // of surface()
     "off-the-surface", "no-error", "huge-error", "long-normal", "turned-normal", "inside-out",
     "wild-uv", "tiled-uv", "no-uv", "half-derivatives", "wrong-curvature", "inward-shading",
     "sinks",
     // as an object
     "shared", "counts", "differs", "allocates", "dark-colour",
     // of its area
     "wrong-area", "wrong-pdf", "wrong-density", "uneven-samples", "samples-inside", "no-way",
     "narrow-normals",
     // in making it
     "crashes", "overflows", "exits", "throws", "hangs", "eats-memory", "prints",
     // on the first ray
     "crashes-later", "throws-later", "hangs-later"});

// Fills the stack.
int overflow(int depth) {
  volatile char frame[1000] = {};
  return depth < 0 ? frame[0] : overflow(depth + 1) + frame[depth % 1000];
}

class Flawed final : public Shape, public AreaSampler, public SurfaceColor {
 public:
  explicit Flawed(Params& p) : flaw_(p.choice("flaw", kFlaws, "none", "what is wrong")) {
    static int made = 0;
    r_ = is("differs") ? 1 + 0.01 * ++made : 1;
    if (is("crashes")) std::abort();
    if (is("overflows")) overflow(0);
    if (is("exits")) std::exit(0);
    if (is("throws")) throw 7;
    if (is("hangs"))
      for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));
    if (is("eats-memory"))
      for (std::vector<std::unique_ptr<char[]>> all;;)
        all.push_back(std::make_unique_for_overwrite<char[]>(1U << 24U));
    if (is("prints")) std::printf("a word of its own");
  }

  Bounds3 bounds(std::uint32_t) const override {
    const auto r = static_cast<float>(r_);
    if (is("nowhere")) return {};
    if (is("infinite-bounds")) return {Point3(-kInfinity), Point3(r)};
    return {Point3(-r), Point3(is("tight-bounds") ? 0.99F * r : r)};
  }

  std::optional<ShapeHit> intersect(const ObjectRay& ray, std::uint32_t) const override {
    if (is("crashes-later")) std::abort();
    if (is("throws-later")) throw Error("no such ray");
    if (is("hangs-later"))
      for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));
    const double a = lengthSquared(ray.d), b = glm::dot(ray.o, ray.d);
    const double discriminant = a * (r_ * r_ - lengthSquared(ray.o - b / a * ray.d));
    if (!(discriminant >= 0)) return {};
    const double q = -b - std::copysign(std::sqrt(discriminant), b);
    const double t0 = q / a, t1 = (lengthSquared(ray.o) - r_ * r_) / q;
    for (const double t : {std::min(t0, t1), std::max(t0, t1)}) {
      if (!(t > ray.tMin || is("behind")) || !(t <= ray.tMax || is("beyond"))) continue;
      if (is("loses-hits") && t == std::max(t0, t1) && ray.d.x > 0) continue;
      const double late = is("late-hits") ? 0.01 : 0;
      return ShapeHit{float(t + late), float(t - float(t)), 0, is("other-primitive") ? 1U : 0U};
    }
    return {};
  }
  bool occluded(const ObjectRay& ray, std::uint32_t k) const override {
    return !is("no-shadow") && intersect(ray, k);
  }

  SurfacePoint surface(const ObjectRay& ray, const ShapeHit& hit) const override {
    const double late = is("late-hits") ? 0.01 : 0;
    DVec3 n = glm::normalize(ray.at(double{hit.t} + hit.u - late));
    if (is("shared")) {  // as it was when another thread came between
      last_ = n;
      for (int i = 0; i < 20; ++i) std::this_thread::yield();
      n = last_;
    }
    if (is("counts")) n = glm::normalize(n + 1e-7 * ++last_.x);
    if (is("allocates")) {
      char* volatile memory = new char[100];
      delete[] memory;
    }
    const double theta = std::acos(std::clamp(n.z, -1.0, 1.0)), pi = std::numbers::pi;
    const double rho = std::sqrt(n.x * n.x + n.y * n.y);
    const double phi = std::atan2(n.y, n.x) + (n.y < 0 ? 2 * pi : 0);
    const DVec3 east = rho > 0 ? DVec3(-n.y, n.x, 0) / rho : DVec3(0, 1, 0);
    SurfacePoint s;
    s.p = r_ * n;
    s.error = 1e-15;
    s.n = n;
    s.uv = Point2(phi / (2 * pi), theta / pi);
    s.dndu = 2 * pi * rho * east, s.dndv = -pi * glm::cross(n, east);
    s.dpdu = r_ * DVec3(s.dndu), s.dpdv = r_ * DVec3(s.dndv);
    if (is("off-the-surface")) s.p *= 1 + 1e-6;
    if (is("no-error")) s.p += 1e-9 * std::sin(1e9 * n.x) * n, s.error = 0;
    if (is("huge-error")) s.error = 1;
    if (is("long-normal")) s.n *= 1.1F;
    if (is("turned-normal") && glm::dot(ray.d, n) > 0) s.n = -s.n;
    if (is("inside-out")) s.n = -s.n, s.dndu = -s.dndu, s.dndv = -s.dndv;
    if (is("wild-uv")) s.uv.x = std::nanf("");
    if (is("tiled-uv")) s.uv *= 2.F, s.dpdu /= 2, s.dpdv /= 2, s.dndu /= 2, s.dndv /= 2;
    if (is("no-uv")) s.uv = Point2(0), s.dpdu = s.dpdv = s.dndu = s.dndv = Vec3(0);
    if (is("half-derivatives")) s.dpdv = Vec3(0);
    if (is("wrong-curvature")) s.dndv = -s.dndv;
    if (is("inward-shading")) s.ns = -s.n;
    if (is("sinks")) s.error = 0, s.p -= 1e-10 * n;
    if (is("not-a-number") && ray.d.x == 0) s.dpdu.x = std::nanf("");
    return s;
  }

  const AreaSampler* areaSampler() const override { return this; }
  double area() const override { return (is("wrong-area") ? 2 : 4) * std::numbers::pi * r_ * r_; }
  AreaSample sample(const DPoint3& from, Point2 u) const override {
    if (is("uneven-samples")) u.x *= u.x;
    AreaSample s;
    s.n = uniformSphere(u);
    s.p = r_ * DVec3(s.n) * (is("samples-inside") ? 0.9 : 1.0);
    s.error = 1e-6 * r_;
    s.pdf = pdf(from, s.p, s.n) * (is("wrong-pdf") ? 1.5F : 1.F);
    return s;
  }
  float pdf(const DPoint3& from, const DPoint3& p, const Normal3& n) const override {
    const double area = 4 * std::numbers::pi * r_ * r_;
    return uniformAreaPdf(from, p, n, is("wrong-density") ? 1.1 * area : area);
  }
  bool mayHit(const DPoint3& from, const DVec3& w) const override {
    return !is("no-way") && intersect({from, w}, 0);
  }
  DirectionCone normals() const override { return {{0, 0, 1}, is("narrow-normals") ? 0.F : -1.F}; }

  const SurfaceColor* color() const override { return this; }
  Spectrum at(const DPoint3&, std::uint32_t) const override {
    return Spectrum(is("dark-colour") ? -1.F : 1.F);
  }

 private:
  bool is(std::string_view flaw) const { return flaw_ == flaw; }

  std::string flaw_;
  double r_ = 1;
  mutable DVec3 last_{0};
};

}  // namespace

PBRT_PLUGIN(Shape, Flawed, "flawed", "a sphere that is wrong in one way")
