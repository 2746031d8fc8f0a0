#pragma once
// Implicit surfaces of known trouble, for the tests of what finds and shades them.

#include "core/plugin/formula.h"

namespace pbrt::test {

inline Bounds3 cube(float half) {
  return {Point3(-half), Point3(half)};
}

struct Ball {
  double r = 1;
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    return r * r - (sqr(x) + sqr(y) + sqr(z));
  }
  Bounds3 bounds() const { return cube(static_cast<float>(1.01 * r)); }
};

struct Torus {
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    return 0.0625 - sqr(sqrt(sqr(x) + sqr(y)) - 0.75) - sqr(z);
  }
  Bounds3 bounds() const { return cube(1.1F); }
};

// Infinitely many sheets, cut off by the box.
struct Gyroid {
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    return sin(6 * x) * cos(6 * y) + sin(6 * y) * cos(6 * z) + sin(6 * z) * cos(6 * x);
  }
  Bounds3 bounds() const { return cube(1); }
};

// 65 double points. (Barth 1996.)
struct BarthSextic {
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    const double g = sqr(0.5 * (1 + std::sqrt(5.0)));
    const T xx = sqr(x), yy = sqr(y), zz = sqr(z);
    return (2 * g - 1) * sqr(xx + yy + zz - 1) - 4 * (g * xx - yy) * (g * yy - zz) * (g * zz - xx);
  }
  Bounds3 bounds() const { return cube(1.6F); }
};

// A cusp at the top, a point at the bottom. (Taubin 1993.)
struct Heart {
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    return sqr(x) * pow(z, 3) + 0.1125 * sqr(y) * pow(z, 3) -
           pow(sqr(x) + 2.25 * sqr(y) + sqr(z) - 1, 3);
  }
  Bounds3 bounds() const { return cube(1.4F); }
};

// Two planes a millionth apart.
struct Sheets {
  template <class T>
  T operator()(const T&, const T&, const T& z) const {
    return z * (1e-6 - z);
  }
  Bounds3 bounds() const { return cube(1); }
};

// A step of width 1e-6 at a sphere.
struct Steep {
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    return 1 / (1 + exp(1e6 * (sqr(x) + sqr(y) + sqr(z) - 1))) - 0.5;
  }
  Bounds3 bounds() const { return cube(1.1F); }
};

// Kinks: a cube with a hole along z, less a ball.
struct Solid {
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    const T box = 0.8 - max(abs(x), max(abs(y), abs(z)));
    const T hole = 0.16 - sqr(x) - sqr(y);
    const T ball = 0.25 - sqr(x - 0.8) - sqr(y - 0.8) - sqr(z - 0.8);
    return min(box, min(-hole, -ball));
  }
  Bounds3 bounds() const { return cube(1); }
};

// No value where x < 0, and no bound above x = 0.
struct Logarithm {
  template <class T>
  T operator()(const T& x, const T& y, const T&) const {
    return log(x) + 1 + 0.3 * sqrt(y);
  }
  Bounds3 bounds() const { return cube(1); }
};

// The plane x = 1e-4, by a formula that has no value where x < 0 and is steepest there.
struct Brink {
  template <class T>
  T operator()(const T& x, const T&, const T&) const {
    return 0.01 - sqrt(x);
  }
  Bounds3 bounds() const { return {Point3(-1), Point3(0.9F)}; }
};

// Almost a cylinder of radius 1, within which alone there are values.
struct Barrel {
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    return sqrt(1 - sqr(x) - sqr(y)) - 0.05 - 0.001 * sqr(z);
  }
  Bounds3 bounds() const { return {Point3(-1.1F), Point3(1)}; }
};

// Zero at x = 0.4 and 0.6, without values where x < 0, by the other solid.
struct Cut {
  template <class T>
  T operator()(const T& x, const T&, const T&) const {
    return min(5 + sqrt(x), sqr(x - 0.5) - 0.01);
  }
  Bounds3 bounds() const { return {Point3(-1.4F), Point3(1)}; }
};

// Zero nowhere but at x = 1/2: the sign changes at the pole at x = 0, too.
struct Pole {
  template <class T>
  T operator()(const T& x, const T&, const T&) const {
    return 1 / x - 2;
  }
  Bounds3 bounds() const { return cube(1); }
};

}  // namespace pbrt::test
