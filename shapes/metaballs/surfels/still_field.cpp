#include "shapes/metaballs/surfels/still_field.h"

#include "core/base/parallel.h"
#include "core/base/rng.h"
#include "core/plugin/implicit_cells.h"

namespace pbrt::surfels {
namespace {

constexpr int kAcross = 2;  // patches along each edge of a box
constexpr std::size_t kShare = 64;

bool isFinite(const DVec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// The greater of the two principal curvatures is no more than this, nor is this more than 1.5 times
// that: the Frobenius norm of the shape operator P H P / |g|, where P projects across g.
double curvature(const ShapeAt& at) {
  const double steep = glm::length(at.gradient);
  const DVec3 n = at.gradient / steep;
  const glm::dmat3 across = glm::dmat3(1) - glm::outerProduct(n, n);
  const glm::dmat3 turn = across * at.hessian * across;
  const double norm2 = lengthSquared(turn[0]) + lengthSquared(turn[1]) + lengthSquared(turn[2]);
  return std::sqrt(norm2) / steep;
}

// The value below which this share of them is.
double quantile(std::vector<double>& values, double share) {
  const auto nth =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

// Appends the halves across the longest edge.
void halve(const Bounds3& box, std::vector<Bounds3>& halves) {
  const Vec3 edges = box.diagonal();
  const int axis = edges.x >= edges.y && edges.x >= edges.z ? 0 : edges.y >= edges.z ? 1 : 2;
  halves.insert(halves.end(), 2, box);
  halves.back().lo[axis] = (halves.end() - 2)->hi[axis] = box.centre()[axis];
}

}  // namespace

StillField::StillField(const ImplicitField& field, const Transform& toSpace, std::size_t cells)
    : field_(field),
      toSpace_(toSpace),
      toField_(toSpace.inverse()),
      bounds_(toSpace.bounds(field.bounds())) {
  // Boxes that do not tell how the surface runs through them are halved as long as they are few.
  constexpr int kHalvings = 30;
  std::vector<Bounds3> boxes = shellOf(field, cells);
  for (int i = 0; i <= kHalvings && !boxes.empty(); ++i) {
    const bool last = i == kHalvings || boxes.size() > 2 * cells;
    std::vector<Part> parts((boxes.size() + kShare - 1) / kShare);
    parallelFor(parts.size(), [&](std::size_t k) {
      for (std::size_t b = k * kShare; b < std::min((k + 1) * kShare, boxes.size()); ++b)
        if (!addPatches(boxes[b], last, parts[k].patches)) halve(boxes[b], parts[k].halves);
    });
    boxes.clear();
    for (const Part& part : parts) {
      patches_.insert(patches_.end(), part.patches.begin(), part.patches.end());
      boxes.insert(boxes.end(), part.halves.begin(), part.halves.end());
    }
  }
  double area = 0;
  for (Patch& patch : patches_) patch.areaSoFar = area += patch.areaSoFar;
  if (patches_.empty())
    bounds_ = Bounds3();
  else
    measure();
}

// Where the derivative along an axis keeps its sign, lines along that axis meet the surface once at
// most. Some are spread over the face of the box: each stands for a part of the surface of area
// (face of the line) / |n_axis|. A map M takes a piece of area dA and unit normal n to
// |det M| |M^-T n| dA. False: there is no such axis, and `whatever` did not ask to take any.
bool StillField::addPatches(const Bounds3& box, bool whatever, std::vector<Patch>& patches) const {
  const DPoint3 lo(box.lo), hi(box.hi), centre = 0.5 * lo + 0.5 * hi, edges = hi - lo;
  const FieldRange range = field_.over(lo, hi);
  if (!range.value.contains(0)) return true;
  const DVec3 steep = glm::abs(field_.at(centre).gradient);
  int a = -1;
  for (int i = 0; i < 3; ++i)
    if ((whatever || !range.gradient[i].contains(0)) && (a < 0 || steep[i] > steep[a])) a = i;
  if (a < 0) return false;
  const int b = (a + 1) % 3, c = (a + 2) % 3;
  const double width = edges[b] / kAcross, height = edges[c] / kAcross;
  const double growth = std::abs(glm::determinant(glm::dmat3(toSpace_.matrix())));
  for (int i = 0; i < kAcross; ++i)
    for (int j = 0; j < kAcross; ++j) {
      DPoint3 from = lo, to = lo;
      from[b] = to[b] = lo[b] + (i + 0.5) * width;
      from[c] = to[c] = lo[c] + (j + 0.5) * height;
      to[a] = hi[a];
      const std::optional<DPoint3> p = between(from, to);
      if (!p) continue;
      const DVec3 g = field_.at(*p).gradient;
      const double area =
          growth * width * height * glm::length(toSpace_.normal(g)) / std::abs(g[a]);
      if (std::isfinite(area))
        patches.push_back({*p, a, static_cast<float>(width), static_cast<float>(height), area});
    }
  return true;
}

// Where the field changes its sign on the way, by bisection; none if its ends have the same.
std::optional<DPoint3> StillField::between(DPoint3 from, DPoint3 to) const {
  const double start = field_.at(from).value, end = field_.at(to).value;
  if (!(start < 0 ? end >= 0 : end < 0)) return {};
  for (int i = 0; i < 40; ++i) {
    const DPoint3 middle = 0.5 * from + 0.5 * to;
    ((field_.at(middle).value < 0) == (start < 0) ? from : to) = middle;
  }
  return 0.5 * from + 0.5 * to;
}

// Grain: the radius of curvature that a twentieth of the surface goes below.
void StillField::measure() {
  std::vector<double> bend(patches_.size()), steep(patches_.size());
  parallelFor((patches_.size() + kShare - 1) / kShare, [&](std::size_t k) {
    for (std::size_t i = k * kShare; i < std::min((k + 1) * kShare, patches_.size()); ++i) {
      const ShapeAt at = shapeAt(patches_[i].p);
      bend[i] = curvature(at), steep[i] = glm::length(at.gradient);
    }
  });
  std::erase_if(bend, [](double k) { return !std::isfinite(k); });
  std::erase_if(steep, [](double g) { return !(g > 0); });
  const double size = glm::length(DVec3(bounds_.diagonal()));
  const double sharpest = bend.empty() ? 0 : quantile(bend, 0.95);
  grain_ = std::clamp(1 / sharpest, 0x1p-10 * size, size);
  if (!steep.empty()) scale_ = 2 / (grain_ * quantile(steep, 0.5));
  const double stretch = std::cbrt(std::abs(glm::determinant(glm::dmat3(toField_.matrix()))));
  slack_ = grain_ * stretch / 8;
}

// Newton's method along the gradient; none if that leads farther away than `within`, or to no end.
std::optional<DPoint3> StillField::onSurface(DPoint3 p, double within) const {
  const DPoint3 start = p;
  for (int i = 0; i < 8; ++i) {
    const FieldPoint f = field_.at(p);
    const DVec3 step = f.value / lengthSquared(f.gradient) * f.gradient;
    if (!isFinite(step)) return {};
    p -= step;
    if (glm::distance(p, start) > within || distanceBeyond(p) > 0) return {};
    if (glm::length(step) < 1e-5 * within) return p;
  }
  return {};
}

double StillField::distanceBeyond(const DPoint3& p) const {
  const Bounds3 b = field_.bounds();
  const DVec3 beyond = glm::max(DPoint3(b.lo) - p, p - DPoint3(b.hi));
  return std::max({beyond.x, beyond.y, beyond.z});
}

// With x = M q: the gradient by x is M^-T times that by q, and the Hessian M^-T H M^-1.
ShapeAt StillField::shapeAt(const DPoint3& p) const {
  const glm::dmat3 inverse(toField_.matrix());
  ShapeAt at{toSpace_.normal(field_.at(p).gradient),
             glm::transpose(inverse) * field_.hessian(p) * inverse};
  if (!isFinite(at.gradient)) at.gradient = DVec3(0);
  if (!isFinite(at.hessian[0] + at.hessian[1] + at.hessian[2])) at.hessian = glm::dmat3(0);
  return at;
}

void StillField::at(std::span<const DPoint3> points, std::span<FieldAt> out) const {
  constexpr double most = 1e6;
  for (std::size_t i = 0; i < points.size(); ++i) {
    out[i] = {};
    const DPoint3 p = toField_.point(points[i]);
    if (!(distanceBeyond(p) <= slack_)) continue;
    const FieldPoint f = field_.at(p);
    const DVec3 gradient = scale_ * toSpace_.normal(f.gradient);
    if (std::isnan(f.value)) continue;
    out[i].value = std::clamp(scale_ * f.value, -most, most);
    if (isFinite(gradient)) out[i].gradient = gradient;
  }
}

void StillField::shape(std::span<const DPoint3> points, std::span<ShapeAt> out) const {
  for (std::size_t i = 0; i < points.size(); ++i) {
    out[i] = shapeAt(toField_.point(points[i]));
    out[i].gradient *= scale_;
    out[i].hessian *= scale_;
  }
}

// The numbers i phi, modulo 1, are spread evenly over the area from the first on (phi is the golden
// ratio); where in its patch each lies is left to chance.
bool StillField::seeds(std::uint64_t first, std::span<DPoint3> out) const {
  if (patches_.empty()) return false;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::uint64_t number = first + i, turned = number * 0x9E3779B97F4A7C15;
    const double area = 0x1p-53 * static_cast<double>(turned >> 11U) * this->area();
    const auto found =
        std::upper_bound(patches_.begin(), patches_.end(), area,
                         [](double a, const Patch& patch) { return a < patch.areaSoFar; });
    const Patch& patch = found == patches_.end() ? patches_.back() : *found;
    const std::uint64_t chance = hash(number);
    const auto uniform = [](std::uint64_t bits) {
      return uniformFloat(static_cast<std::uint32_t>(bits));
    };
    DPoint3 p = patch.p;
    p[(patch.axis + 1) % 3] += (uniform(chance) - 0.5) * patch.width;
    p[(patch.axis + 2) % 3] += (uniform(chance >> 32U) - 0.5) * patch.height;
    const double size = std::hypot(patch.width, patch.height);
    out[i] = toSpace_.point(onSurface(p, 2 * size).value_or(patch.p));
  }
  return true;
}

}  // namespace pbrt::surfels
