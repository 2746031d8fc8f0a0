#include "core/plugin/implicit_surface.h"

#include "core/plugin/implicit_cells.h"
#include "core/plugin/implicit_roots.h"
#include "core/plugin/rounded_hit.h"

namespace pbrt {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// A ray is followed over the faces of a box by this share of its diagonal: a crossing near a shared
// face lies well inside one of the boxes, whatever the rounding of a ray that is clipped to both.
constexpr double kOverlap = 0x1p-14;

struct Box {
  DPoint3 lo, hi;

  explicit Box(const Bounds3& cell) {
    const double overlap = kOverlap * glm::length(DVec3(cell.diagonal()));
    lo = DPoint3(cell.lo) - overlap, hi = DPoint3(cell.hi) + overlap;
  }
};

}  // namespace

ImplicitShape::ImplicitShape(std::unique_ptr<const ImplicitField> field, std::size_t cells)
    : field_(std::move(field)) {
  if (cells > 0) cells_ = shellOf(*field_, cells);
}

ImplicitShape::~ImplicitShape() = default;

std::uint32_t ImplicitShape::primitives() const {
  return std::max<std::uint32_t>(1, static_cast<std::uint32_t>(cells_.size()));
}

Bounds3 ImplicitShape::bounds(std::uint32_t primitive) const {
  if (empty()) return {};
  const Box box(cells_[primitive]);
  return roundOutward(box.lo, box.hi);
}

std::optional<ShapeHit> ImplicitShape::intersect(const ObjectRay& ray,
                                                 std::uint32_t primitive) const {
  if (empty()) return {};
  const Box box(cells_[primitive]);
  const Segment piece = clip(ray, box.lo, box.hi);
  const std::optional<double> s = firstZero(*field_, piece, false);
  if (!s) return {};
  const double t = piece.t(*s);
  if (!(t > ray.tMin && t <= ray.tMax)) return {};
  return roundedHit(ray, t, primitive);
}

bool ImplicitShape::occluded(const ObjectRay& ray, std::uint32_t primitive) const {
  if (empty()) return false;
  const Box box(cells_[primitive]);
  const Segment piece = clip(ray, box.lo, box.hi);
  const std::optional<double> s = firstZero(*field_, piece, true);
  return s && piece.t(*s) > ray.tMin && piece.t(*s) <= ray.tMax;
}

SurfacePoint ImplicitShape::surface(const ObjectRay& ray, const ShapeHit& hit) const {
  SurfacePoint at;
  at.p = ray.at(static_cast<double>(hit.t) + hit.u);

  // Newton's method along the gradient, mostly not needed. Where the gradient all but vanishes a
  // step would lead far away: the point stays. From very far away t + u is coarse, though.
  const double rounding =
      0x1p-45 * glm::length(glm::abs(ray.o) + static_cast<double>(hit.t) * glm::abs(ray.d));
  const double cell = glm::length(DVec3(cells_[hit.primitive].diagonal()));
  const double size = std::abs(at.p.x) + std::abs(at.p.y) + std::abs(at.p.z);
  FieldPoint f = field_->at(at.p);
  for (int i = 0; i < 4; ++i) {
    const double off = std::abs(f.value) / glm::length(f.gradient);
    if (!(off > kEpsilon * size && off < std::max(0x1p-8 * cell, rounding))) break;
    at.p -= f.value / lengthSquared(f.gradient) * f.gradient;
    f = field_->at(at.p);
  }

  // Inside is where the field is higher. Without a direction to tell, face the ray.
  const double steep = glm::length(f.gradient);
  DVec3 n = -f.gradient / steep;
  if (!std::isfinite(n.x + n.y + n.z)) n = -glm::normalize(ray.d);
  at.n = Normal3(n);
  at.error = std::min(errorBound(at.p, n, steep, size), 0x1p-14 * cell + 8 * kEpsilon * size);

  const Vec3 a = glm::abs(at.n);
  const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
  const int across = (axis + 1) % 3, up = (axis + 2) % 3;
  const Bounds3 box = field_->bounds();
  const DVec3 edges(box.diagonal());
  at.uv = {(at.p[across] - box.lo[across]) / edges[across], (at.p[up] - box.lo[up]) / edges[up]};
  DVec3 pu(0), pv(0);
  pu[across] = edges[across];
  pv[up] = edges[up];
  // Tangent to the surface: n . dp = 0.
  pu[axis] = -n[across] / n[axis] * edges[across];
  pv[axis] = -n[up] / n[axis] * edges[up];
  if (n[axis] < 0) {
    at.uv.x = 1 - at.uv.x;
    pu = -pu;
  }
  at.uv = glm::clamp(at.uv, 0.F, 1.F);
  at.dpdu = Vec3(pu);
  at.dpdv = Vec3(pv);
  // n = -g / |g| turns by the Hessian H: dn = -(1 - n n^T) H dp / |g|.
  const glm::dmat3 hessian = field_->hessian(at.p);
  const auto turned = [&](const DVec3& along) {
    const DVec3 g = hessian * along / -steep;
    const Normal3 dn(g - glm::dot(g, n) * n);
    return isFinite(dn) ? dn : Normal3(0);
  };
  at.dndu = turned(pu);
  at.dndv = turned(pv);
  return at;
}

// A distance e such that f changes its sign between p - e n and p + e n: f(p) is in F, and falls
// along n by e times a slope in -G . n at least, where G is the range of the gradient over the box
// about both. e = 2 |F| / |g| is enough while G . n <= -|g| / 2. While all of -G . n is above zero,
// this is proved, by a better e; where not, as where the surface touches itself, e is an estimate.
double ImplicitShape::errorBound(const DPoint3& p, const DVec3& n, double steep,
                                 double size) const {
  const double least = 8 * kEpsilon * size;
  const double off = field_->over(p, p).value.magnitude();
  const double e = std::max(least, 2.1 * off / steep);
  const FieldRange about = field_->over(p - e, p + e);
  const Range fall = about.gradient[0] * -n.x + about.gradient[1] * -n.y + about.gradient[2] * -n.z;
  return fall.lo > 0 ? std::max(least, 1.01 * off / fall.lo) : e;
}

}  // namespace pbrt
