// Metaballs: the surface on which the summed fields of many atoms reach a threshold.
//
// Parametrisation: spherical about the atom that adds most to the field at the point; v = 0 where
// that atom's direction is -z, v = 1 at +z, u runs once around z. It jumps where another atom takes
// over; the surface and its normal do not.

#include <fmt/format.h>

#include "core/plugin/params.h"
#include "core/plugin/plugin.h"
#include "shapes/metaballs/roots.h"

namespace pbrt::metaballs {
namespace {

// One value for all atoms, or one each.
std::vector<float> perAtom(Params& params, const std::string& name, std::size_t atoms,
                           std::string_view meaning, std::string_view unit) {
  std::vector<float> values = params.numbers(name, meaning, unit);
  if (values.empty()) values = {1};
  if (values.size() == 1) values.resize(atoms, values[0]);
  if (values.size() != atoms)
    params.fail(name, fmt::format("{} values for {} atoms: give one for all, or one for each point "
                                  "of \"P\"",
                                  values.size(), atoms));
  return values;
}

Field readField(Params& params) {
  const std::vector<Point3> centres = params.points("P", "centres of the atoms");
  params.require("P");
  const std::vector<float> radii =
      perAtom(params, "radius", centres.size(),
              "where an atom's field ends, for all atoms or for each (default 1)", "scene units");
  const std::vector<float> strengths = perAtom(
      params, "strength", centres.size(),
      "scale of an atom's field, for all atoms or for each; negative carves (default 1)", "");
  const std::string name =
      params.choice("kernel", kKernels, kKernels[0], "how the field falls with the distance");
  const auto kernel = static_cast<Kernel>(std::ranges::find(kKernels, name) - kKernels.begin());

  float largest = 0;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const auto check = [&](bool good, const std::string& parameter, float value,
                           std::string_view rule) {
      if (!good)
        params.fail(parameter, fmt::format("atom {} (the first is 0): {} is {}, but {}", i,
                                           parameter, value, rule));
    };
    const Point3& c = centres[i];
    for (int k = 0; k < 3; ++k) check(std::isfinite(c[k]), "P", c[k], "a centre must be finite");
    check(std::isfinite(radii[i]) && radii[i] > 0, "radius", radii[i],
          "a support radius must be finite and greater than 0: a field over no space has no "
          "surface");
    check(std::isfinite(strengths[i]), "strength", strengths[i], "a strength must be finite");
    check(isFinite(c - radii[i]) && isFinite(c + radii[i]), "radius", radii[i],
          "the atom must lie within the range of float");
    largest = std::max(largest, radii[i]);
  }

  // poly6 is a density: its values scale with 1 / h^3, and so does the default. A lone atom of
  // strength 1 is then a ball of 0.563 h whatever its h.
  const bool density = kernel == Kernel::poly6 && largest > 0;
  const double fallback = density ? 0.5 / std::pow(static_cast<double>(largest), 3) : 0.5;
  const float given = params.number(
      "threshold", static_cast<float>(fallback),
      "value of the field on the surface (poly6: the default is over the largest radius cubed)",
      kernel == Kernel::poly6 ? "per volume" : "");
  const double threshold = params.has("threshold") ? given : fallback;
  if (!std::isfinite(threshold) || threshold <= 0)
    params.fail("threshold",
                fmt::format("the threshold is {}, but it must be finite and greater "
                            "than 0: the field is 0 away from all atoms, so the inside "
                            "would have no end",
                            threshold));

  std::vector<Atom> atoms;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const double h = radii[i];
    if (strengths[i] != 0)
      atoms.push_back({centres[i], radii[i], 1 / h, strengths[i] * scale(kernel, h) / threshold});
  }
  return {kernel, std::move(atoms)};
}

}  // namespace

class Metaballs final : public Shape {
 public:
  explicit Metaballs(Params& params) : field_(readField(params)), cells_(field_) {
    if (cells_.cells().empty() && !params.describing())
      params.warn("P", "the field stays below the threshold everywhere: there is no surface");
  }

  std::uint32_t primitives() const override {
    return std::max<std::uint32_t>(1, static_cast<std::uint32_t>(cells_.cells().size()));
  }
  Bounds3 bounds(std::uint32_t primitive) const override {
    return cells_.cells().empty() ? Bounds3() : cells_.cells()[primitive].box;
  }

  std::optional<ShapeHit> intersect(const ObjectRay& ray, std::uint32_t primitive) const override;
  bool occluded(const ObjectRay& ray, std::uint32_t primitive) const override {
    if (cells_.cells().empty()) return false;
    const Cell& cell = cells_.cells()[primitive];
    return crosses(field_, cell, cells_.atoms(cell), ray);
  }
  SurfacePoint surface(const ObjectRay& ray, const ShapeHit& hit) const override;

 private:
  double errorBound(const DPoint3& p, const DVec3& n, double start, double limit,
                    AtomList list) const;
  void parametrise(SurfacePoint& at, const FieldSample& field) const;

  Field field_;
  Cells cells_;
};

std::optional<ShapeHit> Metaballs::intersect(const ObjectRay& ray, std::uint32_t primitive) const {
  if (cells_.cells().empty()) return {};
  const Cell& cell = cells_.cells()[primitive];
  const std::optional<double> t = firstCrossing(field_, cell, cells_.atoms(cell), ray);
  if (!t) return {};
  // Rounding keeps to (tMin, tMax]. What it takes from t goes along in u.
  auto rounded = static_cast<float>(*t);
  if (rounded <= ray.tMin) rounded = std::nextafter(rounded, kInfinity);
  if (rounded > ray.tMax) rounded = std::nextafter(rounded, -kInfinity);
  return ShapeHit{rounded, static_cast<float>(*t - rounded), 0, primitive};
}

SurfacePoint Metaballs::surface(const ObjectRay& ray, const ShapeHit& hit) const {
  const Cell& cell = cells_.cells()[hit.primitive];
  const AtomList list = cells_.atoms(cell);
  SurfacePoint at;
  at.p = ray.at(static_cast<double>(hit.t) + hit.u);

  // Newton's method along the gradient. Where the gradient all but vanishes a step would lead far
  // away: the point stays.
  const double limit = 0x1p-8 * glm::length(DVec3(cell.box.diagonal()));
  const double size = std::abs(at.p.x) + std::abs(at.p.y) + std::abs(at.p.z);
  FieldSample field = field_.sample(at.p, list);
  double off = 0;
  for (int i = 0; i < 4; ++i) {
    off = std::abs(field.value) / glm::length(field.gradient);
    if (!(off > 2 * kEpsilon * size && off < limit)) break;
    at.p -= field.value / lengthSquared(field.gradient) * field.gradient;
    field = field_.sample(at.p, list);
  }

  // Inside is where the field is higher. Without a direction to tell, face the ray.
  const DVec3 g = field.gradient / glm::length(field.gradient);
  at.n = Normal3(std::isfinite(g.x + g.y + g.z) ? -g : -glm::normalize(ray.d));
  const double radius = field_.atoms()[field.strongest].radius;
  at.error = errorBound(at.p, DVec3(at.n), 0x1p-44 * (size + radius), limit, list);
  parametrise(at, field);
  return at;
}

// The distance e, at least `start`, for which the field provably is above the threshold all around
// p - e n and below it around p + e n. So the surface passes between, and a ray from either point
// does not start on it. Where no e below `limit` will do, as where the surface touches itself or a
// ray grazed it within rounding: `start`.
double Metaballs::errorBound(const DPoint3& p, const DVec3& n, double start, double limit,
                             AtomList list) const {
  for (double e = start; e < limit; e *= 2) {
    const DVec3 around(0.5 * e), in = p - e * n, out = p + e * n;
    if (field_.bound(in - around, in + around, list).lo > 0 &&
        field_.bound(out - around, out + around, list).hi < 0)
      return e;
  }
  return start;
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
