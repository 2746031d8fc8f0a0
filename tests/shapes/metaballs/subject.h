#pragma once
// A set of atoms with its cells under a tree of boxes, as rays of a renderer meet them.

#include "tests/shapes/metaballs/judge.h"

namespace pbrt::metaballs::test {

// A binary tree over boxes.
class Tree {
 public:
  explicit Tree(std::vector<Bounds3> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    if (!order_.empty()) split(0, static_cast<std::uint32_t>(order_.size()));
  }

  // Calls f(number, ray) for the boxes that the ray meets, until it returns true. f may shorten the
  // ray.
  template <class F>
  bool each(ObjectRay& ray, F f) const {
    return !nodes_.empty() && each(0, ray, f);
  }

 private:
  struct Node {
    Bounds3 box;
    std::uint32_t first = 0, count = 0;  // leaf: in order_
    std::uint32_t right = 0;             // else: left is the next node
  };

  void split(std::uint32_t first, std::uint32_t count) {
    const std::size_t me = nodes_.size();
    Node& node = nodes_.emplace_back(Node{{}, first, count});
    Bounds3 centres;
    for (std::uint32_t i = first; i < first + count; ++i) {
      node.box.add(boxes_[order_[i]]);
      centres.add(boxes_[order_[i]].centre());
    }
    if (count <= 2) return;
    const Vec3 edge = centres.diagonal();
    const int axis = edge.x >= edge.y ? (edge.x >= edge.z ? 0 : 2) : (edge.y >= edge.z ? 1 : 2);
    const std::uint32_t half = count / 2;
    const auto some = std::span(order_).subspan(first, count);
    std::ranges::nth_element(some, some.begin() + half, {},
                             [&](std::uint32_t i) { return boxes_[i].centre()[axis]; });
    node.count = 0;
    split(first, half);
    nodes_[me].right = static_cast<std::uint32_t>(nodes_.size());
    split(first + half, count - half);
  }

  // Boxes are met with room for the rounding of the ray.
  static bool meets(const Bounds3& box, const ObjectRay& ray) {
    double t0 = ray.tMin, t1 = ray.tMax;
    for (int i = 0; i < 3; ++i) {
      const double room = 8 * kEpsilon * std::abs(ray.o[i]);
      const double lo = box.lo[i] - ray.o[i] - room, hi = box.hi[i] - ray.o[i] + room;
      if (ray.d[i] == 0) {
        if (lo > 0 || hi < 0) return false;
        continue;
      }
      const auto [a, b] = std::minmax({lo / ray.d[i], hi / ray.d[i]});
      t0 = std::max(t0, a - 8 * kEpsilon * std::abs(a));
      t1 = std::min(t1, b + 8 * kEpsilon * std::abs(b));
    }
    return t0 <= t1;
  }
  template <class F>
  bool each(std::size_t i, ObjectRay& ray, F& f) const {
    const Node& node = nodes_[i];
    if (!meets(node.box, ray)) return false;
    if (node.count > 0) {
      for (std::uint32_t k = node.first; k < node.first + node.count; ++k)
        if (meets(boxes_[order_[k]], ray) && f(order_[k], ray)) return true;
      return false;
    }
    const DVec3 apart = DVec3(nodes_[node.right].box.centre()) - DVec3(nodes_[i + 1].box.centre());
    const bool leftFirst = glm::dot(apart, ray.d) >= 0;
    return each(leftFirst ? i + 1 : node.right, ray, f) ||
           each(leftFirst ? node.right : i + 1, ray, f);
  }

  std::vector<Bounds3> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

// A set of atoms with all that answers for it, on both sides.
struct Subject {
  explicit Subject(Field f) : field(std::move(f)) {}
  Subject(const Subject&) = delete;
  Subject& operator=(const Subject&) = delete;

  std::optional<double> first(ObjectRay ray, Effort* effort = nullptr) const {
    std::optional<double> best;
    tree.each(ray, [&](std::uint32_t i, ObjectRay& r) {
      const Cell& cell = cells.cells()[i];
      if (const auto t = firstCrossing(field, cell, cells.atoms(cell), r, effort))
        if (!best || *t < *best) best = t;
      if (best) r.tMax = *best;
      return false;
    });
    return best;
  }
  bool occluded(ObjectRay ray) const {
    return tree.each(ray, [&](std::uint32_t i, const ObjectRay& r) {
      const Cell& cell = cells.cells()[i];
      return crosses(field, cell, cells.atoms(cell), r);
    });
  }
  bool judge(const ObjectRay& ray, Tally& tally) const {
    const auto ours = first(ray, &tally.effort);
    return Judge(blocks, ray)(ours, occluded(ray), tally);
  }

  static std::vector<Bounds3> boxes(const Cells& cells) {
    std::vector<Bounds3> all;
    for (const Cell& cell : cells.cells()) all.push_back(Cells::bounds(cell));
    return all;
  }

  Field field;
  Cells cells{field};
  Tree tree{boxes(cells)};
  Blocks blocks{field};
};

}  // namespace pbrt::metaballs::test
