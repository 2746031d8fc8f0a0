#include "shapes/metaballs/area.h"

#include <bit>

#include "core/base/rng.h"
#include "core/base/warp.h"
#include "shapes/metaballs/roots.h"

namespace pbrt::metaballs {
namespace {

// The least |n_a| of a patch that is crossed once.
constexpr double kLeastCosine = 0.3;
constexpr int kMostCrossings = 16;
constexpr std::size_t kLeaf = 4;

struct GradientRange {
  DVec3 lo{0}, hi{0};
};

// Holds the gradient over a box. Of an atom whose support holds the box it uses the mean value
// form, g(x) in g(c) + H (x - c) with the Hessians H over the box: summed over the atoms they
// cancel as g does. Of any other the range of 2 w / h^2 K'(q) (x - a) itself, as the gaussian's
// gradient jumps where its support ends. It asks of a kernel that K' rises and K'' falls inside.
// Rounding is ignored: what is proven here has a margin of many digits.
template <class K>
GradientRange gradientOver(const DPoint3& lo, const DPoint3& hi, const Field& field,
                           AtomList list) {
  const DPoint3 centre = 0.5 * (lo + hi);
  GradientRange sum;
  glm::dmat3 hessianLo(0), hessianHi(0);
  for (const std::uint32_t j : list) {
    const Atom& atom = field.atoms()[j];
    const DPoint3 middle(atom.centre);
    const DVec3 a = lo - middle, b = hi - middle;
    const DVec3 near = glm::max(DVec3(0), glm::max(a, -b)), far = glm::max(-a, b);
    const double inverse2 = 1 / sqr(static_cast<double>(atom.radius));
    const double q0 = lengthSquared(near) * inverse2, q1 = lengthSquared(far) * inverse2;
    if (q0 >= 1) continue;
    // The ends of w K' 2 / h^2 over the box, and of w K'' 4 / h^4.
    const double s = 2 * inverse2 * atom.weight;
    const double k0 = s * K::slope(q0), k1 = s * K::slope(q1);
    if (q1 >= 1) {
      for (int i = 0; i < 3; ++i) {
        sum.lo[i] += std::min({k0 * a[i], k0 * b[i], k1 * a[i], k1 * b[i]});
        sum.hi[i] += std::max({k0 * a[i], k0 * b[i], k1 * a[i], k1 * b[i]});
      }
      continue;
    }
    const DVec3 r = centre - middle, g = s * K::slope(lengthSquared(r) * inverse2) * r;
    sum.lo += g;
    sum.hi += g;
    const double c0 = 2 * inverse2 * s * K::curvature(q0), c1 = 2 * inverse2 * s * K::curvature(q1);
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k <= i; ++k) {
        const double products[] = {a[i] * a[k], a[i] * b[k], b[i] * a[k], b[i] * b[k]};
        const double least = i == k ? sqr(near[i]) : std::ranges::min(products);
        const double most = std::ranges::max(products);
        const double ends[] = {c0 * least, c0 * most, c1 * least, c1 * most};
        hessianLo[i][k] += std::ranges::min(ends) + (i == k ? std::min(k0, k1) : 0);
        hessianHi[i][k] += std::ranges::max(ends) + (i == k ? std::max(k0, k1) : 0);
      }
  }
  const DVec3 half = 0.5 * (hi - lo);
  for (int i = 0; i < 3; ++i) {
    double swing = 0;
    for (int k = 0; k < 3; ++k) {
      const int row = std::max(i, k), column = std::min(i, k);
      swing += std::max(-hessianLo[row][column], hessianHi[row][column]) * half[k];
    }
    sum.lo[i] -= swing;
    sum.hi[i] += swing;
  }
  return sum;
}

// An axis along which the surface's normal is proven to be at least kLeastCosine, or -1.
int provenAxis(const GradientRange& g) {
  const DVec3 least = glm::max(DVec3(0), glm::max(g.lo, -g.hi)), most = glm::max(-g.lo, g.hi);
  const int axis = least.x >= least.y ? (least.x >= least.z ? 0 : 2) : (least.y >= least.z ? 1 : 2);
  const double along2 = sqr(least[axis]);
  const double across2 = lengthSquared(most) - sqr(most[axis]);
  return along2 > sqr(kLeastCosine) * (along2 + across2) ? axis : -1;
}

DVec3 outward(const FieldSample& field) {
  return -field.gradient / glm::length(field.gradient);
}

}  // namespace

int PatchSampler::Patch::tileOf(const DPoint3& p) const {
  const DVec3 at = (p - DPoint3(box.lo)) / size() * static_cast<double>(kTiles);
  const auto index = [&](int k) {
    return std::clamp(static_cast<int>(at[(axis + k) % 3]), 0, kTiles - 1);
  };
  return kTiles * index(2) + index(1);
}

DPoint3 PatchSampler::Patch::onFace(double x, double y) const {
  DPoint3 p(box.lo);
  p[(axis + 1) % 3] += x / kTiles * size()[(axis + 1) % 3];
  p[(axis + 2) % 3] += y / kTiles * size()[(axis + 2) % 3];
  return p;
}

PatchSampler::PatchSampler(const Field& field, const Cells& cells, int deepest)
    : field_(field), cells_(cells), deepest_(deepest) {
  for (std::uint32_t i = 0; i < cells.cells().size(); ++i) split(i, cells.cells()[i].box, 0);
  if (patches_.empty()) return;
  tree_.resize(4 * std::bit_ceil(patches_.size() / kLeaf + 1));
  sortIntoTree(0, 0, patches_.size());
  double sum = 0;
  for (const Patch& patch : patches_) cumulative_.push_back(sum += patch.weight);
}

void PatchSampler::split(std::uint32_t cell, const Bounds3& box, int depth) {
  const DPoint3 lo(box.lo), hi(box.hi);
  const AtomList list = cells_.atoms(cells_.cells()[cell]);
  if (!field_.bound(lo, hi, list).contains(0)) return;
  const int proven = provenAxis(withKernel(
      field_.kernel(), [&]<class K>(K) { return gradientOver<K>(lo, hi, field_, list); }));
  if (proven >= 0) {
    add({.box = box, .cell = cell, .axis = static_cast<std::uint8_t>(proven)});
    return;
  }
  const DVec3 edge = hi - lo;
  const int axis = edge.x >= edge.y ? (edge.x >= edge.z ? 0 : 2) : (edge.y >= edge.z ? 1 : 2);
  Bounds3 below = box, above = box;
  below.hi[axis] = above.lo[axis] = box.centre()[axis];
  if (depth < deepest_ && below.hi[axis] > box.lo[axis] && above.lo[axis] < box.hi[axis]) {
    split(cell, below, depth + 1);
    split(cell, above, depth + 1);
    return;
  }
  for (std::uint8_t i = 0; i < 3; ++i) add({.box = box, .cell = cell, .axis = i, .once = false});
}

// Finds the patch's tiles and its weight, and adds to the area.
void PatchSampler::add(Patch patch) {
  const AtomList list = atoms(patch);
  const double height = patch.size()[patch.axis];
  const auto cosineAt = [&](const DPoint3& p) {
    return std::abs(outward(field_.sample(p, list))[patch.axis]);
  };
  Rng random(patches_.size());
  for (int k = 0; k < kTiles * kTiles; ++k) {
    const int x = k % kTiles, y = k / kTiles;
    // Anywhere in the tile: of a symmetric body the errors of middles would all be the same.
    const DPoint3 onFace = patch.onFace(x + random.uniform(), y + random.uniform());
    double cosine = 0;
    visitCrossings(patch, onFace, [&](const DPoint3& p) {
      // Three patches that share a box count the surface once: the squares of n add up to one.
      if (const double c = cosineAt(p); c > 0) {
        area_ += patch.tileArea() * (patch.once ? 1 / c : c);
        cosine = c;
      }
    });
    if (cosine == 0) {
      const DPoint3 begin = patch.onFace(x, y);
      DPoint3 end = patch.onFace(x + 1, y + 1);
      end[patch.axis] += height;
      if (!field_.bound(begin, end, list).contains(0)) continue;
      cosine = cosineAt(0.5 * (begin + end));
    }
    patch.tiles |= static_cast<std::uint16_t>(1U << k);
    // Without a gradient the cosine is NaN.
    patch.weight += patch.tileArea() / (cosine > kLeastCosine ? cosine : kLeastCosine);
  }
  if (patch.tiles != 0) patches_.push_back(patch);
}

void PatchSampler::sortIntoTree(std::size_t node, std::size_t first, std::size_t last) {
  Bounds3 box;
  for (std::size_t i = first; i < last; ++i) box.add(patches_[i].box);
  tree_[node] = box;
  if (last - first <= kLeaf) return;
  const Vec3 edge = box.diagonal();
  const int axis = edge.x >= edge.y ? (edge.x >= edge.z ? 0 : 2) : (edge.y >= edge.z ? 1 : 2);
  const std::size_t middle = (first + last) / 2;
  const auto at = [&](std::size_t i) { return patches_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(first), at(middle), at(last), [&](const Patch& a, const Patch& b) {
    return a.box.centre()[axis] < b.box.centre()[axis];
  });
  sortIntoTree(2 * node + 1, first, middle);
  sortIntoTree(2 * node + 2, middle, last);
}

template <class Visit>
void PatchSampler::visitHolding(const DPoint3& p, std::size_t node, std::size_t first,
                                std::size_t last, const Visit& visit) const {
  const auto holds = [&](const Bounds3& box) {
    return glm::all(glm::lessThanEqual(DPoint3(box.lo), p)) &&
           glm::all(glm::lessThan(p, DPoint3(box.hi)));
  };
  if (!holds(tree_[node])) return;
  if (last - first <= kLeaf) {
    for (std::size_t i = first; i < last; ++i)
      if (holds(patches_[i].box)) visit(patches_[i]);
    return;
  }
  const std::size_t middle = (first + last) / 2;
  visitHolding(p, 2 * node + 1, first, middle, visit);
  visitHolding(p, 2 * node + 2, middle, last, visit);
}

// Along the patch's axis from a point of its lower face.
template <class Visit>
void PatchSampler::visitCrossings(const Patch& patch, const DPoint3& onFace,
                                  const Visit& visit) const {
  Cell piece = cells_.cells()[patch.cell];
  piece.box = patch.box;
  const double height = patch.size()[patch.axis];
  ObjectRay ray{onFace, DVec3(0), 0, height};
  ray.d[patch.axis] = 1;
  for (int i = 0; i < (patch.once ? 1 : kMostCrossings); ++i) {
    const auto t = firstCrossing(field_, piece, atoms(patch), ray);
    if (!t) return;
    visit(ray.at(*t));
    ray.tMin = *t + 0x1p-20 * height;
  }
}

// (1) of the header.
double PatchSampler::density(const DPoint3& p, const Normal3& n) const {
  if (patches_.empty()) return 0;
  double sum = 0;
  visitHolding(p, 0, 0, patches_.size(), [&](const Patch& patch) {
    if (!(patch.tiles >> patch.tileOf(p) & 1)) return;
    int crossings = patch.once ? 1 : 0;
    if (!patch.once) {
      DPoint3 onFace = p;
      onFace[patch.axis] = patch.box.lo[patch.axis];
      visitCrossings(patch, onFace, [&](const DPoint3&) { ++crossings; });
    }
    if (crossings > 0)
      sum += patch.weight * std::abs(static_cast<double>(n[patch.axis])) /
             (std::popcount(patch.tiles) * patch.tileArea() * crossings);
  });
  return sum / cumulative_.back();
}

AreaSample PatchSampler::sample(const DPoint3& from, Point2 u) const {
  if (patches_.empty()) return {};
  // The part of u.x that did not choose the patch is uniform again within it, that of u.y which
  // did not choose the tile within that.
  const double x = u.x * cumulative_.back();
  const auto chosen = std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, x);
  const auto& patch = patches_[static_cast<std::size_t>(chosen - cumulative_.begin())];
  const double restX = std::clamp(1 - (*chosen - x) / patch.weight, 0.0, 1.0);
  const double y = u.y * static_cast<double>(std::popcount(patch.tiles));
  auto tiles = static_cast<unsigned>(patch.tiles);
  for (int skip = static_cast<int>(y); skip > 0; --skip) tiles &= tiles - 1;
  const int tile = std::countr_zero(tiles);
  const int column = tile % kTiles, row = tile / kTiles;
  const DPoint3 onFace = patch.onFace(column + restX, row + (y - std::floor(y)));

  std::array<DPoint3, kMostCrossings> crossings;
  std::uint32_t count = 0;
  visitCrossings(patch, onFace, [&](const DPoint3& p) { crossings[count++] = p; });
  if (count == 0) return {};
  Rng rng(hash(std::bit_cast<std::uint32_t>(u.x), std::bit_cast<std::uint32_t>(u.y)));
  const AtomList list = atoms(patch);
  AreaSample s;
  s.p = crossings[count > 1 ? rng.uniform(count) : 0];
  const FieldSample field = field_.sample(s.p, list);
  s.n = Normal3(outward(field));
  if (!isFinite(s.n)) return {};
  // The field's distance from the threshold over its slope, twice as the slope may change, and the
  // rounding of the point.
  const Range off = field_.bound(s.p, list);
  s.error = 2 * std::max(-off.lo, off.hi) / glm::length(field.gradient) +
            4 * kEpsilon * (std::abs(s.p.x) + std::abs(s.p.y) + std::abs(s.p.z));
  s.pdf = pdf(from, s.p, s.n);
  return s;
}

float PatchSampler::pdf(const DPoint3& from, const DPoint3& p, const Normal3& n) const {
  const double perArea = density(p, n);
  return perArea > 0 ? uniformAreaPdf(from, p, n, 1 / perArea) : 0;
}

// By the sphere around the box, a little larger for rounding.
bool PatchSampler::mayHit(const DPoint3& from, const DVec3& w) const {
  if (patches_.empty()) return false;
  const DPoint3 lo(tree_[0].lo), hi(tree_[0].hi);
  const double radius2 = 0.25 * lengthSquared(hi - lo) * (1 + 1e-6);
  const DVec3 d = 0.5 * (lo + hi) - from;
  return lengthSquared(d) <= radius2 ||
         (glm::dot(d, w) > 0 && lengthSquared(glm::cross(d, w)) <= radius2 * lengthSquared(w));
}

}  // namespace pbrt::metaballs
