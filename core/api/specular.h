#pragma once
// Following mirror reflection and refraction.

#include "core/api/integrator.h"
#include "core/api/sampler.h"

namespace pbrt {

// The ray that leaves `at` in the direction of a specular sample, with its neighbours if `ray`,
// which came in, has them (Igehy 1999, "Tracing Ray Differentials").
inline RayDifferential specularRay(const SurfaceInteraction& at, const RayDifferential& ray,
                                   const BsdfSample& sample) {
  RayDifferential out(spawnRay(at, sample.wi));
  if (!ray.hasDifferentials) return out;
  out.hasDifferentials = true;
  out.rxOrigin = at.p + at.dpdx;
  out.ryOrigin = at.p + at.dpdy;

  // With n on wo's side and eta the incident over the transmitted index:
  //   reflection    wi = -wo + 2 (wo.n) n
  //   transmission  wi = -eta wo + mu n,  mu = eta (wo.n) - c,
  //                 c = cos theta_t = sqrt(1 - eta^2 (1 - (wo.n)^2)),
  //                 so dmu = (eta - eta^2 (wo.n) / c) d(wo.n)
  // and both are differentiated in x and y with d(wo.n) = dwo.n + wo.dn.
  const float side = glm::dot(at.wo, at.ns) < 0 ? -1 : 1;
  const Normal3 n = side * at.ns;
  const float won = glm::dot(at.wo, n);
  const auto neighbour = [&](const Vec3& direction, float du, float dv) {
    const Vec3 dwo = -glm::normalize(direction) - at.wo;
    const Normal3 dn = side * (du * at.dndu + dv * at.dndv);
    const float dwon = glm::dot(dwo, n) + glm::dot(at.wo, dn);
    if (sample.flags & kReflection) return sample.wi - dwo + 2.F * (won * dn + dwon * n);
    const float eta = 1 / sample.eta;
    const float c = std::abs(glm::dot(sample.wi, n));
    const float mu = eta * won - c;
    const float dmu = (eta - eta * eta * won / std::max(c, 1e-4F)) * dwon;
    return sample.wi - eta * dwo + mu * dn + dmu * n;
  };
  out.rxDirection = neighbour(ray.rxDirection, at.dudx, at.dvdx);
  out.ryDirection = neighbour(ray.ryDirection, at.dudy, at.dvdy);
  return out;
}

// Light that comes to `at` by perfect reflection and by refraction. Li(ray, hit) is asked for what
// arrives along each of the (at most two) rays.
template <class Radiance>
Spectrum specularLight(const World& world, const RayDifferential& ray, const SurfaceInteraction& at,
                       const Bsdf& bsdf, Sampler& sampler, Radiance&& Li) {
  Spectrum L(0);
  if (!bsdf.has(kSpecular)) return L;
  for (const std::uint8_t side : {kReflection, kTransmission}) {
    const std::uint8_t lobe = side | kSpecular;
    if (bsdf.lobes(lobe) == 0) continue;
    const auto s = bsdf.sample(at.wo, sampler.get2D(), lobe);
    if (!s || isBlack(s->f)) continue;
    const RayDifferential next = specularRay(at, ray, *s);
    const Hit hit = world.intersect(next);
    Spectrum arriving = Li(next, hit);
    if (const VolumeIntegrator* volume = world.volume())
      arriving = volume->through(world, next, hit, arriving, sampler);
    L += s->f * (std::abs(glm::dot(s->wi, at.ns)) / s->pdf) * arriving;
  }
  return L;
}

}  // namespace pbrt
