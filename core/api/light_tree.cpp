#include "core/api/light_tree.h"

#include <array>

namespace pbrt {

namespace {

constexpr std::uint32_t kInfinite = 1U << 31U;  // marks places that are columns, not leaves
constexpr std::uint32_t kBlack = ~0U;           // the place of a light that is chosen never

// cos(max(0, a - b)) and sin(max(0, a - b)) of angles in [0, pi].
struct Angle {
  float cosine, sine;
};
Angle angle(float cosine) {
  return {cosine, safeSqrt(1 - cosine * cosine)};
}
Angle beyond(Angle a, Angle b) {
  if (a.cosine >= b.cosine) return {1, 0};
  return {a.cosine * b.cosine + a.sine * b.sine, a.sine * b.cosine - a.cosine * b.sine};
}

// The narrowest cone about both.
DirectionCone merged(const DirectionCone& a, const DirectionCone& b) {
  const double pi = std::numbers::pi;
  const auto acos = [](double x) { return std::acos(std::clamp(x, -1.0, 1.0)); };
  const double ta = acos(a.cosine), tb = acos(b.cosine), between = acos(glm::dot(a.axis, b.axis));
  if (std::min(between + tb, pi) <= ta) return a;
  if (std::min(between + ta, pi) <= tb) return b;
  const double theta = (ta + tb + between) / 2;
  const Vec3 across = glm::cross(a.axis, b.axis);
  if (theta >= pi || !(lengthSquared(across) > 0)) return {};
  // The axis is turned from a's towards b's.
  const Vec3 aside = glm::normalize(glm::cross(across, a.axis));
  const double turn = theta - ta;
  const auto axis =
      static_cast<float>(std::cos(turn)) * a.axis + static_cast<float>(std::sin(turn)) * aside;
  return {glm::normalize(axis), static_cast<float>(std::cos(theta))};
}

LightBounds merged(const LightBounds& a, const LightBounds& b) {
  if (a.box.empty()) return b;
  if (b.box.empty()) return a;
  LightBounds sum = a;
  sum.box.add(b.box);
  sum.intensity += b.intensity;
  sum.normals = merged(a.normals, b.normals);
  sum.cosEmission = std::min(a.cosEmission, b.cosEmission);
  sum.twoSided = a.twoSided || b.twoSided;
  return sum;
}

// How much a node costs those who go by it (section 4.4): its intensity, times its area, times the
// solid angle into which it shines, weighted by the cosine beyond its normals.
double cost(const LightBounds& b) {
  if (b.box.empty()) return 0;
  const double o = std::acos(std::clamp<double>(b.normals.cosine, -1, 1));
  const double w =
      std::min(o + std::acos(std::clamp<double>(b.cosEmission, -1, 1)), std::numbers::pi);
  const double solid =
      2 * std::numbers::pi * (1 - std::cos(o)) +
      std::numbers::pi / 2 *
          (2 * w * std::sin(o) - std::cos(o - 2 * w) - 2 * o * std::sin(o) + std::cos(o));
  const DVec3 d(b.box.diagonal());
  return b.intensity * solid * (d.x * d.y + d.y * d.z + d.z * d.x);
}

}  // namespace

struct LightTree::Leaf {
  LightBounds bounds;
  std::uint32_t light;
};

LightTree::LightTree(std::span<const Light* const> lights) : places_(lights.size(), kBlack) {
  std::vector<Leaf> leaves;
  std::vector<double> irradiances;
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    const LightBounds bounds = lights[i]->bounds();
    if (!(bounds.intensity > 0)) continue;
    if (!bounds.box.empty()) {
      leaves.push_back({bounds, i});
      continue;
    }
    places_[i] = kInfinite | static_cast<std::uint32_t>(infinite_.size());
    infinite_.push_back(i);
    irradiances.push_back(bounds.intensity);
  }
  if (!infinite_.empty())
    irradiances_ = {static_cast<int>(infinite_.size()), std::move(irradiances)};
  nodes_.reserve(2 * leaves.size());
  if (!leaves.empty()) build(leaves, kNone, 0);
}

std::uint32_t LightTree::build(std::span<Leaf> leaves, std::uint32_t parent, int depth) {
  LightBounds all;
  Bounds3 centres;
  for (const Leaf& leaf : leaves) {
    all = merged(all, leaf.bounds);
    centres.add(leaf.bounds.box.centre());
  }
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  Node& node = nodes_.emplace_back();
  node.intensity = all.intensity;
  node.centre = all.box.centre();
  node.radius2 = lengthSquared(0.5F * all.box.diagonal());
  node.normals = all.normals;
  node.cosEmission = all.cosEmission;
  node.twoSided = all.twoSided;
  node.parent = parent;
  if (leaves.size() == 1) {
    node.light = leaves[0].light;
    places_[node.light] = index;
    return index;
  }

  // The cheapest of the cuts between buckets of equal width along each axis; long thin halves cost
  // more (the paper's regularisation). Deep down, or where all are in one place, cut by number.
  constexpr int kBuckets = 12, kDeep = 48;
  const Vec3 extent = centres.diagonal();
  const float widest = std::max({extent.x, extent.y, extent.z});
  const auto bucket = [&](const Leaf& leaf, int axis) {
    const float x = (leaf.bounds.box.centre()[axis] - centres.lo[axis]) / extent[axis];
    return std::clamp(static_cast<int>(x * kBuckets), 0, kBuckets - 1);
  };
  double least = std::numeric_limits<double>::infinity();
  int bestAxis = -1, bestCut = 0;
  for (int axis = 0; axis < 3 && depth < kDeep; ++axis) {
    if (!(extent[axis] > 0)) continue;
    std::array<LightBounds, kBuckets> buckets;
    for (const Leaf& leaf : leaves) {
      LightBounds& b = buckets[bucket(leaf, axis)];
      b = merged(b, leaf.bounds);
    }
    std::array<double, kBuckets> costs{};
    LightBounds left, right;
    for (int i = 0; i + 1 < kBuckets; ++i) costs[i] = cost(left = merged(left, buckets[i]));
    for (int i = kBuckets - 1; i > 0; --i) {
      right = merged(right, buckets[i]);
      costs[i - 1] += cost(right);
    }
    for (int i = 0; i + 1 < kBuckets; ++i)
      if (const double c = costs[i] * (widest / extent[axis]); c < least) {
        least = c;
        bestAxis = axis;
        bestCut = i;
      }
  }
  auto middle = leaves.begin();
  if (bestAxis >= 0)
    middle = std::partition(leaves.begin(), leaves.end(),
                            [&](const Leaf& leaf) { return bucket(leaf, bestAxis) <= bestCut; });
  if (middle == leaves.begin() || middle == leaves.end()) {
    const int axis = extent.x == widest ? 0 : extent.y == widest ? 1 : 2;
    middle = leaves.begin() + static_cast<std::ptrdiff_t>(leaves.size() / 2);
    std::nth_element(leaves.begin(), middle, leaves.end(), [&](const Leaf& a, const Leaf& b) {
      return a.bounds.box.centre()[axis] < b.bounds.box.centre()[axis];
    });
  }
  build({leaves.begin(), middle}, index, depth + 1);
  const std::uint32_t right = build({middle, leaves.end()}, index, depth + 1);
  nodes_[index].right = right;
  return index;
}

// The angles that are sure: of all points of the ball and all directions of the cone those that are
// best for the light (the paper's eq. 3). Within the ball nothing is.
LightTree::Estimate LightTree::estimate(const Node& node, const Point3& p, const Normal3& n) {
  const Vec3 w = node.centre - p;
  const float distance2 = lengthSquared(w);
  if (distance2 <= node.radius2) return {node.intensity, node.radius2};
  const Vec3 towards = w / std::sqrt(distance2);
  const Angle ball = angle(safeSqrt(1 - node.radius2 / distance2));
  float cosine = -glm::dot(node.normals.axis, towards);
  if (node.twoSided) cosine = std::abs(cosine);
  const float out = beyond(beyond(angle(cosine), angle(node.normals.cosine)), ball).cosine;
  if (out < node.cosEmission) return {0, distance2};
  const float in = n == Normal3(0) ? 1 : beyond(angle(glm::dot(towards, n)), ball).cosine;
  return {in > 0 ? node.intensity * out * in : 0, distance2};
}

// Where nothing is sure to arrive from either half, by their intensity.
double LightTree::shareOfLeft(std::uint32_t node, const Point3& p, const Normal3& n) const {
  const Node& a = nodes_[node + 1];
  const Node& b = nodes_[nodes_[node].right];
  const Estimate l = estimate(a, p, n), r = estimate(b, p, n);
  const double left = l.weight * r.distance2, right = r.weight * l.distance2;
  return left + right > 0 ? left / (left + right) : a.intensity / (a.intensity + b.intensity);
}

// One of the two may be hidden from all points, so neither has less than a tenth.
double LightTree::shareOfTree(const Point3& p, const Normal3& n) const {
  if (infinite_.empty()) return 1;
  if (nodes_.empty()) return 0;
  const Estimate near = estimate(nodes_[0], p, n);
  const double far = irradiances_.total() * near.distance2, sum = near.weight + far;
  return std::clamp(sum > 0 ? near.weight / sum : 0.5, 0.1, 0.9);
}

LightTree::Chosen LightTree::choose(const Point3& p, const Normal3& n, double u) const {
  double chance = 1;
  const auto within = [&](double share) {
    const bool first = u < share;
    chance *= first ? share : 1 - share;
    u = std::min(first ? u / share : (u - share) / (1 - share), 1 - 0x1p-53);
    return first;
  };
  if (!within(shareOfTree(p, n))) {
    const auto cell = irradiances_.sample({static_cast<float>(u), 0});
    return {infinite_[static_cast<std::size_t>(cell.x)], cell.within.x, chance * cell.chance};
  }
  std::uint32_t node = 0;
  while (nodes_[node].right != kNone)
    node = within(shareOfLeft(node, p, n)) ? node + 1 : nodes_[node].right;
  return {nodes_[node].light, u, chance};
}

double LightTree::chance(const Point3& p, const Normal3& n, std::uint32_t light) const {
  const std::uint32_t place = places_[light];
  if (place == kBlack) return 0;
  const double tree = shareOfTree(p, n);
  if (place & kInfinite)
    return (1 - tree) * irradiances_.chance(static_cast<int>(place & ~kInfinite), 0);
  double chance = tree;
  for (std::uint32_t node = place; nodes_[node].parent != kNone; node = nodes_[node].parent) {
    const std::uint32_t parent = nodes_[node].parent;
    const double left = shareOfLeft(parent, p, n);
    chance *= node == parent + 1 ? left : 1 - left;
  }
  return chance;
}

}  // namespace pbrt
