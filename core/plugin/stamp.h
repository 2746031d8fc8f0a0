#pragma once
// The stamp: what both sides of the plug-in boundary must agree on, as plain data that every
// plug-in carries and that can be read before anything of it runs. docs/decisions/plugin-abi.md
// says what each field is for.

#include <array>
#include <cstddef>

#include "core/base/rng.h"
#include "core/plugin/implicit_surface.h"
#include "core/plugin/kind.h"
#include "core/plugin/params.h"

namespace pbrt {

// Raised by hand, once a release, when an interface of core/api or core/plugin changes its meaning,
// its virtual functions or its functions that plug-ins call.
inline constexpr std::uint32_t kAbiVersion = 3;

// What a compiler can be told that changes what crosses the boundary.
enum BuildOption : std::uint32_t {
  kLibcxx = 1,
  kOldStrings = 2,
  kDebugContainers = 4,
  kAddressSanitizer = 8,
  kThreadSanitizer = 16,
  kMemorySanitizer = 32,
};

// g++ has a macro for each sanitizer, clang a feature.
#ifdef __has_feature
#define PBRT_HAS_FEATURE(feature) __has_feature(feature)
#else
#define PBRT_HAS_FEATURE(feature) 0
#endif

consteval std::uint32_t buildOptions() {
  std::uint32_t options = 0;
#ifdef _LIBCPP_VERSION
  options |= kLibcxx;
#elif !_GLIBCXX_USE_CXX11_ABI
  options |= kOldStrings;
#endif
#ifdef _GLIBCXX_DEBUG
  options |= kDebugContainers;
#endif
#if defined(__SANITIZE_ADDRESS__) || PBRT_HAS_FEATURE(address_sanitizer)
  options |= kAddressSanitizer;
#endif
#if defined(__SANITIZE_THREAD__) || PBRT_HAS_FEATURE(thread_sanitizer)
  options |= kThreadSanitizer;
#endif
#if PBRT_HAS_FEATURE(memory_sanitizer)
  options |= kMemorySanitizer;
#endif
  return options;
}

#undef PBRT_HAS_FEATURE

template <class... T>
consteval std::uint64_t sizesOf() {
  return hash(hash(sizeof(T), alignof(T))...);
}

// Of GLM what changes the layout of its types, how they are passed (swizzles send them through
// other registers) or what a fresh one holds. Versions that agree in this work together.
consteval std::uint64_t glmConfiguration() {
  return hash(sizesOf<glm::vec2, glm::vec3, glm::vec4, glm::dvec2, glm::dvec3, glm::dvec4,
                      glm::ivec2, glm::ivec3, glm::mat4, glm::dmat4, glm::length_t>(),
              std::is_trivially_default_constructible_v<glm::vec3>, GLM_CONFIG_SWIZZLE,
              GLM_CONFIG_XYZW_ONLY);
}

// Sizes of all that plug-ins exchange with the core or derive from, and of what the C++ library
// puts into it; where fields could change places unseen, their offsets.
consteval std::uint64_t layout() {
  return hash(
      sizesOf<std::string, std::vector<float>, std::shared_ptr<int>, std::optional<float>,
              std::function<void()>, std::filesystem::path, Scratch>(),
      sizesOf<Ray, RayDifferential, ObjectRay, Bounds3, Transform, Frame, DirectionCone, Interval,
              Distribution2D, Error, Diagnostic, Location>(),
      sizesOf<SurfacePoint, SurfaceInteraction, ShapeHit, AreaSample, AreaSampler, TriangleMesh,
              Shape, MeshShape, SurfaceColor>(),
      sizesOf<Range, FieldPoint, FieldRange, LineRange, ImplicitField, ImplicitShape>(),
      sizesOf<Light, Light::Setup, LightSample, LightBounds, LightTree>(),
      sizesOf<Camera, Camera::Setup, CameraSample, CameraRay, Filter, Sampler, Sampler::Setup>(),
      sizesOf<Material, Bxdf, Bsdf, BsdfSample, Texture<float>, Texture<float>::Setup,
              Texture<Spectrum>, Textured<float>, Textured<Spectrum>>(),
      sizesOf<Medium, Medium::Setup, Medium::Cell, MediumPoint, MediumInterface>(),
      sizesOf<Integrator, Integrator::Setup, SamplingIntegrator, VolumeIntegrator, World, Hit>(),
      sizesOf<Params, Param, ParamType, Declaration, TextureLibrary>(), kPluginKinds,
      offsetof(Ray, tMin), offsetof(Ray, d), offsetof(Ray, tMax), offsetof(Ray, time),
      offsetof(ObjectRay, d), offsetof(ObjectRay, tMin), offsetof(ShapeHit, primitive),
      offsetof(Hit, primitive), offsetof(Hit, instance), offsetof(SurfacePoint, error),
      offsetof(SurfacePoint, n), offsetof(SurfacePoint, uv), offsetof(SurfacePoint, dndu),
      offsetof(SurfaceInteraction, n), offsetof(SurfaceInteraction, wo),
      offsetof(SurfaceInteraction, uv), offsetof(SurfaceInteraction, tangent),
      offsetof(SurfaceInteraction, time), offsetof(SurfaceInteraction, light),
      offsetof(SurfaceInteraction, objectP), offsetof(FieldPoint, gradient),
      offsetof(FieldRange, gradient), offsetof(LineRange, slope), offsetof(Range, hi),
      offsetof(LightSample, wi), offsetof(LightSample, p), offsetof(LightSample, pdf),
      offsetof(BsdfSample, wi), offsetof(BsdfSample, pdf), offsetof(AreaSample, n),
      offsetof(AreaSample, pdf));
}

// By default that of whoever compiles this. In every version the magic text and the ABI number
// come first; the rest may be read if the number agrees.
struct PluginStamp {
  std::array<char, 24> magic{"\x7fpbrt plug-in stamp"};
  std::uint32_t abi = kAbiVersion;
  std::uint32_t options = buildOptions();
  std::uint64_t glm = glmConfiguration();
  std::uint64_t layout = pbrt::layout();

  bool operator==(const PluginStamp&) const = default;
};

// Why a plug-in of this stamp cannot be used here, and what to do about it; empty if it can.
std::string refusal(const PluginStamp& stamp);
// Why this file must not be opened: it is no whole shared object for this machine, or one with
// another stamp or none. Nothing of it runs. Empty: it may be opened.
std::string refusal(const std::filesystem::path& file);

}  // namespace pbrt
