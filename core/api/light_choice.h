#pragma once
// Which light is sampled, where only one is.

#include "core/api/world.h"

namespace pbrt {

// By what a light's chance goes: nothing, its power, or what it would send to the point if nothing
// were in between, as far as its place and its bounds say.
enum class LightStrategy : std::uint8_t { uniform, power, spatial };

// From which light a point takes its one sample. The estimates know nothing of shadows, so a share
// of the choices is uniform: no light is left out, and none is n / kUniform times too rare
// (Hesterberg 1995, "Weighted Average Importance Sampling and Defensive Mixture Distributions").
class LightChoice {
 public:
  struct Chosen {
    const Light& light;
    float chance;  // above 0
    Point2 u;      // uniform still, for the light to sample with
  };

  LightChoice(const World& world, LightStrategy strategy)
      : world_(world),  // NOLINT: it lives as long as a path
        n_(static_cast<float>(world.lights().size())),
        strategy_(differ(world, strategy) ? strategy : LightStrategy::uniform) {}

  bool empty() const { return world_.lights().empty(); }
  const Point3& point() const { return p_; }

  // From now on it is about p, where light arrives from the side of the unit normal n alone, or
  // from everywhere if n is zero.
  void moveTo(const Point3& p, const Normal3& n = Normal3(0)) {
    p_ = p;
    side_ = n;
  }
  // The same for a surface: what only reflects sees no light from behind.
  void moveTo(const SurfaceInteraction& at, const Bsdf& bsdf) {
    moveTo(at.p, bsdf.has(kTransmission) ? Normal3(0) : faceForward(at.n, at.wo));
  }

  // The number u.x chooses the light; what is left of it is uniform again.
  Chosen choose(Point2 u) const {
    if (strategy_ == LightStrategy::uniform) return uniformly(u);
    if (u.x < kUniform) return uniformly({u.x / kUniform, u.y});
    const double x = std::min((double{u.x} - kUniform) / (1 - kUniform), 1 - 0x1p-53);
    if (strategy_ == LightStrategy::spatial) {
      const LightTree::Chosen s = world_.lightTree().choose(p_, side_, x);
      return {light(s.light),
              mixed(s.chance),
              {std::min(static_cast<float>(s.rest), kOneMinusEpsilon), u.y}};
    }
    const auto cell = world_.lightPowers().sample({static_cast<float>(x), 0});
    return {light(cell.x), mixed(cell.chance), {cell.within.x, u.y}};
  }

  // That of choose() for this light.
  float chance(const Light& light) const {
    if (strategy_ == LightStrategy::uniform) return 1 / n_;
    if (strategy_ == LightStrategy::spatial)
      return mixed(world_.lightTree().chance(p_, side_, light.number));
    return mixed(world_.lightPowers().chance(static_cast<int>(light.number), 0));
  }

 private:
  static constexpr float kUniform = 0.125F;

  static bool differ(const World& world, LightStrategy strategy) {
    return strategy == LightStrategy::spatial ? !world.lightTree().empty()
                                              : world.lightPowers().total() > 0;
  }
  template <class Number>
  const Light& light(Number number) const {
    return *world_.lights()[static_cast<std::size_t>(number)];
  }
  float mixed(double chance) const {
    return static_cast<float>(kUniform / n_ + (1 - kUniform) * chance);
  }
  Chosen uniformly(Point2 u) const {
    const float x = u.x * n_, whole = std::min(std::floor(x), n_ - 1);
    const Light& one = light(whole);
    return {one, chance(one), {std::min(x - whole, kOneMinusEpsilon), u.y}};
  }

  const World& world_;
  float n_;
  LightStrategy strategy_;
  Point3 p_{};
  Normal3 side_{};
};

// Whether a ray from p along w may meet any light. Tracing it is cheaper than asking many.
inline bool mayEndAtLight(const World& world, const Point3& p, const Vec3& w) {
  constexpr std::size_t many = 16;
  return !world.infiniteLights().empty() || world.lights().size() > many ||
         std::ranges::any_of(world.lights(), [&](const Light* l) { return l->mayHit(p, w); });
}

}  // namespace pbrt
