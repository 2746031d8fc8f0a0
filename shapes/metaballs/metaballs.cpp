// Metaballs: the surface on which the summed fields of many atoms reach a threshold.
//
// Parametrisation: spherical about the atom that adds most to the field at the point; v = 0 where
// that atom's direction is -z, v = 1 at +z, u runs once around z. It jumps where another atom takes
// over; the surface and its normal do not.

#include <mutex>

#include "core/plugin/plugin.h"
#include "core/plugin/rounded_hit.h"
#include "shapes/metaballs/area.h"
#include "shapes/metaballs/input.h"
#include "shapes/metaballs/roots.h"
#include "shapes/metaballs/whole_field.h"

namespace pbrt::metaballs {

class Metaballs final : public Shape, private SurfaceColor {
 public:
  explicit Metaballs(Params& params) : Metaballs(readInput(params)) {
    if (cells_.cells().empty() && !params.describing())
      params.warn(params.has("filename") ? "filename" : "P",
                  "the field stays below the threshold everywhere: there is no surface");
  }

  std::uint32_t primitives() const override {
    return std::max<std::uint32_t>(1, static_cast<std::uint32_t>(cells_.cells().size()));
  }
  Bounds3 bounds(std::uint32_t primitive) const override {
    return cells_.cells().empty() ? Bounds3() : Cells::bounds(cells_.cells()[primitive]);
  }

  std::optional<ShapeHit> intersect(const ObjectRay& ray, std::uint32_t primitive) const override;
  bool occluded(const ObjectRay& ray, std::uint32_t primitive) const override {
    if (cells_.cells().empty()) return false;
    const Cell& cell = cells_.cells()[primitive];
    return crosses(field_, cell, cells_.atoms(cell), ray);
  }
  SurfacePoint surface(const ObjectRay& ray, const ShapeHit& hit) const override;
  const AreaSampler* areaSampler() const override {
    std::call_once(samplerMade_, [&] { sampler_.emplace(field_, cells_); });
    return sampler_->area() > 0 ? &*sampler_ : nullptr;
  }
  const SurfaceColor* color() const override { return colors_.empty() ? nullptr : this; }
  const ImplicitField* implicit() const override {
    if (cells_.cells().empty()) return nullptr;
    std::call_once(wholeMade_, [&] { whole_.emplace(field_, cells_); });
    return &*whole_;
  }

 private:
  explicit Metaballs(Input input)
      : field_(std::move(input.field)), cells_(field_), colors_(std::move(input.colors)) {}

  Spectrum at(const DPoint3& p, std::uint32_t primitive) const override;
  double errorBound(const FieldSample& field, double size) const;
  void parametrise(SurfacePoint& at, const FieldSample& field) const;

  Field field_;
  Cells cells_;
  std::vector<Spectrum> colors_;  // of the atoms; may be empty
  mutable std::once_flag samplerMade_;
  mutable std::optional<PatchSampler> sampler_;  // made when an area light asks for it
  mutable std::once_flag wholeMade_;
  mutable std::optional<WholeField> whole_;  // made when somebody asks for the field
};

std::optional<ShapeHit> Metaballs::intersect(const ObjectRay& ray, std::uint32_t primitive) const {
  if (cells_.cells().empty()) return {};
  const Cell& cell = cells_.cells()[primitive];
  const std::optional<double> t = firstCrossing(field_, cell, cells_.atoms(cell), ray);
  if (!t) return {};
  return roundedHit(ray, *t, primitive);
}

SurfacePoint Metaballs::surface(const ObjectRay& ray, const ShapeHit& hit) const {
  const Cell& cell = cells_.cells()[hit.primitive];
  const AtomList list = cells_.atoms(cell);
  SurfacePoint at;
  at.p = ray.at(static_cast<double>(hit.t) + hit.u);

  // Newton's method along the gradient, mostly not needed. Where the gradient all but vanishes a
  // step would lead far away: the point stays. From very far away t + u is coarse, though.
  const double rounding =
      0x1p-45 * glm::length(glm::abs(ray.o) + static_cast<double>(hit.t) * glm::abs(ray.d));
  const double limit = std::max(0x1p-8 * glm::length(DVec3(cell.box.diagonal())), rounding);
  const double size = std::abs(at.p.x) + std::abs(at.p.y) + std::abs(at.p.z);
  FieldSample field = field_.sample(at.p, list);
  for (int i = 0; i < 4; ++i) {
    const double off = std::abs(field.value) / glm::length(field.gradient);
    if (!(off > 4 * kEpsilon * size && std::abs(field.value) > field.error && off < limit)) break;
    at.p -= field.value / lengthSquared(field.gradient) * field.gradient;
    field = field_.sample(at.p, list);
  }

  // Inside is where the field is higher. Without a direction to tell, face the ray.
  const DVec3 g = field.gradient / glm::length(field.gradient);
  at.n = Normal3(std::isfinite(g.x + g.y + g.z) ? -g : -glm::normalize(ray.d));
  at.error = errorBound(field, size);
  parametrise(at, field);
  return at;
}

// The distance e for which the field provably is above zero at p - e n and below at p + e n, so
// that the surface passes between: |f(p)| <= v = |value| + error, and along n the field falls at
// least by |g| - bend e - jump over the length. With e = 2 v / |g| that is enough while
// bend e + jump <= |g| / 2. Where that does not hold, as where the surface touches itself or a ray
// grazed it within rounding, e is cut off. It is no less than a few roundings of p, whose
// coordinates are of this `size`.
double Metaballs::errorBound(const FieldSample& field, double size) const {
  const double steep = glm::length(field.gradient);
  const double least = 8 * kEpsilon * size;
  const double e = 2.1 * (std::abs(field.value) + field.error) / steep;
  const bool proven = e * field.bend + field.jump <= 0.5 * steep;
  return std::max(least,
                  proven ? e : std::min(e, 0x1p-30 * field_.atoms()[field.strongest].radius));
}

// The mean of the atoms' colours by what each adds to the field; those that carve have none.
Spectrum Metaballs::at(const DPoint3& p, std::uint32_t primitive) const {
  DVec3 sum(0);
  double weights = 0;
  withKernel(field_.kernel(), [&]<class K>(K) {
    for (const std::uint32_t j : cells_.atoms(cells_.cells()[primitive])) {
      const Atom& atom = field_.atoms()[j];
      const double q = lengthSquared(p - DPoint3(atom.centre)) / sqr<double>(atom.radius);
      const double weight = std::max(0.0, atom.weight) * K::value(q);
      sum += weight * DVec3(colors_[j]);
      weights += weight;
    }
  });
  return weights > 0 ? Spectrum(sum / weights) : Spectrum(0);
}

// With w(u, v) the unit direction from the strongest atom, p = a + R(u, v) w. Its derivative
// R w_u + R_u w is tangent to the surface if R_u = -R (n . w_u) / (n . w). The normal turns by the
// Hessian H: n = -g / |g|, so n_u = -(1 - n n^T) H p_u / |g|.
// At the poles, and where the surface runs along w, the tangents are any two of length h.
void Metaballs::parametrise(SurfacePoint& at, const FieldSample& field) const {
  const Atom& atom = field_.atoms()[field.strongest];
  const DVec3 r = at.p - DPoint3(atom.centre), n(at.n);
  const double R = glm::length(r);
  const DVec3 w = R > 0 ? r / R : DVec3(0, 0, 1);
  constexpr double pi = std::numbers::pi;
  const double turn = std::atan2(w.y, w.x) / (2 * pi);
  at.uv = {turn < 0 ? turn + 1 : turn, 1 - std::acos(std::clamp(w.z, -1.0, 1.0)) / pi};

  const double rim = std::sqrt(w.x * w.x + w.y * w.y), facing = glm::dot(n, w);
  DVec3 pu, pv;
  if (rim > 1e-6 && std::abs(facing) > 1e-2) {
    const DVec3 wu = 2 * pi * DVec3(-w.y, w.x, 0);
    const DVec3 wv = pi * DVec3(-w.z * w.x / rim, -w.z * w.y / rim, rim);
    pu = R * (wu - glm::dot(n, wu) / facing * w);
    pv = R * (wv - glm::dot(n, wv) / facing * w);
  } else {
    const Frame frame = Frame::fromZ(at.n);
    pu = static_cast<double>(atom.radius) * DVec3(frame.x);
    pv = static_cast<double>(atom.radius) * DVec3(frame.y);
  }
  at.dpdu = Vec3(pu);
  at.dpdv = Vec3(pv);
  const double steep = glm::length(field.gradient);
  const auto turned = [&](const DVec3& along) {
    const DVec3 g = field.hessian * along / -steep;
    const Normal3 dn(g - glm::dot(g, n) * n);
    return isFinite(dn) ? dn : Normal3(0);
  };
  at.dndu = turned(pu);
  at.dndv = turned(pv);
}

}  // namespace pbrt::metaballs

PBRT_PLUGIN(Shape, pbrt::metaballs::Metaballs, "metaballs",
            "a smooth skin around atoms: where the sum of their fields reaches a threshold")
