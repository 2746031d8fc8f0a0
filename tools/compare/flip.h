#pragma once
// FLIP: how different two pictures look to a person who flips back and forth between them.

#include <numbers>
#include <vector>

#include "core/base/image.h"
#include "tools/compare/colormap.h"  // heatMap shows the values

namespace pbrt {

struct FlipMap {
  std::vector<float> values;  // per pixel in scanline order, 0 (looks the same) to 1
  double mean = 0;            // of the values
};

// The viewer of the papers: a screen with 3840 pixels across, as wide as its distance from the eye,
// so that one degree covers distance * pi / 180.
inline constexpr double kPixelsPerDegree = 3840 * std::numbers::pi / 180;

// Both compare the linear Rec. 709 channels R, G and B of two pictures seen at this many pixels per
// degree of visual angle, from 1 to 1000. A pixel that is not finite in one of the pictures has the
// error 1 and is black in both for its neighbours. Values below 0 count as 0. Throw Error,
// Failure::usage, unless both pictures have R, G and B over the same, not empty, window.

// LDR-FLIP (Andersson et al. 2020) of the pictures as a screen shows them: values above 1 are cut
// off. Symmetric in the two pictures.
FlipMap flip(const Image& reference, const Image& test, double pixelsPerDegree = kPixelsPerDegree);

// HDR-FLIP (Andersson et al. 2021): the largest LDR-FLIP of each pixel over the exposures that suit
// the reference, from one that shows its brightest pixel to one that shows its median. If half the
// reference is black, the median is that of the rest; if all of it is, the exposure is 0.
FlipMap flipHdr(const Image& reference, const Image& test,
                double pixelsPerDegree = kPixelsPerDegree);

}  // namespace pbrt
