#pragma once
// How a participating medium scatters light.

#include "core/base/frame.h"

namespace pbrt {

struct PhaseSample {
  Vec3 wi{};
  float pdf = 0;  // per solid angle; also the value of the phase function
};

// The phase function of Henyey and Greenstein (1941) with mean cosine g, -1 < g < 1: forward for
// g > 0. Directions are unit and point away from the point: light that goes straight on comes from
// wi = -wo.
class Phase {
 public:
  explicit Phase(float g) : g_(g) {}

  // Per steradian; it integrates to 1.
  //
  // With c = wo . wi, (1 - g^2) / (4 pi (1 + g^2 + 2 g c)^(3/2)). Where the bracket is small it
  // cancels; but 1 + c = |wo + wi|^2 / 2 and 1 - c = |wo - wi|^2 / 2 do not, and
  // 1 + g^2 + 2 g c = (1 - g)^2 + 2 g (1 + c) = (1 + g)^2 - 2 g (1 - c).
  float operator()(const Vec3& wo, const Vec3& wi) const {
    const float d = g_ > 0 ? sqr(1 - g_) + g_ * lengthSquared(wo + wi)
                           : sqr(1 + g_) - g_ * lengthSquared(wo - wi);
    return (1 - g_) * (1 + g_) / (4 * kPi * d * std::sqrt(d));
  }

  // Inverts the distribution of the cosine. Of its height over the forward direction, 1 + c, all
  // that cancels can be divided out: with s = (1 - g^2) / (1 + g - 2 g u),
  // 1 + c = u (1 - g) (s + 1 - g) / (1 + g - 2 g u), also for g = 0.
  PhaseSample sample(const Vec3& wo, Point2 u) const {
    const float q = 1 / (1 + g_ - 2 * g_ * u.x);
    const float s = (1 - g_) * (1 + g_) * q;
    const float height = std::min(u.x * (1 - g_) * (s + 1 - g_) * q, 2.F);
    const float r = safeSqrt(height * (2 - height)), phi = 2 * kPi * u.y;
    const Vec3 wi = Frame::fromZ(-wo).fromLocal({r * std::cos(phi), r * std::sin(phi), 1 - height});
    return {wi, (*this)(wo, wi)};
  }

 private:
  float g_;
};

}  // namespace pbrt
