#pragma once
// The layout fingerprint, computed anew by every plug-in that includes this and by the core.

#include "core/base/rng.h"
#include "core/plugin/kind.h"
#include "core/plugin/params.h"

namespace pbrt {

// A hash of what both sides of the plug-in boundary must agree on and no version number shows: the
// sizes of the value types, GLM's configuration, the compiler's ABI and C++ library.
constexpr std::uint64_t compiledFingerprint() {
  return hash(
      sizeof(Ray), sizeof(RayDifferential), sizeof(ObjectRay), sizeof(Bounds3), sizeof(Transform),
      sizeof(Frame), sizeof(SurfacePoint), sizeof(SurfaceInteraction), sizeof(ShapeHit),
      sizeof(AreaSample), sizeof(TriangleMesh), sizeof(LightSample), sizeof(CameraSample),
      sizeof(CameraRay), sizeof(BsdfSample), sizeof(Bsdf), sizeof(Hit), sizeof(World),
      sizeof(Light), sizeof(Textured<float>), sizeof(Textured<Spectrum>), sizeof(Light::Setup),
      sizeof(Camera::Setup), sizeof(Sampler::Setup), sizeof(Integrator::Setup), sizeof(Medium),
      sizeof(Medium::Setup), sizeof(Medium::Cell), sizeof(Texture<float>::Setup), sizeof(Params),
      sizeof(glm::vec3), alignof(glm::vec3), alignof(glm::vec4), GLM_VERSION, __GXX_ABI_VERSION,
#ifdef __GLIBCXX__
      1, _GLIBCXX_USE_CXX11_ABI
#else
      2
#endif
  );
}

}  // namespace pbrt
