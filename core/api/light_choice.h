#pragma once
// Which light is sampled, where only one is.

#include <array>
#include <span>

#include "core/api/world.h"

namespace pbrt {

// From which light a point takes its one sample. Probing, a light's chance goes by what it would
// send to the point if nothing were in between, as a few fixed samples of it say. They may be wrong
// (all face away, but some of the light does not), so a share of the choices is uniform: no light
// is left out, and none is n / kUniform times too rare (Hesterberg 1995, "Weighted Average
// Importance Sampling and Defensive Mixture Distributions").
class LightChoice {
 public:
  struct Chosen {
    const Light& light;
    float chance;
    Point2 u;  // uniform still, for the light to sample with
  };

  LightChoice(const World& world, bool probes, Scratch& scratch) : lights_(world.lights()) {
    const std::size_t n = probes && lights_.size() > 1 ? lights_.size() : 0;
    if (n > 0)
      probes_ = {static_cast<float*>(scratch.allocate(n * sizeof(float), alignof(float))), n};
  }

  bool empty() const { return lights_.empty(); }
  const Point3& point() const { return p_; }

  // From now on it is about p.
  void moveTo(const Point3& p) {
    p_ = p;
    float sum = 0;
    for (std::size_t i = 0; i < probes_.size(); ++i) sum += probes_[i] = probe(*lights_[i]);
    const auto n = static_cast<float>(lights_.size());
    probed_ = sum > 0 && sum < kInfinity;
    total_ = probed_ ? sum / (1 - kUniform) : n;
    least_ = probed_ ? total_ * kUniform / n : 1;
  }

  // The number u.x chooses the light; what is left of it is uniform again.
  Chosen choose(Point2 u) const {
    const auto weight = [&](std::size_t i) { return (probed_ ? probes_[i] : 0) + least_; };
    std::size_t i = 0;
    float rest = u.x * total_;
    for (; i + 1 < lights_.size() && rest >= weight(i); ++i) rest -= weight(i);
    return {*lights_[i], weight(i) / total_, {std::min(rest / weight(i), kOneMinusEpsilon), u.y}};
  }

  // That of choose() for this light.
  float chance(const Light& light) const {
    return ((probed_ ? probe(light) : 0) + least_) / total_;
  }

 private:
  static constexpr float kUniform = 0.2F;
  // Of lights that have an extent. One does not do: of a closed surface it faces away from half of
  // all points, though the other half of the surface shines on them.
  static constexpr std::array<Point2, 4> kProbes = {
      {{0.125F, 0.375F}, {0.375F, 0.875F}, {0.625F, 0.125F}, {0.875F, 0.625F}}};

  float probe(const Light& light) const {
    float sum = 0;
    for (const Point2& u : std::span(kProbes).first(light.isDelta() ? 1 : kProbes.size())) {
      const LightSample s = light.sample(p_, u);
      if (s.pdf > 0) sum += luminance(s.L) / s.pdf;
    }
    return light.isDelta() ? sum : sum / kProbes.size();
  }

  std::span<const Light* const> lights_;
  std::span<float> probes_;  // of the lights at p_; none: all have the same chance
  Point3 p_{};
  bool probed_ = false;
  float total_ = 0;  // of all weights, which are the probes, each raised by:
  float least_ = 0;
};

// Whether a ray from p along w may meet any light.
inline bool mayEndAtLight(const World& world, const Point3& p, const Vec3& w) {
  return !world.infiniteLights().empty() ||
         std::ranges::any_of(world.lights(), [&](const Light* l) { return l->mayHit(p, w); });
}

}  // namespace pbrt
