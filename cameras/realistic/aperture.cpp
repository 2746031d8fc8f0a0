#include "cameras/realistic/aperture.h"

#include <array>

namespace pbrt {

namespace {

constexpr double kPentagonRadius = 0.8;
const double kCos36 = std::cos(std::numbers::pi / 5), kCos72 = std::cos(2 * std::numbers::pi / 5);
const double kSin36 = std::sin(std::numbers::pi / 5), kSin72 = std::sin(2 * std::numbers::pi / 5);

// Of five lines about the middle, `distance` away, the first of them on the side of the angle
// `first`: beyond how many of them p lies.
int beyond(const glm::dvec2& p, double distance, double first) {
  int n = 0;
  for (int k = 0; k < 5; ++k) {
    const double angle = first + 2 * std::numbers::pi / 5 * k;
    if (p.x * std::cos(angle) + p.y * std::sin(angle) > distance) ++n;
  }
  return n;
}

}  // namespace

// The areas by which pi is divided are those of the square, of five triangles, of ten triangles
// between a star's tip and a notch at cos 72 / cos 36, and the integral of the bell over the disc,
// pi (1 - 2 / e).
Aperture::Aperture(Params& p) {
  const std::string name =
      p.text("aperture", "",
             "the stop's shape: gaussian, square, pentagon, star or a picture; a circle if absent");
  constexpr double pi = std::numbers::pi;
  if (name.empty()) return;
  if (name == "gaussian") {
    shape_ = Shape::gaussian;
    scale_ = 1 / (1 - 2 / std::numbers::e);
  } else if (name == "square") {
    shape_ = Shape::square;
    scale_ = pi;
  } else if (name == "pentagon") {
    shape_ = Shape::pentagon;
    scale_ = pi / (2.5 * sqr(kPentagonRadius) * kSin72);
  } else if (name == "star") {
    shape_ = Shape::star;
    scale_ = pi / (5 * kCos72 / kCos36 * kSin36);
  } else {
    shape_ = Shape::picture;
    picture_.emplace(p.file("aperture", "a picture"));
    const double sum = integral();
    if (!(sum > 0)) p.fail("aperture", "is black within the disc: no light goes through");
    scale_ = pi / sum;
  }
}

// By the midpoints of squares no larger than the picture's pixels.
double Aperture::integral() const {
  const int w = std::max(256, picture_->width()), h = std::max(256, picture_->height());
  double sum = 0;
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) sum += through({(2.0 * x + 1) / w - 1, (2.0 * y + 1) / h - 1});
  return sum * 4 / w / h;
}

double Aperture::through(const glm::dvec2& p) const {
  constexpr double pi = std::numbers::pi;
  const double r2 = glm::dot(p, p);
  if (!(r2 <= 1)) return 0;
  switch (shape_) {
    case Shape::circle:
      return 1;
    case Shape::gaussian:
      return scale_ * (std::exp(-r2) - std::exp(-1.0));
    case Shape::square:
      return std::max(std::abs(p.x), std::abs(p.y)) <= 0.5 ? scale_ : 0;
    case Shape::pentagon:  // it stands on its tip
      return beyond(p, kPentagonRadius * kCos36, pi / 2) == 0 ? scale_ : 0;
    case Shape::star:  // its lines are those that the sides of its inner pentagon lie on
      return beyond(p, kCos72, pi) <= 1 ? scale_ : 0;
    case Shape::picture:
      break;
  }
  const Spectrum c =
      picture_->at({0.5 + 0.5 * p.x, 0.5 - 0.5 * p.y}, Wrap::black);  // the first row is on top
  return scale_ * (double{c.x} + c.y + c.z) / 3;
}

}  // namespace pbrt
