// Compiled once for each instruction set (see ../loops.cpp).

#include "shapes/metaballs/lanes.h"
#include "shapes/metaballs/surfels/repulsion.h"

namespace pbrt::metaballs {
inline namespace PBRT_LANES {
namespace {

// A surfel that sees more than these sees these. So many come only where all lie in a heap.
constexpr std::uint32_t kMost = 1024;

Floats load(const float* from) {
  Floats v;
  __builtin_memcpy(&v, from, sizeof(v));
  return v;
}
void store(float* to, const Floats& v) {
  __builtin_memcpy(to, &v, sizeof(v));
}

// The surfels of a cell and those about it, from the corner of the cell in reaches.
struct Surroundings {
  float place[3][kMost + 2 * kLanes], normal[3][kMost + 2 * kLanes];
  float crowding[kMost + 2 * kLanes];
  std::uint32_t count;

  // Its own cell comes first: where not all are seen, at least the nearest are.
  Surroundings(const surfels::GridView& grid, std::uint64_t own) : count(0) {
    for (int c = 0; c < 27; ++c) {
      const int cell = (c + 13) % 27, i = cell / 9 - 1, j = cell / 3 % 3 - 1, k = cell % 3 - 1;
      const std::uint64_t key = surfels::keyBeside(own, i, j, k);
      const std::uint32_t bucket = surfels::bucketOf(key, grid.shift);
      std::uint32_t first = grid.starts[bucket], end = grid.starts[bucket + 1];
      while (first < end && grid.keys[first] != key) ++first;
      while (first < end && grid.keys[end - 1] != key) --end;
      add(grid, first, end, {static_cast<float>(i), static_cast<float>(j), static_cast<float>(k)});
    }
    for (float* x : place) store(x + count, Floats{} + 9);  // out of everyone's reach
    store(crowding + count, Floats{});
  }

 private:
  struct Offset {
    float of[3];
  };
  void add(const surfels::GridView& grid, std::uint32_t first, std::uint32_t end,
           const Offset& offset) {
    for (; first < end && count < kMost; first += kLanes) {
      for (int axis = 0; axis < 3; ++axis) {
        store(place[axis] + count, load(grid.place[axis] + first) + offset.of[axis]);
        store(normal[axis] + count, load(grid.normal[axis] + first));
      }
      store(crowding + count, load(grid.crowding + first));
      count += end - first < kLanes ? end - first : kLanes;
    }
  }
};

// Lengths are in reaches. With c = 1 - r the spiky kernel is c^3 up to a factor, that s_p = pi h^3
// / 15 makes one, so that sigma = sum c^3, the surfel's own 1 included, and T_d is a half.
//
// Its force f = -grad sigma = sum 3 c^2 d / r (d from the neighbour, r = |d|) is minus the gradient
// of the energy E = 1/2 sum sum c^3 by the surfel's place. Steps k f lower E as long as k times the
// greatest eigenvalue of its Hessian stays below 2. The second derivative of c^3 along d is 6 c,
// that across it is below zero; over neighbours all around, sum 6 c cos^2 = sum 3 c, which is the
// Hessian's part of the surfel itself. Those of its neighbours are, all together, no more than as
// much again (Gershgorin), so that the eigenvalue is at most 6 sum c, and k = 1 / (6 sum c) is half
// of what is safe. The step is then at most 1/2 sum c^2 / sum c, half a reach, however dense.
surfels::Repulsion repelOne(const surfels::GridView& grid, const Surroundings& all,
                            std::uint32_t i) {
  Floats sigma{}, near{}, count{}, crowding{}, x{}, y{}, z{};
  const Floats px = Floats{} + grid.place[0][i], py = Floats{} + grid.place[1][i],
               pz = Floats{} + grid.place[2][i];
  const Floats nx = Floats{} + grid.normal[0][i], ny = Floats{} + grid.normal[1][i],
               nz = Floats{} + grid.normal[2][i];
  for (std::uint32_t k = 0; k < all.count; k += kLanes) {
    const Floats dx = px - load(all.place[0] + k), dy = py - load(all.place[1] + k),
                 dz = pz - load(all.place[2] + k);
    const Floats r = squareRoot(dx * dx + dy * dy + dz * dz);
    // Those on the other side of a thin sheet, or across a gap, are no neighbours on the surface.
    const Floats along =
        nx * load(all.normal[0] + k) + ny * load(all.normal[1] + k) + nz * load(all.normal[2] + k);
    const Floats c = along > 0 ? positivePart(1 - r) : Floats{};
    sigma += c * c * c;
    near += c;
    crowding += c * load(all.crowding + k);
    count += c > 0 ? Floats{} + 1 : Floats{};
    const Floats force = c * c / max(r, Floats{} + 1e-9F);
    x += force * dx, y += force * dy, z += force * dz;
  }
  const Floats total = sums(sigma, near, count, x, y, z, crowding, Floats{});
  surfels::Repulsion result;
  result.density = total[0];
  result.neighbours = max(total[2] - 1, 0.F);
  result.crowding = total[6] / (total[1] > 1 ? total[1] : 1);
  if (const float others = total[1] - 1; others > 1e-6F) {
    const float n[3] = {nx[0], ny[0], nz[0]};
    const float out = n[0] * total[3] + n[1] * total[4] + n[2] * total[5];
    for (int axis = 0; axis < 3; ++axis)
      result.push[axis] = 0.5F / others * (total[3 + axis] - out * n[axis]);
  }
  return result;
}

}  // namespace

surfels::Repel repel;
void repel(const surfels::GridView& grid, std::span<const surfels::Cell> cells,
           surfels::Repulsion* out) {
  for (const surfels::Cell& cell : cells) {
    const Surroundings all(grid, cell.key);
    for (std::uint32_t i = cell.first; i < cell.first + cell.count; ++i)
      out[i] = repelOne(grid, all, i);
  }
}

}  // namespace PBRT_LANES
}  // namespace pbrt::metaballs
