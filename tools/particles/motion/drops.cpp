#include "tools/particles/motion/drops.h"

#include <fmt/format.h>

#include <numbers>

#include "core/base/error.h"

namespace pbrt::motion {

metaballs::Atom fluidAtom(const Point3& p, float spacing) {
  // r^3 4 pi / 3 = 1, and weight (1 - r^2 / 4)^3 = 1.
  static const double weight = [] {
    const double r = ballRadius(1);
    return 1 / metaballs::Power<3>::value(r * r / 4);
  }();
  return {p, 2 * spacing, weight};
}

// A shell has its share of the volume, spread along a spiral, even in height and by the golden
// angle from point to point (R. Swinbank and R. J. Purser 2006, "Fibonacci Grids").
std::vector<DVec3> ball(std::size_t count) {
  const double radius = ballRadius(count);
  const int shells = std::max(1, static_cast<int>(std::round(radius)));
  std::vector<DVec3> points;
  for (int shell = 0; shell < shells; ++shell) {
    const double r = radius * (shell + 0.5) / shells;
    const std::size_t share =
        std::lround(static_cast<double>(count) * std::pow((shell + 1.) / shells, 3)) -
        points.size();
    for (std::size_t i = 0; i < share; ++i) {
      const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(share);
      const double angle = std::numbers::pi * (3 - std::sqrt(5.)) * static_cast<double>(i) + shell;
      const double rim = std::sqrt(1 - z * z);
      points.push_back(r * DVec3(rim * std::cos(angle), rim * std::sin(angle), z));
    }
  }
  return points;
}

double ballRadius(std::size_t count) {
  return std::cbrt(3 * static_cast<double>(count) / (4 * std::numbers::pi));
}

void place(std::span<const DVec3> drop, const Pose& pose, float spacing, Fluid& out) {
  DVec3 centre, speed;
  glm::dmat3 axes, rates;
  for (int k = 0; k < 3; ++k) {
    centre[k] = pose.centre[k].v;
    speed[k] = pose.centre[k].d[0];
    for (int i = 0; i < 3; ++i) {
      axes[i][k] = pose.axes[i][k].v;
      rates[i][k] = pose.axes[i][k].d[0];
    }
  }
  for (const DVec3& x : drop) {
    out.atoms.push_back(fluidAtom(Point3(centre + axes * x), spacing));
    out.velocities.emplace_back(speed + rates * x);
  }
}

void Endless::frame(int number, Fluid& out) {
  if (number < first())
    throw Error(fmt::format("there is no frame {}: the first is {}", number, first()),
                Failure::usage);
  out.kernel = metaballs::Kernel::poly6;
  out.atoms.clear();
  out.velocities.clear();
  frameAfter(number - first(), out);
}

}  // namespace pbrt::motion
