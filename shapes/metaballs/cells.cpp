#include "shapes/metaballs/cells.h"

#include <array>
#include <bit>
#include <deque>
#include <numeric>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "shapes/metaballs/eight_bounds.h"

namespace pbrt::metaballs {
namespace {

// Longest edge of a cell over the smallest support radius that reaches it.
constexpr float kFineness = 0.3F;
// With no more atoms than this a cell may be as large as the smallest radius times kCoarse.
constexpr std::size_t kFew = 8;
constexpr float kCoarse = 2;
// Boxes that more atoms reach are split before the threads take one each; up to so many.
constexpr std::size_t kShare = 1 << 14, kShares = 4096;

using Numbers = std::vector<std::uint32_t>;

bool smallEnough(const Bounds3& box, std::size_t atoms, float smallestRadius) {
  const Vec3 edges = box.diagonal();
  const float edge = std::max({edges.x, edges.y, edges.z});
  if (edge <= (atoms <= kFew ? kCoarse : kFineness) * smallestRadius * 1.0001F) return true;
  // Where floats are too coarse to split any further.
  const Point3 middle = box.centre();
  return glm::any(glm::lessThanEqual(middle, box.lo)) ||
         glm::any(glm::lessThanEqual(box.hi, middle));
}

// How much of [-h, h] from its lower end on has a + b x + g x^2 < 0.
double negativeUntil(double a, double b, double g, double h) {
  // In y = x + h: a' + b' y + g y^2, whose first zero is -2 a' / (b' + sqrt(b'^2 - 4 a' g)).
  const double start = a - b * h + g * h * h, rise = b - 2 * g * h;
  if (start >= 0) return 0;
  const double root = rise * rise - 4 * start * g;
  const double under = rise + std::sqrt(std::max(0.0, root));
  if (root < 0 || !(under > 0)) return 2 * h;
  return std::min(2 * h, -2 * start / under);
}

Bounds3 octantOf(const Bounds3& box, int lane) {
  const Point3 middle = box.centre();
  Bounds3 octant = box;
  for (int axis = 0; axis < 3; ++axis)
    ((lane >> axis & 1) ? octant.lo : octant.hi)[axis] = middle[axis];
  return octant;
}

// Eight boxes, each with its overlap and a little more.
template <class BoxOf>
Eight eightBoxes(BoxOf boxOf) {
  Eight boxes;
  for (int lane = 0; lane < kLanes; ++lane) {
    const Bounds3 box = boxOf(lane);
    const Point3 c = box.centre();
    const Vec3 half = glm::max(c - box.lo, box.hi - c) * (1 + static_cast<float>(8 * kOverlap));
    for (int axis = 0; axis < 3; ++axis) {
      boxes.centre[axis][lane] = c[axis];
      boxes.half[axis][lane] = half[axis];
    }
  }
  return boxes;
}
Eight octantsOf(const Bounds3& box) {
  return eightBoxes([&](int lane) { return octantOf(box, lane); });
}

// The part of an octant outside of which, on either side of each axis, f is proven not to be zero.
Bounds3 shrunk(Bounds3 box, const Eight& octants, int lane, const EightBounds& bounds) {
  const auto cut = [&](const Paraboloid& p, float sign) {  // where sign * p + slack < 0
    for (int axis = 0; axis < 3; ++axis) {
      Floats rest = sign * p.a + bounds.slack;
      for (int other = 0; other < 3; ++other)
        if (other != axis) rest += extreme(p, other, sign, octants.half[other]);
      const double h = octants.half[axis][lane], c = octants.centre[axis][lane];
      const double b = sign * p.b[axis][lane], g = sign * p.g[lane];
      const double low = 0.9999 * negativeUntil(rest[lane], b, g, h);
      const double high = 0.9999 * negativeUntil(rest[lane], -b, g, h);
      DPoint3 lo(box.lo), hi(box.hi);
      lo[axis] = std::max(lo[axis], c - h + low);
      hi[axis] = std::min(hi[axis], c + h - high);
      box = roundOutward(lo, hi);
    }
  };
  cut(bounds.above, 1);
  cut(bounds.below, -1);
  return box;
}

// The cells within one box.
class Subtree {
 public:
  explicit Subtree(const Field& field) : field_(field) {}

  // Calls child(box, list, smallest radius) for every octant that may meet the surface.
  template <class F>
  void children(const Bounds3& box, AtomList list, float smallestRadius, F child);
  // Splits the box all the way.
  void split(const Bounds3& box, AtomList list, float smallestRadius) {
    children(box, list, smallestRadius, [&](const Bounds3& octant, AtomList its, float smallest) {
      if (smallEnough(octant, its.size(), smallest))
        keep(octant, its);
      else
        split(octant, its, smallest);
    });
  }
  void keep(Bounds3 box, AtomList list);
  Bounds3 shaved(Bounds3 box, AtomList list);

  std::vector<Cell> cells;
  Numbers atoms;

 private:
  bool allInside(const Eight& octants, AtomList list) const {
    return !field_.carves() && loops().allInside(field_.kernel(), field_.atoms(), list, octants);
  }
  EightBounds bounds(const Eight& octants, AtomList list, bool tight) {
    masks_.resize(list.size());
    EightBounds result;
    loops().bounds(field_.kernel(), field_.atoms(), list, octants, tight, masks_.data(), result);
    return result;
  }

  const Field& field_;
  std::vector<std::uint8_t> masks_;  // which octants an atom reaches
  // Of the octants in work, by depth. They grow and are not cut: their length is counted apart.
  std::deque<std::array<Numbers, kLanes>> lists_;
  std::size_t depth_ = 0;
};

template <class F>
void Subtree::children(const Bounds3& box, AtomList list, float smallestRadius, F child) {
  const Eight octants = octantsOf(box);
  if (allInside(octants, list)) return;
  // Where the octants may be cells, sharper bounds save looking at each.
  const bool last = smallEnough(octantOf(box, 0), list.size(), smallestRadius);
  const unsigned undecided = bounds(octants, list, last).undecided;
  if (lists_.size() == depth_) lists_.emplace_back();
  std::array<Numbers, kLanes>& lists = lists_[depth_++];
  std::array<std::size_t, kLanes> count{};
  for (int lane = 0; lane < kLanes; ++lane) {
    if (!(undecided >> lane & 1)) continue;
    Numbers& its = lists[lane];
    std::size_t n = 0;
    for (const std::uint8_t mask : masks_) n += mask >> lane & 1;
    if (its.size() <= n) its.resize(n + 1);
    n = 0;
    for (std::size_t i = 0; i < list.size(); ++i) {  // without branches, which would be guesses
      its[n] = list[i];
      n += masks_[i] >> lane & 1;
    }
    count[lane] = n;
  }
  for (int lane = 0; lane < kLanes; ++lane) {
    if (!(undecided >> lane & 1)) continue;
    const AtomList its(lists[lane].data(), count[lane]);
    child(octantOf(box, lane), its, field_.smallestRadius(its));
  }
  --depth_;
}

// Cuts slices off the six sides that provably do not meet the surface.
Bounds3 Subtree::shaved(Bounds3 box, AtomList list) {
  for (int round = 0; round < 2; ++round)
    for (int side = 0; side < 6; ++side) {
      const int axis = side / 2;
      const float edge = box.hi[axis] - box.lo[axis];
      const auto slice = [&](int lane) {  // 1/16, 2/16, ... 8/16 of the box
        Bounds3 s = box;
        const float thickness = static_cast<float>(lane + 1) / 16 * edge;
        if (side % 2)
          s.lo[axis] = std::max(s.lo[axis], box.hi[axis] - thickness);
        else
          s.hi[axis] = std::min(s.hi[axis], box.lo[axis] + thickness);
        return s;
      };
      const unsigned undecided = bounds(eightBoxes(slice), list, true).undecided;
      const int free = std::min(std::countr_zero(undecided), kLanes);
      if (free == 0) continue;
      const Bounds3 cut = slice(free - 1);
      if (side % 2)
        box.hi[axis] = cut.lo[axis];
      else
        box.lo[axis] = cut.hi[axis];
    }
  return box;
}

// The octants of the box tell more sharply than the box where the surface is.
void Subtree::keep(Bounds3 box, AtomList list) {
  if (list.size() <= kFew) box = shaved(box, list);
  const Eight octants = octantsOf(box);
  if (allInside(octants, list)) return;
  const EightBounds f = bounds(octants, list, true);
  Bounds3 tight;
  for (int lane = 0; lane < kLanes; ++lane)
    if (f.undecided >> lane & 1) {
      const Bounds3 part = shrunk(octantOf(box, lane), octants, lane, f);
      if (!part.empty()) tight.add(part);
    }
  if (tight.empty()) return;
  const std::size_t first = atoms.size();
  const DPoint3 margin = 2 * kOverlap * DVec3(tight.diagonal());
  const DPoint3 lo = DPoint3(tight.lo) - margin, hi = DPoint3(tight.hi) + margin;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!(masks_[i] & f.undecided)) continue;
    const Atom& atom = field_.atoms()[list[i]];
    const DPoint3 c(atom.centre);
    const DVec3 d = glm::max(DVec3(0), glm::max(lo - c, c - hi));
    if (glm::dot(d, d) < sqr(static_cast<double>(atom.radius)) * (1 + 0x1p-40))
      atoms.push_back(list[i]);
  }
  cells.push_back(
      {tight, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(atoms.size() - first)});
}

// The cube that holds the supports of all atoms that add to the field. Halved often enough, its
// edge is just small enough for the smallest atom.
Bounds3 rootBox(const Field& field) {
  Bounds3 box;
  float smallest = kInfinity;
  for (const Atom& atom : field.atoms()) {
    smallest = std::min(smallest, atom.radius);
    if (atom.weight > 0)
      box.add(roundOutward(DPoint3(atom.centre) - static_cast<double>(atom.radius),
                           DPoint3(atom.centre) + static_cast<double>(atom.radius)));
  }
  if (box.empty()) return box;
  const DVec3 extent = DVec3(box.hi) - DVec3(box.lo);
  double edge = static_cast<double>(kFineness) * smallest;
  while (edge < std::max({extent.x, extent.y, extent.z})) edge *= 2;
  const DPoint3 middle = 0.5 * DPoint3(box.lo) + 0.5 * DPoint3(box.hi);
  return roundOutward(middle - 0.5 * edge, middle + 0.5 * edge);
}

struct Node {
  Bounds3 box;
  Numbers list;
  float smallestRadius = 0;
};

std::vector<Subtree> subtrees(const Field& field) {
  const Bounds3 box = rootBox(field);
  if (box.empty()) return {};
  std::vector<Node> nodes(1);
  nodes[0].box = box;
  nodes[0].list.resize(field.atoms().size());
  std::iota(nodes[0].list.begin(), nodes[0].list.end(), 0U);
  // Level by level, until there are enough boxes with few enough atoms.
  for (bool again = true; again && nodes.size() < kShares;) {
    again = false;
    std::vector<std::vector<Node>> next(nodes.size());
    parallelFor(nodes.size(), [&](std::size_t i) {
      if (nodes[i].list.size() <= kShare) {
        next[i].push_back(std::move(nodes[i]));
        return;
      }
      Subtree(field).children(
          nodes[i].box, nodes[i].list, nodes[i].smallestRadius,
          [&](const Bounds3& octant, AtomList list, float smallest) {
            next[i].push_back({octant, Numbers(list.begin(), list.end()), smallest});
          });
      nodes[i].list = {};
    });
    std::vector<Node> flat;
    for (std::vector<Node>& some : next)
      for (Node& node : some) {
        again = again || node.list.size() > kShare;
        flat.push_back(std::move(node));
      }
    nodes = std::move(flat);
  }
  std::vector<Subtree> done(nodes.size(), Subtree(field));
  parallelFor(nodes.size(), [&](std::size_t i) {
    done[i].split(nodes[i].box, nodes[i].list, nodes[i].smallestRadius);
    nodes[i].list = {};
  });
  return done;
}

}  // namespace

Cells::Cells(const Field& field) {
  std::vector<Subtree> parts = subtrees(field);
  std::size_t cells = 0, atoms = 0;
  for (const Subtree& part : parts) cells += part.cells.size(), atoms += part.atoms.size();
  if (atoms > std::numeric_limits<std::uint32_t>::max())
    throw Error("too many atoms overlap: the cells of the surface would list more than 2^32");
  cells_.reserve(cells);
  atoms_.reserve(atoms);
  for (Subtree& part : parts) {
    for (Cell& cell : part.cells) {
      cell.first += static_cast<std::uint32_t>(atoms_.size());
      cells_.push_back(cell);
    }
    atoms_.insert(atoms_.end(), part.atoms.begin(), part.atoms.end());
    part.cells = {};
    part.atoms = {};
  }
}

}  // namespace pbrt::metaballs
