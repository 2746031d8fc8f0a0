#pragma once
// Noise that solid textures are made of.

#include "core/base/math.h"

namespace pbrt {

// Smooth, from -1 to 1, 0 at whole numbers, with features about as wide as one unit, the same again
// every 256 units (Perlin 2002, "Improving Noise"). Finite for every finite point.
float noise(const DPoint3& p);

// Sums of noise at ever finer scales, each 1.99 times as fine and `roughness` times as strong as
// the one before: of the noise itself (fractional Brownian motion), or of its absolute value
// (turbulence). Of `octaves` scales, at most 64, those that are finer than the footprint of a
// pixel, dx and dy, are faded out.
float fbm(const DPoint3& p, const DVec3& dx, const DVec3& dy, float roughness, int octaves);
float turbulence(const DPoint3& p, const DVec3& dx, const DVec3& dy, float roughness, int octaves);

}  // namespace pbrt
