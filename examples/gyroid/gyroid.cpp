// A ball cut out of a gyroid (Schoen 1970), the surface of
//   sin x cos y + sin y cos z + sin z cos x = 0,
// which divides space into two mazes, as a wall of some thickness. Only its formula is written: it
// is above zero within the wall. The base class finds where rays meet it.

#include "core/plugin/implicit_shape.h"

namespace {

using namespace pbrt;

struct Gyroid {
  explicit Gyroid(Params& p)
      : radius(p.positive("radius", 1, "of the ball", "scene units")),
        period(p.positive("period", 0.8F, "after which the maze repeats", "scene units")),
        thickness(p.inRange("thickness", 0.1F, 0.01F, 0.3F, "of the wall, in periods")) {
    if (!(period > radius / 50)) p.fail("period", "must not be that small beside the radius");
  }

  // In plain arithmetic and sqr, sqrt, pow, abs, min, max, exp, log, sin and cos without std::, as
  // T is more than a number: it carries derivatives, and ranges over boxes.
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    const double k = 2 * std::numbers::pi / period;
    const T a = k * x, b = k * y, c = k * z;
    const T sheet = sin(a) * cos(b) + sin(b) * cos(c) + sin(c) * cos(a);
    // At the sheet the sum changes by about 1.5 in a unit of a: so much at half the thickness.
    const T wall = 0.5 * 1.5 * 2 * std::numbers::pi * thickness - abs(sheet);
    const T ball = (radius * radius - (sqr(x) + sqr(y) + sqr(z))) / (2 * radius * period);
    return min(wall, ball);
  }

  // Where the surface is looked for.
  Bounds3 bounds() const { return {Point3(-1.001F * radius), Point3(1.001F * radius)}; }

  float radius, period, thickness;
};

}  // namespace

PBRT_PLUGIN(Shape, FormulaShape<Gyroid>, "gyroid",
            "a ball cut out of a gyroid, a maze of two parts")
