#pragma once
// What a film can store beside the picture ("arbitrary output variables"): only what was asked for.

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "core/api/interaction.h"
#include "core/base/blocked_array.h"
#include "core/base/image.h"

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
inline constexpr AovSet kEveryAov = ~AovSet{0};

// Those of the surface that few ask for.
inline constexpr AovSet kOfDetail = kUv | kTrueNormal | kDerivatives | kShape;
// Those that tell of the surface that is seen.
inline constexpr AovSet kOfSurface = kAlbedo | kNormal | kPosition | kDepth | kOfDetail;

// In the order of the bits: variance, albedo, normal, position, depth, samples, uv,
// geometricnormal, derivatives, shape.
std::span<const std::string_view> aovNames();
std::optional<AovSet> aovByName(std::string_view name);

// What a camera ray meets first.
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

// All of them but the variance, which is the filtered picture's own. Sums over the samples taken in
// each pixel itself: the reconstruction filter has no part in them. Surfaces are averaged over the
// samples that met one, but the shape is that of the first such sample; pixels that saw none are 0.
class AovSums {
 public:
  AovSums() = default;
  // `size` pixels in tiles of `tile`; `origin`: where render space's origin is in the world.
  // Throws std::bad_alloc or std::length_error.
  AovSums(AovSet stored, Point2i size, int tile, const DPoint3& origin);
  // What they would take of memory.
  static double bytes(AovSet stored, Point2i size, int tile);

  bool stores(AovSet any) const { return (stored_ & any) != 0; }
  // `pixel` counts from the tile's corner.
  void addSample(int tile, Point2i pixel) { ++counts_.row(tile, pixel.y)[pixel.x]; }
  void add(int tile, Point2i pixel, const FirstSurface& surface);

  // Appends those channels of `wanted` that are stored, over `window`, which counts from the first
  // pixel of all.
  void appendTo(Image& image, AovSet wanted, const Bounds2i& window) const;

 private:
  struct Surfaces {
    glm::dvec3 albedo{0}, n{0}, p{0};
    double depth = 0, count = 0;
  };
  // What few ask for.
  struct Details {
    glm::dvec2 uv{0};
    glm::dvec3 n{0}, dpdu{0}, dpdv{0};
    double count = 0;
    std::uint32_t shape = 0;
  };

  AovSet stored_ = 0;
  glm::dvec3 origin_{0};
  BlockedArray<double> counts_;      // empty unless the sample count is stored
  BlockedArray<Surfaces> surfaces_;  // empty unless something else of the surface is
  BlockedArray<Details> details_;    // empty unless any of kOfDetail is
};

}  // namespace pbrt
