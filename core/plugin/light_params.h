#pragma once
// The parameters that lights share.

#include "core/api/light.h"
#include "core/plugin/params.h"

namespace pbrt {

// What multiplies a light: a colour, or in pbrt-v4 a number.
inline Spectrum readLightScale(Params& p) {
  return p.texture<Spectrum>("scale", 1, "multiplies the light")(SurfaceInteraction());
}

// A positive number that pbrt-v4 gives instead of a light's strength: what a white light of colour
// 1 would have it divided by `ofOne`, by which the light is to be multiplied. 1 if it is absent or,
// as pbrt-v4 has it, not positive; or if the light is black, or too dark to be multiplied so far.
inline float readTotal(Params& p, const std::string& name, float ofOne, std::string_view meaning,
                       std::string_view unit) {
  const float total = p.optionalNumber(name, meaning, unit).value_or(0);
  return total > 0 && std::isfinite(total / ofOne) ? total / ofOne : 1;
}

// Of a point at `p` that shines into the directions of the cone with this intensity.
inline LightBounds boundsOfPoint(const Point3& p, double intensity,
                                 const DirectionCone& cone = {}) {
  return {{p, p}, intensity, cone};
}

// How many samples direct lighting takes of a light that has an extent.
inline int readLightSamples(Params& p) {
  constexpr int most = 1 << 20;
  const int n = p.integer("nsamples", 1, 1, most, "shadow rays that direct lighting takes");
  return p.integer("samples", n, 1, most, "another name of nsamples, which it overrides");
}

// The picture that a light shines through, under either of its names: "mapname" of pbrt-v1 to v3,
// "filename" of v4. Empty if there is none.
inline std::filesystem::path readLightPicture(Params& p) {
  const std::filesystem::path mapname =
      p.file("mapname", "the picture: .exr, .hdr, .pfm, .png or .tga");
  const std::filesystem::path filename = p.file("filename", "another name of mapname");
  if (!mapname.empty() && !filename.empty())
    p.fail("filename", "is given beside \"mapname\", which means the same");
  return mapname.empty() ? filename : mapname;
}

}  // namespace pbrt
