#pragma once
// Kernels: how the field of an atom falls off, as functions of q = r^2 / h^2, the squared distance
// from the atom's centre over its squared support radius.
//
// A kernel is a type with three functions of q >= 0: value K, slope K' and curvature K''. All that
// the proofs elsewhere ask of it: on [0, 1] K falls, is convex and at most 1; from q = 1 on it is
// zero. Then over any [q0, q1] the ranges are K in [K(q1), K(q0)] and K' in [K'(q0), K'(q1)], and
// F is continuous.
// A further kernel is such a type, a name in kKernels and a case in withKernel.

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string_view>

namespace pbrt::metaballs {

// (1 - q)^N.
template <int N>
struct Power {
  static double value(double q) { return power<N>(q); }
  static double slope(double q) { return -N * power<N - 1>(q); }
  static double curvature(double q) { return q < 1 ? N * (N - 1) * power<N - 2>(q) : 0; }

 private:
  template <int M>
  static double power(double q) {
    const double a = 1 - q > 0 ? 1 - q : 0;
    double p = 1;
    for (int i = 0; i < M; ++i) p *= a;
    return p;
  }
};

// exp(-b q) lowered by exp(-b), so that it is continuous where the support ends
// (Blinn 1982, "A Generalization of Algebraic Surface Drawing", with a finite support).
struct Gaussian {
  static constexpr double kB = 4;
  static constexpr double kEnd = 0.018315638888734179;  // exp(-b)

  static double value(double q) { return q < 1 ? std::exp(-kB * q) - kEnd : 0; }
  static double slope(double q) { return q < 1 ? -kB * std::exp(-kB * q) : 0; }
  static double curvature(double q) { return q < 1 ? kB * kB * std::exp(-kB * q) : 0; }
};

enum class Kernel : std::uint8_t { poly6, wyvill, blob, gaussian };
// In the order of the enumeration.
inline constexpr std::array<std::string_view, 4> kKernels{"poly6", "wyvill", "blob", "gaussian"};

// The field of one atom is strength * scale(kernel, h) * K(r^2 / h^2). poly6 integrates to one over
// space (Mueller, Charypar and Gross 2003, eq. 20), so it has the unit 1 / volume.
inline double scale(Kernel kernel, double h) {
  return kernel == Kernel::poly6 ? 315 / (64 * std::numbers::pi * h * h * h) : 1;
}

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

}  // namespace pbrt::metaballs
