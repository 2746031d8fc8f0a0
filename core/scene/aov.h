#pragma once
// What a film can store beside the picture ("arbitrary output variables"): only what was asked for.

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "core/api/interaction.h"

namespace pbrt {

// A set of them, by or-ing. The channels are named as in pbrt-v4, depth as OpenEXR names it.
using AovSet = std::uint16_t;
enum Aov : AovSet {
  kVariance = 1,  // Variance.R, .G, .B: estimated variance of the pixel's value
  kAlbedo = 2,    // Albedo.R, .G, .B: light that the first surface sends back towards the camera
  kNormal = 4,    // N.X, .Y, .Z: its shading normal in world space, outward
  kPosition = 8,  // P.X, .Y, .Z: where it is in world space
  kDepth = 16,    // Z: its distance from the ray's start
  kSampleCount = 32,   // samples: how many were taken in the pixel
  kUv = 64,            // u, v: its parameters, by which textures are placed
  kTrueNormal = 128,   // Ng.X, .Y, .Z: its geometric normal in world space, outward
  kDerivatives = 256,  // dPdu.X, .Y, .Z and dPdv.X, .Y, .Z: of its place in world space
  kShape = 512,        // shape: which shape or instance it is, from 1 in the order of the scene;
                       // a float: beyond 2^24 neighbours share numbers
};
inline constexpr AovSet kEveryAov = 2 * kShape - 1;

// Those of the surface that few ask for.
inline constexpr AovSet kOfDetail = kUv | kTrueNormal | kDerivatives | kShape;
// Those that tell of the surface that is seen.
inline constexpr AovSet kOfSurface = kAlbedo | kNormal | kPosition | kDepth | kOfDetail;

// In the order of the bits: variance, albedo, normal, position, depth, samples, uv,
// geometricnormal, derivatives, shape.
std::span<const std::string_view> aovNames();
std::optional<AovSet> aovByName(std::string_view name);

// What a camera ray meets first. The film averages it over those samples taken in each pixel itself
// that met something (the reconstruction filter has no part in it), but the shape is that of the
// first such sample; pixels that saw none are 0.
struct FirstSurface {
  Spectrum albedo{0};
  Normal3 n{0};
  Point3 p{0};  // render space
  float depth = 0;
  Point2 uv{0};
  Normal3 trueN{0};
  Vec3 dpdu{0}, dpdv{0};
  std::uint32_t shape = 0;
};

}  // namespace pbrt
