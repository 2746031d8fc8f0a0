// Compiled once for each instruction set. Nothing here may call functions that are not inlined: the
// linker would keep but one copy of them, for the best machine.

#include "shapes/metaballs/surfels/draw_loops.h"

namespace pbrt::surfels {
inline namespace PBRT_LANES {

using metaballs::bits, metaballs::max, metaballs::min, metaballs::square, metaballs::squareRoot;

struct Vectors {
  Floats x, y, z;
};
static Floats dot(const Vectors& a, const Vectors& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
static Floats dot(const Vectors& a, const Vec3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
static Vectors operator+(const Vectors& a, const Vectors& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
static Vectors operator*(const Floats& s, const Vectors& a) {
  return {s * a.x, s * a.y, s * a.z};
}
// The gradient of a disc's F at p + u; F is u . (n + gradient) / 2 there.
static Vectors gradient(const Disc& disc, const Vectors& u) {
  const auto& [xx, yy, zz, xy, xz, yz] = disc.bend;
  return {disc.n.x + (xx * u.x + xy * u.y + xz * u.z), disc.n.y + (xy * u.x + yy * u.y + yz * u.z),
          disc.n.z + (xz * u.x + yz * u.y + zz * u.z)};
}
static Floats twiceValue(const Disc& disc, const Vectors& u, const Vectors& gradient) {
  return dot(u, Vectors{disc.n.x + gradient.x, disc.n.y + gradient.y, disc.n.z + gradient.z});
}

// A ball of radius R about v from the apex meets a cone of angle a only if it reaches over the
// plane that touches the cone on the side of v, |v across| cos a - (v along) sin a <= R, and is not
// wholly behind the apex. For rays that start within r of the apex take R + r.
static std::size_t narrow(const Bound& bound, std::span<const Balls> balls, std::uint32_t* out) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const Balls& b = balls[i];
    const Vectors v{b.x - bound.centre.x, b.y - bound.centre.y, b.z - bound.centre.z};
    const Floats along = dot(v, bound.axis), radius = b.radius + bound.radius;
    const Vectors across{v.x - along * bound.axis.x, v.y - along * bound.axis.y,
                         v.z - along * bound.axis.z};
    const Floats reach = radius + along * bound.sine;
    const Floats facing = dot(Vectors{b.nx, b.ny, b.nz}, bound.axis);
    const auto met = (reach >= 0) & (along >= -radius) & (facing - bound.spread < b.turn) &
                     (dot(across, across) * square(bound.cosine) <= reach * reach);
    for (unsigned lanes = bits(met); lanes != 0; lanes &= lanes - 1)
      out[count++] =
          static_cast<std::uint32_t>(i * kLanes) + static_cast<std::uint32_t>(__builtin_ctz(lanes));
  }
  return count;
}

// Along a ray from its point nearest to p, u + s d with u . d = 0, F is a quadratic,
// c + b s + a s^2, of slope -sqrt(b^2 - 4 a c) at the root where the ray comes from the front:
// s = 2 c / (sqrt(b^2 - 4 a c) - b).
static void look(const Rays& rays, const Disc* discs, std::span<const std::uint32_t> list,
                 std::uint32_t* near, Seen& seen) {
  const Vectors o{rays.ox, rays.oy, rays.oz}, d{rays.dx, rays.dy, rays.dz};
  const Floats dxx = d.x * d.x, dyy = d.y * d.y, dzz = d.z * d.z;
  const Floats dxy = 2 * d.x * d.y, dxz = 2 * d.x * d.z, dyz = 2 * d.y * d.z;
  Floats first = rays.tMax;
  std::size_t count = 0;
  for (const std::uint32_t i : list) {
    const Disc& disc = discs[i];
    const Vectors from{o.x - disc.p.x, o.y - disc.p.y, o.z - disc.p.z};
    const Floats middle = -dot(from, d);
    const Vectors u = from + middle * d;
    const Floats room = disc.rim2 - dot(u, u);
    if (bits(room > 0) == 0) continue;
    near[count++] = i;
    const auto& [xx, yy, zz, xy, xz, yz] = disc.bend;
    const Vectors g = gradient(disc, u);
    const Floats a2 = xx * dxx + yy * dyy + zz * dzz + xy * dxy + xz * dxz + yz * dyz;
    const Floats b = dot(g, d), c2 = twiceValue(disc, u, g);
    const Floats discriminant = b * b - a2 * c2;
    const Floats s = c2 / (squareRoot(discriminant) - b);
    const Floats t = middle + s;
    // A ray that but grazes the surface does not meet it (cosines below 0.003).
    const auto met = (discriminant > 1e-5F) & (s * s < room) & (t >= rays.tMin) & (t < first);
    first = met ? t : first;
  }
  const auto met = first < rays.tMax;
  seen.t = Floats{} + kInfinity;
  if (bits(met) == 0) return;

  // The surface about the nearest point is where the weighted mean of the discs' F is zero, one
  // step of Newton's from there. The weight falls to zero on a spheroid about p, half as thick as
  // it is wide: what lies closely behind has no part in it, nor has what faces away.
  const Vectors x = o + (met ? first : Floats{}) * d;
  Floats weights{}, values{}, most{};
  Vectors n{};
  Numbers surfel{};
  for (std::size_t k = 0; k < count; ++k) {
    const Disc& disc = discs[near[k]];
    const Vectors u{x.x - disc.p.x, x.y - disc.p.y, x.z - disc.p.z};
    const Vectors g = gradient(disc, u);
    const Floats value = 0.5F * twiceValue(disc, u, g);
    const Floats inside = 1 - (dot(u, u) + 3 * value * value) * disc.inverse2;
    const auto counts = (inside > 0) & (dot(g, d) < 0);
    const Floats weight = counts ? inside * inside : Floats{};
    weights += weight;
    values += weight * value;
    n = n + weight * g;
    surfel = weight > most ? Numbers{} + near[k] : surfel;
    most = max(most, weight);
  }
  // At a grazing angle the step is kept short.
  const Floats step = values / max(-dot(n, d), 0.1F * weights);
  seen.t = (met & (weights > 0)) ? max(rays.tMin, min(rays.tMax, first + step)) : seen.t;
  seen.nx = n.x, seen.ny = n.y, seen.nz = n.z;
  seen.surfel = surfel;
}

extern const DrawLoops kDrawLoops;
const DrawLoops kDrawLoops{narrow, look};

}  // namespace PBRT_LANES
}  // namespace pbrt::surfels
