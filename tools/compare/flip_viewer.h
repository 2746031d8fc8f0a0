#pragma once
// The eye of FLIP: which colours and features it tells apart at a distance. "2020" is Andersson et
// al. 2020, see flip.cpp.

#include <array>
#include <vector>

#include "core/base/math.h"

namespace pbrt {

// Weights at -r ... r pixels.
using Kernel = std::vector<double>;
inline int radius(const Kernel& k) {
  return static_cast<int>(k.size()) / 2;
}

// CIE 1976 L*a*b* of XYZ over that of white, its chroma scaled by lightness since colours look
// stronger in more light (2020, section 4.1, after Hunt 1952).
DVec3 huntLab(const DVec3& xyz);

// Between two such colours: the power 0.7 (2020, section 4.1) of their distance HyAB, which holds
// for large differences too (Abasi, Tehran, Fairchild 2020).
double colourDistance(const DVec3& a, const DVec3& b);

struct Viewer {
  // Throws Error, Failure::usage, if the pixels per degree are not within 1 to 1000.
  explicit Viewer(double pixelsPerDegree);

  // Between XYZ, each over that of white, and linear Rec. 709.
  glm::dmat3 toXyz, toRgb;
  double largestDistance;  // of two colours of a screen: green and blue

  // What is left of an opponent channel at a distance (2020, section 4.1). The sensitivity to f
  // cycles per degree, exp(-b f^2), has the inverse transform exp(-pi^2 x^2 / b), x in degrees, a
  // kernel for both directions. That of blue-yellow is a sum of two, a sqrt(pi / b)
  // exp(-pi^2 (x^2 + y^2) / b): one kernel along y, and one along x which has the term's share.
  Kernel lightness, redGreen;
  std::array<std::array<Kernel, 2>, 2> blueYellow;
  // Features: a Gaussian, and its first and second derivative across the edge or point (4.2).
  Kernel blur, edge, point;
};

}  // namespace pbrt
