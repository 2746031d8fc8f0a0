#pragma once
// The hole in a lens that decides how much light comes through, and the shape of what is blurred.

#include <optional>

#include "core/base/picture.h"
#include "core/plugin/params.h"

namespace pbrt {

class Aperture {
 public:
  // Reads "aperture": nothing, one of the names that pbrt-v4 has, or a picture.
  explicit Aperture(Params& p);

  // How much goes through at p, in radii of the stop from its middle; x right and y up, seen from
  // the film. Outside of the unit circle nothing does. The integral is pi whatever the shape: all
  // make pictures equally bright.
  double through(const glm::dvec2& p) const;

 private:
  double integral() const;  // of a picture

  enum class Shape : std::uint8_t { circle, gaussian, square, pentagon, star, picture };

  Shape shape_ = Shape::circle;
  double scale_ = 1;
  std::optional<Picture> picture_;
};

}  // namespace pbrt
