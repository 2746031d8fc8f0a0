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
enum Aov : std::uint8_t {
  kVariance = 1,  // Variance.R, .G, .B: estimated variance of the pixel's value
  kAlbedo = 2,    // Albedo.R, .G, .B: light that the first surface sends back towards the camera
  kNormal = 4,    // N.X, .Y, .Z: its shading normal in world space, outward
  kPosition = 8,  // P.X, .Y, .Z: where it is in world space
  kDepth = 16,    // Z: its distance from the ray's start
  kSampleCount = 32,  // samples: how many were taken in the pixel
};

// Those that tell of the surface that is seen.
inline constexpr std::uint8_t kOfSurface = kAlbedo | kNormal | kPosition | kDepth;

std::span<const std::string_view> aovNames();  // variance, albedo, normal, position, depth, samples
std::optional<std::uint8_t> aovByName(std::string_view name);

// What a camera ray meets first.
struct FirstSurface {
  Spectrum albedo{0};
  Normal3 n{0};
  Point3 p{0};  // render space
  float depth = 0;
};

// All of them but the variance, which is the filtered picture's own. Sums over the samples taken in
// each pixel itself: the reconstruction filter has no part in them. Surfaces are averaged over the
// samples that met one; pixels that saw none are 0.
class AovSums {
 public:
  AovSums() = default;
  // `size` pixels in tiles of `tile`; `origin`: where render space's origin is in the world.
  // Throws std::bad_alloc or std::length_error.
  AovSums(std::uint8_t stored, Point2i size, int tile, const DPoint3& origin);

  bool stores(std::uint8_t any) const { return (stored_ & any) != 0; }
  // `pixel` counts from the tile's corner.
  void addSample(int tile, Point2i pixel) { ++counts_.row(tile, pixel.y)[pixel.x]; }
  void add(int tile, Point2i pixel, const FirstSurface& surface);

  // Appends those channels of `wanted` that are stored, over `window`, which counts from the first
  // pixel of all.
  void appendTo(Image& image, std::uint8_t wanted, const Bounds2i& window) const;

 private:
  struct Surfaces {
    glm::dvec3 albedo{0}, n{0}, p{0};
    double depth = 0, count = 0;
  };

  std::uint8_t stored_ = 0;
  glm::dvec3 origin_{0};
  BlockedArray<double> counts_;      // empty unless the sample count is stored
  BlockedArray<Surfaces> surfaces_;  // empty unless something of the surface is
};

}  // namespace pbrt
