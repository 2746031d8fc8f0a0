#pragma once
// Regions looked after step by step, as in pbrt-v1 and v2.

#include <bit>

#include "core/api/integrator.h"
#include "core/api/medium_walk.h"
#include "core/api/tracking.h"

namespace pbrt {

class RayMarch : public VolumeIntegrator {
 public:
  RayMarch(const Setup& setup, float step) : VolumeIntegrator(setup), step_(step) {}

  Spectrum through(const World& world, const Ray& ray, const Hit& hit, const Spectrum& L,
                   Sampler& sampler) const override {
    const Line line(ray);
    const std::optional<Interval> way = line.within(world.regions(), ray.tMin, hit.t);
    if (!way) return L;
    const float offset = sampler.get1D();
    const Point2 shift = sampler.get2D();
    Rng rng(hash(std::bit_cast<std::uint32_t>(offset), std::bit_cast<std::uint32_t>(shift.x),
                 std::bit_cast<std::uint32_t>(shift.y)));
    const int n = steps(way->end - way->begin, step_, 1e5);
    const double h = (way->end - way->begin) / n;
    Spectrum added(0), T(1);
    float roulette = 1;  // what a step that is looked at stands for
    for (int i = 0; i < n && !isBlack(T); ++i) {
      const double begin = way->begin + i * h;
      const Spectrum depth =
          line.depth(world.regions(), {begin, i + 1 < n ? begin + h : way->end}, 0.5 * h, offset);
      // Where in the step light is looked for: by the density of what arrives from there in the
      // channel that reaches farthest, s exp(-s x) / (1 - exp(-s h)). So no weight exceeds h.
      const float s = std::min({depth.x, depth.y, depth.z}) / static_cast<float>(h);
      const float reached = reach(Spectrum(s), h).x;
      const double x =
          s > 0 ? std::min(h, -std::log1p(-double{offset} * s * reached) / s) : offset * h;
      const Spectrum sigma = depth / static_cast<float>(h);
      // Points and lights are chosen by the plastic numbers (Roberts 2018, "The Unreasonable
      // Effectiveness of Quasirandom Sequences"): well spread along the ray.
      const Point2 u(fraction(shift.x + i * 0.7548776662466927),
                     fraction(shift.y + i * 0.5698402909980532));
      added += roulette * T * attenuation(sigma - s, x) * reached *
               gained(world, line.at(begin + x), ray, u);
      T *= attenuation(depth, 1);
      if (roulette * std::max({T.x, T.y, T.z}) < kRouletteBelow) {
        roulette *= 2;
        if (rng.uniform() < 0.5F) continue;
        const Interval rest{std::min(begin + h, way->end), way->end};
        T *= attenuation(line.depth(world.regions(), rest, h, offset), 1);
        break;
      }
    }
    return T * L + added;
  }

  Spectrum transmittance(const World& world, const Ray& ray, float t) const override {
    const Line line(ray);
    const Interval way{ray.tMin * line.length, t * line.length};
    return attenuation(line.depth(world.regions(), way, 4.0 * step_,
                                  uniformFloat(static_cast<std::uint32_t>(hashOf(ray) >> 32U))),
                       1);
  }

 protected:
  // What a ray that comes by gains per unit length at the point p, with one sample u of the lights.
  virtual Spectrum gained(const World& world, const DPoint3& p, const Ray& ray, Point2 u) const = 0;

 private:
  static constexpr float kRouletteBelow = 1e-3F;

  static float fraction(double x) {
    return std::min(static_cast<float>(x - std::floor(x)), kOneMinusEpsilon);
  }
  static int steps(double length, double step, double most) {
    return static_cast<int>(std::clamp(std::ceil(length / step), 1.0, most));
  }

  // A ray by distances.
  struct Line {
    explicit Line(const Ray& ray)
        : o(ray.o), length(glm::length(DVec3(ray.d))), w(DVec3(ray.d) / length) {}

    DPoint3 at(double t) const { return o + t * w; }

    std::optional<Interval> within(std::span<const Medium* const> regions, float from,
                                   float to) const {
      std::optional<Interval> all;
      for (const Medium* region : regions)
        if (const auto part = region->clip(o, w, {from * length, to * length}))
          all = all ? Interval{std::min(all->begin, part->begin), std::max(all->end, part->end)}
                    : *part;
      return all;
    }

    // The optical depth: exact where media are uniform, else by steps of at most `step`, looked at
    // at their fraction u.
    Spectrum depth(std::span<const Medium* const> regions, const Interval& part, double step,
                   float u) const {
      Spectrum sum(0);
      for (const Medium* region : regions) {
        MediumWalk walk(*region, o, w, part);
        while (walk.next()) {
          const Stretch& s = walk.stretch();
          if (isBlack(s.majorant)) continue;
          const int n = s.uniform ? 1 : steps(s.length(), step, 1e3);
          const double h = s.length() / n;
          for (int i = 0; i < n; ++i)
            sum += static_cast<float>(h) *
                   region->inside(at(s.begin + (i + double{u}) * h)).extinction();
        }
      }
      return sum;
    }

    DPoint3 o;
    double length;
    DVec3 w;  // unit
  };

  float step_;
};

}  // namespace pbrt
