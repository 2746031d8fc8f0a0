#include "core/scene/scene.h"

#include <bit>

#include "core/base/rng.h"
#include "core/scene/mesh.h"
#include "core/scene/placement.h"

namespace pbrt {

namespace {

// Blinn 1978: the surface p + d n has, for small slopes, dp'/du = dp/du + (dd/du) n + d dn/du,
// and its normal is their cross product. The slopes are differences over half a pixel.
void bump(SurfaceInteraction& s, const Textured<float>& d) {
  const auto step = [](float dx, float dy) {
    const float half = 0.5F * (std::abs(dx) + std::abs(dy));
    return half > 0 ? half : 0.0005F;
  };
  const float du = step(s.dudx, s.dudy), dv = step(s.dvdx, s.dvdy);
  const auto displaced = [&](const Vec3& dp, Point2 duv, const Normal3& dn, float h) {
    SurfaceInteraction moved = s;
    moved.p = s.p + h * dp;
    moved.uv = s.uv + h * duv;
    moved.ns = s.ns + h * dn;
    return d(moved);
  };
  const float here = d(s);
  const float slopeU = (displaced(s.dpdu, {1, 0}, s.dndu, du) - here) / du;
  const float slopeV = (displaced(s.dpdv, {0, 1}, s.dndv, dv) - here) / dv;
  const Vec3 dpdu = s.dpdu + slopeU * s.ns + here * s.dndu;
  const Vec3 dpdv = s.dpdv + slopeV * s.ns + here * s.dndv;
  const Vec3 n = glm::cross(dpdu, dpdv);
  if (const float l2 = lengthSquared(n); l2 > 0 && std::isfinite(l2)) {
    s.ns = faceForward(n / std::sqrt(l2), s.ns);
    s.tangent = dpdu;
  }
}

}  // namespace

double Scene::treeSeconds() const {
  double seconds = root_.accel.buildSeconds();
  for (const auto& object : objects_) seconds += object->accel.buildSeconds();
  return seconds;
}

SurfaceInteraction Scene::surface(const RayDifferential& ray, const Hit& hit) const {
  const Instance* place = instance(hit);
  const Geometry& g = geometry(hit);

  std::optional<Transform> moved;
  const float fraction = root_.accel.fraction(ray);
  if (place && place->motion) moved = place->motion->at(fraction);
  const Transform* toRender = moved ? &*moved : place ? &place->toRender : nullptr;

  SurfaceInteraction s;
  if (g.mesh) {
    s = meshSurface(*g.mesh, hit, g.flip, g.reverse);
    if (toRender) transformInteraction(s, *toRender);
  } else {
    const ShapeHit shapeHit{hit.t, hit.u, hit.v, hit.primitive};
    s = placedSurface(*g.shape, toRender ? *toRender * g.toGroup : g.toGroup, g.reverse, ray,
                      shapeHit);
  }
  if (toRender)
    s.error += moved ? place->motion->error(fraction, *moved, s.p) : instanceError(*toRender, s.p);
  s.wo = -glm::normalize(ray.d);
  s.time = ray.time;
  s.material = g.material.get();
  s.light = g.light.get();
  s.media = g.media;
  if (ray.hasDifferentials) setFootprint(s, ray);
  return s;
}

// In between, a ray is stopped with the chance alpha. The chance is drawn from the ray and what it
// hits (as pbrt-v4 does): the same ray always sees the same, and layers do not depend on each
// other.
bool Scene::keeps(const Ray& ray, const Hit& hit, bool shadow) const {
  const Geometry& g = geometry(hit);
  if (!g.material && shadow) return false;
  if (!g.cutout) return true;
  const Cutout& cutout = *g.cutout;
  const SurfaceInteraction at = surface(RayDifferential(ray), hit);
  float alpha = cutout.alpha(at);
  if (shadow) alpha = std::min(alpha, cutout.shadowAlpha(at));
  if (!cutout.partial || alpha >= 1) return alpha > 0;
  const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
  const std::uint64_t h =
      hash(bits(ray.o.x), bits(ray.o.y), bits(ray.o.z), bits(ray.d.x), bits(ray.d.y), bits(ray.d.z),
           hit.primitive, hit.geometry, hit.instance, glm::dot(at.n, ray.d) > 0);
  return uniformFloat(static_cast<std::uint32_t>(h >> 32U)) < alpha;
}

Bsdf Scene::bsdf(SurfaceInteraction& at, Scratch& scratch) const {
  if (!at.material) return Bsdf(at);
  if (const Textured<float>* height = at.material->bumpMap()) bump(at, *height);
  Bsdf bsdf(at);
  at.material->scatter(at, bsdf, scratch);
  return bsdf;
}

ImplicitSurfaces Scene::implicitSurfaces() const {
  ImplicitSurfaces all;
  const auto add = [&](const Group& group, const Transform& toRender, const Motion* motion,
                       std::uint32_t instance) {
    for (std::size_t i = 0; i < group.geometries.size(); ++i) {
      const Geometry& g = *group.geometries[i];
      const ImplicitField* field = g.mesh ? nullptr : g.shape->implicit();
      all.alone = all.alone && field;
      if (!field) continue;
      all.surfaces.push_back(
          {field, toRender * g.toGroup, static_cast<std::uint32_t>(i), instance});
      if (motion)
        all.surfaces.back().toRenderAt = [this, motion, &g](float time) {
          Ray ray;
          ray.time = time;
          return motion->at(root_.accel.fraction(ray)) * g.toGroup;
        };
    }
  };
  add(root_, Transform(), nullptr, Hit::kNone);
  for (std::size_t i = 0; i < instances_.size(); ++i) {
    const Instance& place = instances_[i];
    const Motion* motion = place.motion ? &*place.motion : nullptr;
    add(*place.group, motion ? motion->at(0) : place.toRender, motion,
        static_cast<std::uint32_t>(root_.geometries.size() + i));
  }
  return all;
}

}  // namespace pbrt
