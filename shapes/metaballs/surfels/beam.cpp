#include "shapes/metaballs/surfels/draw.h"

namespace pbrt::surfels {
namespace {

constexpr int kPatchWidth = 8, kPatchHeight = 4;

struct UnitRay {
  DPoint3 o{};
  DVec3 d{};
};

Bound boundOf(std::span<const UnitRay> rays) {
  Bound bound;
  if (rays.empty()) return bound;
  DPoint3 sum(0);
  DVec3 directions(0);
  for (const UnitRay& ray : rays) sum += ray.o, directions += ray.d;
  bound.centre = Point3(sum / static_cast<double>(rays.size()));
  const double length = glm::length(directions);
  const Vec3 axis(length > 0 ? directions / length : DVec3(0, 0, 1));
  double radius = 0, cosine = 1, spread = 0;
  for (const UnitRay& ray : rays) {
    radius = std::max(radius, glm::distance(ray.o, DPoint3(bound.centre)));
    cosine = std::min(cosine, glm::dot(ray.d, DVec3(axis)));
    spread = std::max(spread, glm::distance(ray.d, DVec3(axis)));
  }
  // A little more than that, for what is rounded when balls are tested.
  constexpr double slack = 2e-6;
  bound.radius = static_cast<float>(radius * (1 + slack));
  if (cosine < 0.05) return bound;
  bound.axis = axis;
  bound.cosine = static_cast<float>(cosine * (1 - slack));
  bound.sine = static_cast<float>(std::sqrt(std::max(0.0, 1 - cosine * cosine)) + slack);
  bound.spread = static_cast<float>(spread + slack);
  return bound;
}

}  // namespace

void Beam::set(std::span<const Ray> rays, int width) {
  thread_local std::vector<UnitRay> all, own;  // they only ever grow
  size_ = rays.size();
  bound_ = {};
  patches_.clear();
  all.clear();
  if (rays.empty()) return;
  const int height = static_cast<int>(rays.size()) / width;
  for (int y = 0; y < height; y += kPatchHeight)
    for (int x = 0; x < width; x += kPatchWidth) {
      Patch patch;
      own.clear();
      for (int i = 0; i < kPatchWidth * kPatchHeight; ++i) {
        // Packets of 4 x 2, two beside two.
        const int packet = i / kLanes, lane = i % kLanes;
        const int px = x + packet % 2 * 4 + lane % 4, py = y + packet / 2 * 2 + lane / 4;
        patch.scale[packet][lane] = 1;
        patch.pixels[packet][lane] = static_cast<std::uint32_t>(size_);
        if (px >= width || py >= height) continue;
        const int pixel = py * width + px;
        patch.pixels[packet][lane] = static_cast<std::uint32_t>(pixel);
        const Ray& ray = rays[static_cast<std::size_t>(pixel)];
        const DVec3 d(ray.d);
        const double length = glm::length(d);
        if (!isFinite(ray.o) || !isFinite(ray.d) || !(length > 0)) continue;
        own.push_back({DPoint3(ray.o), d / length});
        const auto at = [&, lane](Floats& lanes, double value) {
          lanes[lane] = static_cast<float>(value);
        };
        Rays& r = patch.rays[packet];
        at(r.ox, ray.o.x), at(r.oy, ray.o.y), at(r.oz, ray.o.z);
        at(r.dx, d.x / length), at(r.dy, d.y / length), at(r.dz, d.z / length);
        at(r.tMin, ray.tMin * length), at(r.tMax, ray.tMax * length);
        at(patch.scale[packet], 1 / length);
      }
      patch.bound = boundOf(own);
      patches_.push_back(patch);
      all.insert(all.end(), own.begin(), own.end());
    }
  bound_ = boundOf(all);
}

}  // namespace pbrt::surfels
