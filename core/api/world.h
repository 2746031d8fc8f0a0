#pragma once
// What an integrator may ask of a scene.

#include <functional>
#include <span>
#include <vector>

#include "core/api/bsdf.h"
#include "core/api/camera.h"
#include "core/api/light_tree.h"
#include "core/api/medium.h"
#include "core/base/distribution.h"

namespace pbrt {

class ImplicitField;
class VolumeIntegrator;

// Which primitive a ray meets first, and where along it. Geometry and shading data are worked out
// only when surface() is asked.
struct Hit {
  float t = kInfinity;
  float u = 0, v = 0;
  std::uint32_t primitive = 0;
  std::uint32_t geometry = kNone;
  std::uint32_t instance = kNone;

  static constexpr std::uint32_t kNone = ~0U;
  bool found() const { return geometry != kNone; }
  // The shape or, of an instance, the whole of it: numbered in the order of the scene.
  std::uint32_t placed() const { return instance == kNone ? geometry : instance; }
};

// A shape of the scene that is where a field is zero (Shape::implicit()), in its place.
struct ImplicitSurface {
  const ImplicitField* field = nullptr;  // the scene owns it
  Transform toRender;                    // from the field's space; of one that moves, at the start
  std::uint32_t geometry = Hit::kNone, instance = Hit::kNone;  // as in a hit of it
  // Of one that moves: toRender at the time of a ray; valid as long as the scene. Empty: it rests.
  std::function<Transform(float time)> toRenderAt = {};

  bool isOf(const Hit& hit) const { return hit.geometry == geometry && hit.instance == instance; }
};

// All of them, in the order of the scene.
struct ImplicitSurfaces {
  std::vector<ImplicitSurface> surfaces;
  bool alone = true;  // whether the scene has no other shapes
};

class World {
 public:
  static constexpr int kBatch = 16;

  virtual ~World();

  virtual Hit intersect(const Ray& ray) const = 0;
  // Surfaces without a material do not block.
  virtual bool occluded(const Ray& ray) const = 0;
  // Up to kBatch rays at once, faster if they are alike (neighbouring pixels; one point and one
  // light). Occlusion: bit i tells of ray i.
  virtual void intersect(std::span<const Ray* const> rays, std::span<Hit> hits) const = 0;
  virtual std::uint32_t occluded(std::span<const Ray> rays) const = 0;

  // The point that a hit of this ray names; `hit` must be found. The footprint is filled in if
  // the ray has differentials.
  virtual SurfaceInteraction surface(const RayDifferential& ray, const Hit& hit) const = 0;
  // The scattering at a point, none if it has no material (after bump mapping, which turns `at`'s
  // shading frame).
  virtual Bsdf bsdf(SurfaceInteraction& at, Scratch& scratch) const = 0;

  // For those who look for surfaces without rays. Work that grows with the scene: ask once.
  virtual ImplicitSurfaces implicitSurfaces() const = 0;

  std::span<const Light* const> lights() const { return lights_; }
  std::span<const Light* const> infiniteLights() const { return infiniteLights_; }
  const LightTree& lightTree() const { return lightTree_; }
  // The lights by their power: column i is lights()[i].
  const Distribution2D& lightPowers() const { return lightPowers_; }
  // Radiance from the unit direction w for a ray that hits nothing.
  Spectrum escaped(const Vec3& w) const {
    Spectrum L(0);
    for (const Light* light : infiniteLights_) L += light->escaped(w);
    return L;
  }
  const Camera& camera() const { return *camera_; }
  const Bounds3& bounds() const { return bounds_; }
  // Whether any texture filters, so that rays should carry differentials.
  bool filters() const { return filters_; }
  // Whether anything moves while the shutter is open, so that rays should have a time.
  bool moves() const { return moves_; }

  // The media that lie wherever surfaces are.
  std::span<const Medium* const> regions() const { return regions_; }
  // What looks after them where the integrator does not; null: nobody, or there are none.
  const VolumeIntegrator* volume() const { return volume_; }
  // The medium about the camera; null: clear air.
  const Medium* cameraMedium() const { return cameraMedium_; }
  // Whether any medium has a surface as its border, so that rays should know which they are in.
  bool bordersMedia() const { return bordersMedia_; }

 protected:
  std::vector<const Light*> lights_;
  std::vector<const Light*> infiniteLights_;
  LightTree lightTree_;
  Distribution2D lightPowers_;
  const Camera* camera_ = nullptr;
  Bounds3 bounds_;
  bool filters_ = false;
  bool moves_ = false;
  std::vector<const Medium*> regions_;
  const VolumeIntegrator* volume_ = nullptr;
  const Medium* cameraMedium_ = nullptr;
  bool bordersMedia_ = false;
};

}  // namespace pbrt
