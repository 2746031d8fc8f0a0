#include "tools/particles/motion/dam.h"

#include "core/base/rng.h"

namespace pbrt::motion {
namespace {

// Metres. The tank has a lid, which only spray ever meets.
const Bounds3 kTank{Point3(0), Point3(1, 1, 0.5F)};
const Vec3 kColumn(0.4F, 0.6F, 0.5F);

}  // namespace

Dam::Dam(int atoms, double fps)
    : Endless(fps),
      atoms_(atoms),
      spacing_(std::cbrt(kColumn.x * kColumn.y * kColumn.z / static_cast<float>(atoms))),
      water_(fill()) {}

// Layers from the bottom, of particles no nearer to each other than at rest. Without disorder the
// water would stay as regular as a crystal.
Water Dam::fill() const {
  const int layers = static_cast<int>(kColumn.y / spacing_);
  const int nz = static_cast<int>(kColumn.z / spacing_);
  const int nx = (atoms_ - 1) / (layers * nz) + 1;
  const Vec3 step(spacing_, spacing_, kColumn.z / static_cast<float>(nz));
  Rng rng(1);
  std::vector<Point3> positions;
  for (int i = 0; i < atoms_; ++i) {
    const Vec3 disorder = 0.1F * (Vec3(rng.uniform(), rng.uniform(), rng.uniform()) - 0.5F);
    const Vec3 number(i % nx, i / (nx * nz), i / nx % nz);
    positions.push_back(step * (number + 0.5F + disorder));
  }
  return {std::move(positions), kTank, spacing_, kColumn.y};
}

Bounds3 Dam::bounds() const {
  return {kTank.lo - spacing_, Point3(kTank.hi.x, kColumn.y * 1.2F, kTank.hi.z) + spacing_};
}

void Dam::frameAfter(int step, Fluid& out) {
  if (step < steps_) {
    water_ = fill();
    steps_ = 0;
  }
  for (; steps_ < step; ++steps_) water_.advance(dt());
  for (const Point3& p : water_.positions()) out.atoms.push_back(fluidAtom(p, spacing_));
  out.velocities.assign(water_.velocities().begin(), water_.velocities().end());
}

std::unique_ptr<Motion> makeDam(int atoms, double fps) {
  return std::make_unique<Dam>(atoms, fps);
}

}  // namespace pbrt::motion
