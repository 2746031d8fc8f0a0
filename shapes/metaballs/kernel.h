#pragma once
// Kernels: how the field of an atom falls off, as functions of q = r^2 / h^2, the squared distance
// from the atom's centre over its squared support radius.
//
// A kernel is a type with the value K, the slope K' and the curvature K'' as functions of q >= 0,
// for plain numbers and for lanes, and the constants that Power explains. One that is no power of 1
// - q has a Taylor series too, see Gaussian. All that the proofs elsewhere ask of it: on [0, 1] K
// falls, is convex and at most 1, and K'' falls; from q = 1 on K is zero. Then over any [q0, q1] K
// lies between a tangent and the secant, and F is continuous. A further kernel is such a type, a
// name in kKernels and a case in withKernel.

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string_view>

#include "shapes/metaballs/lanes.h"

namespace pbrt::metaballs {

enum class Kernel : std::uint8_t { poly6, wyvill, blob, gaussian };
// In the order of the enumeration.
inline constexpr std::array<std::string_view, 4> kKernels{"poly6", "wyvill", "blob", "gaussian"};

// The field of one atom is strength * scale(kernel, h) * K(r^2 / h^2). poly6 integrates to one over
// space (Mueller, Charypar and Gross 2003, eq. 20), so it has the unit 1 / volume.
inline double scale(Kernel kernel, double h) {
  return kernel == Kernel::poly6 ? 315 / (64 * std::numbers::pi * h * h * h) : 1;
}

inline namespace PBRT_LANES {

// a^N.
template <int N, class V>
V power(V a) {
  if constexpr (N == 0)
    return a - a + 1;
  else if constexpr (N == 1)
    return a;
  else
    return a * power<N - 1>(a);
}

// (1 - q)^N.
template <int N>
struct Power {
  static constexpr int kExponent = N;
  // Which powers of q make up K along a ray (see Chord).
  static constexpr bool kCubic = N == 3, kQuadratic = N == 2, kLinear = false;
  static constexpr int kRounding = 8;  // relative error of a value, in epsilons
  // |second derivative of K(|x|^2 / h^2)| in any direction is at most kBend / h^2; the first jumps
  // by at most kJump / h where the support ends.
  static constexpr double kBend = N == 3 ? 6 : 8, kJump = 0;

  template <class V>
  static V value(V q) {
    return power<N>(positivePart(1 - q));
  }
  template <class V>
  static V slope(V q) {
    return -N * power<N - 1>(positivePart(1 - q));
  }
  template <class V>
  static V curvature(V q) {
    return q < 1 ? N * (N - 1) * power<N - 2>(1 - q) : V{};
  }
};

// exp(-b q) lowered by exp(-b), so that it is continuous where the support ends
// (Blinn 1982, "A Generalization of Algebraic Surface Drawing", with a finite support).
struct Gaussian {
  static constexpr double kB = 4;
  static constexpr double kEnd = 0.018315638888734179;  // exp(-b)
  static constexpr bool kCubic = true, kQuadratic = true, kLinear = true;
  static constexpr int kRounding = 64;
  static constexpr double kBend = 2 * kB, kJump = 2 * kB * kEnd * 1.01;

  // exp(-b q) = exp(-b q / 16)^16; the Taylor series of the root, at most 1/4 away from zero, is
  // exact to below the rounding of a lane.
  template <class V>
  static V exponential(V q) {
    const V x = q * static_cast<Lane<V>>(-kB / 16);
    V root = x - x + 1;
    for (int i = sizeof(Lane<V>) == 4 ? 7 : 13; i > 0; --i)
      root = 1 + root * x * (1 / static_cast<Lane<V>>(i));
    root *= root, root *= root, root *= root;
    return root * root;
  }
  // The smooth kernel that goes on beyond q = 1: K, K', K'' / 2, K''' / 6, and a bound on the
  // fourth derivative at all places from q on.
  template <class V>
  struct Taylor {
    V value, slope, second, third;
  };
  template <class V>
  static Taylor<V> taylor(V q) {
    using T = Lane<V>;
    const V e = exponential(q), s = static_cast<T>(-kB) * e, c = static_cast<T>(-kB / 2) * s;
    return {e - static_cast<T>(kEnd), s, c, static_cast<T>(-kB / 3) * c};
  }
  template <class V>
  static V fourth(V q) {
    return static_cast<Lane<V>>(1.001 * kB * kB * kB * kB) * exponential(q);
  }
  template <class V>
  static V value(V q) {
    return q < 1 ? positivePart(exponential(min(q, q - q + 1)) - static_cast<Lane<V>>(kEnd)) : V{};
  }
  template <class V>
  static V slope(V q) {
    return q < 1 ? static_cast<Lane<V>>(-kB) * exponential(min(q, q - q + 1)) : V{};
  }
  template <class V>
  static V curvature(V q) {
    return q < 1 ? static_cast<Lane<V>>(kB * kB) * exponential(min(q, q - q + 1)) : V{};
  }
};

// Calls f with an object of the kernel's type.
template <class F>
decltype(auto) withKernel(Kernel kernel, F&& f) {
  switch (kernel) {
    case Kernel::blob:
      return f(Power<2>());
    case Kernel::gaussian:
      return f(Gaussian());
    default:
      return f(Power<3>());
  }
}

}  // namespace PBRT_LANES
}  // namespace pbrt::metaballs
