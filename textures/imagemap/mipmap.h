#pragma once
// A picture at all sizes from its own down to one texel (Williams 1983, "Pyramidal Parametrics"),
// and the ways to look something up in it.

#include <memory>

#include "core/api/mapping.h"
#include "core/base/picture.h"

namespace pbrt {

// The nearest texel, or between the four nearest, of the level that is just finer than the
// footprint; between the two levels next to its size; or the mean under an ellipse.
enum class TexelFilter : std::uint8_t { point, bilinear, trilinear, ewa };

struct Lookup {
  TexelFilter filter = TexelFilter::ewa;
  Wrap wrap = Wrap::repeat;
  float maxAnisotropy = 8;  // >= 1: the most by which an ellipse is longer than wide
};

class MipMap {
 public:
  MipMap() = default;
  MipMap(const MipMap&) = delete;
  MipMap& operator=(const MipMap&) = delete;
  virtual ~MipMap() = default;

  // st is in the unit square, (0, 0) at the corner of the first texel of the top row. Always
  // finite.
  virtual Spectrum at(const TexturePoint& p, const Lookup& how) const = 0;
  virtual int levels() const = 0;
};

// Of the colours of a picture (see colorChannels), raised to `gamma`; 0 stands for the sRGB curve.
// Code values that fit a byte are kept so, grey ones once. Throws Error in the name of `file`.
constexpr float kSrgbCurve = 0;
std::unique_ptr<MipMap> makeMipMap(const Image& image, float gamma,
                                   const std::filesystem::path& file);

}  // namespace pbrt
