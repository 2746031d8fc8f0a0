#pragma once
// The parameters that media share.

#include <span>

#include "core/api/medium.h"
#include "core/plugin/params.h"

namespace pbrt {

// What a medium is made of where its density is 1.
struct MediumParams {
  MediumPoint unit;
  float g = 0;
};

// Parameters sigma_a, sigma_s, preset, presetfirst, scale, g, Le and thermal.
MediumParams readMedium(Params& p);

struct MediumBox {
  DPoint3 lo{0}, hi{1};
};
// Parameters p0 and p1, opposite corners.
MediumBox readMediumBox(Params& p);

// Parameters nx, ny and nz, the numbers of voxels.
glm::ivec3 readVoxels(Params& p);
// Fails unless there are `count` values, one for each voxel.
void checkVoxels(const Params& p, const std::string& name, const glm::ivec3& n, std::size_t count);

// Parameter radiancescale, of radiance that no spectrum of a light tells.
float readRadianceScale(Params& p);

// Fails where a value, or a component of it, is negative or not finite.
void checkNonNegative(const Params& p, const std::string& name, std::span<const float> values);
Spectrum readNonNegative(Params& p, const std::string& name, float fallback,
                         std::string_view meaning);
std::vector<float> readDensities(Params& p, const std::string& name, std::string_view meaning);

}  // namespace pbrt
