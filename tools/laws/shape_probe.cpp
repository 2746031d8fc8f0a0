#include "shape_probe.h"

namespace pbrt::laws {

ShapeProbe::Box ShapeProbe::grown(const Bounds3& b) {
  const DVec3 edges(b.diagonal());
  const double more = std::max({edges.x, edges.y, edges.z});
  return {DPoint3(b.lo) - more, DPoint3(b.hi) + more};
}

ShapeProbe::ShapeProbe(const Subject& subject)
    : traits_(subject.traits), shape_(subject.make<Shape>()) {
  if (shape_->triangles()) return;
  constexpr std::uint32_t kGroup = 32;
  const std::uint32_t all = shape_->primitives();
  if (all > kGroup) boxes_.resize(all);
  for (std::uint32_t begin = 0; begin < all; begin += kGroup) {
    const std::uint32_t end = std::min(begin + kGroup, all);
    Bounds3 group;
    for (std::uint32_t i = begin; i < end; ++i)
      if (const Bounds3 b = shape_->bounds(i); !b.empty()) group.add(b);
    if (group.empty() && all > kGroup) continue;
    box_.add(group);
    Box about{DPoint3(kInfinity), DPoint3(-kInfinity)};
    for (std::uint32_t i = begin; i < end && all > kGroup; ++i) {
      const Bounds3 b = shape_->bounds(i);
      boxes_[i] = grown(b.empty() ? group : b);
      about = {glm::min(about.lo, boxes_[i].lo), glm::max(about.hi, boxes_[i].hi)};
    }
    groups_.push_back({about, begin, end});
  }
  if (box_.empty()) return;
  centre_ = DPoint3(box_.lo) * 0.5 + DPoint3(box_.hi) * 0.5;
  size_ = glm::length(DVec3(box_.hi) - DVec3(box_.lo)) / 2;
}

DPoint3 ShapeProbe::inBox() {
  const double x = uniform(), y = uniform(), z = uniform();
  return DPoint3(box_.lo) + DVec3(x, y, z) * (DVec3(box_.hi) - DVec3(box_.lo));
}

DPoint3 ShapeProbe::inPrimitive() {
  if (box_.empty()) return inBox();
  const auto below = [&](std::size_t n) {
    return std::min(n - 1, static_cast<std::size_t>(uniform() * static_cast<double>(n)));
  };
  const Group& group = groups_[below(groups_.size())];
  Bounds3 b;
  while (b.empty())  // no group of many, nor all of a few, is empty
    b = shape_->bounds(group.begin + static_cast<std::uint32_t>(below(group.end - group.begin)));
  const double x = uniform(), y = uniform(), z = uniform();
  return DPoint3(b.lo) + DVec3(x, y, z) * (DVec3(b.hi) - DVec3(b.lo));
}

ObjectRay ShapeProbe::ray() {
  const DPoint3 o = uniform() < 0.8F ? around(1.01 + 4 * uniform()) : inBox();
  return {o, (inPrimitive() - o) * (0.2 + 2 * uniform())};
}

std::optional<Found> ShapeProbe::nearest(const ObjectRay& ray) const {
  std::optional<Found> best;
  ObjectRay open = ray;  // as far as something nearer may be
  primitives(open, [&](std::uint32_t i) {
    const auto hit = shape_->intersect(ray, i);
    if (!hit || (best && !(hit->t < best->hit.t))) return;
    best = Found{*hit, i};
    open.tMax = hit->t;
  });
  return best;
}

}  // namespace pbrt::laws
