// Compiled once for each instruction set. Nothing here may call functions that are not inlined: the
// linker would keep but one copy of them, for the best machine.

#include "shapes/metaballs/surfels/atom_loops.h"

#include "shapes/metaballs/atom_lanes.h"

namespace pbrt::surfels {
inline namespace PBRT_LANES {

using metaballs::AtomLanes, metaballs::bits, metaballs::Doubles, metaballs::squareRoot,
    metaballs::withKernel;

// A support touches a cell if the point of the cell that is nearest to its centre is within its
// radius. Most about a cell do: so eight are taken where one does.
static std::size_t gather(const CellAtoms& atoms, std::size_t count, const Vec3& offset, float half,
                          AtomRun& run) {
  std::size_t i = 0, n = run.count;
  for (; i < count && n + kLanes <= AtomRun::kMost; i += kLanes) {
    const auto load = [&](const float* a) {
      Floats v;
      __builtin_memcpy(&v, a + i, sizeof(v));
      return v;
    };
    const auto store = [&](const Floats& v, float* a) { __builtin_memcpy(a + n, &v, sizeof(v)); };
    const auto beyond = [&](const Floats& v) {
      return metaballs::positivePart(metaballs::abs(v) - half);
    };
    const std::size_t some = std::min<std::size_t>(count - i, kLanes);
    const Floats x = load(atoms.x) + offset.x, y = load(atoms.y) + offset.y;
    const Floats z = load(atoms.z) + offset.z, inverse2 = load(atoms.inverse2);
    const Floats bx = beyond(x), by = beyond(y), bz = beyond(z);
    const unsigned touch = bits((bx * bx + by * by + bz * bz) * inverse2 < 1);
    if ((touch & ((1U << some) - 1)) == 0) continue;
    store(x, run.x), store(y, run.y), store(z, run.z);
    store(inverse2, run.inverse2), store(load(atoms.weight), run.weight);
    __builtin_memcpy(run.number + n, atoms.number + i, kLanes * sizeof(*run.number));
    n += some;
  }
  run.count = n;
  return std::min(i, count);
}

// The lowest and the highest lane, moved apart by more than the rounding of coordinates.
struct Extent {
  float lo, hi;

  explicit Extent(const Floats& v) : lo(v[0]), hi(v[0]) {
    for (int k = 1; k < kLanes; ++k) lo = std::min(lo, v[k]), hi = std::max(hi, v[k]);
    lo -= 1e-5F, hi += 1e-5F;
  }
  Floats beyond(const Floats& v) const {
    return metaballs::positivePart(metaballs::max(lo - v, v - hi));
  }
};

// Those atoms of the run that may reach some of eight points. How many.
static std::size_t reaching(const AtomRun& run, const Floats& px, const Floats& py,
                            const Floats& pz, std::uint16_t* indices) {
  const Extent ex(px), ey(py), ez(pz);
  std::size_t count = 0;
  for (std::size_t i = 0; i < run.count; i += kLanes) {
    const auto load = [&](const float* a) { return *reinterpret_cast<const Floats*>(a + i); };
    const Floats x = ex.beyond(load(run.x)), y = ey.beyond(load(run.y)), z = ez.beyond(load(run.z));
    unsigned mask = bits((x * x + y * y + z * z) * load(run.inverse2) < 1);
    if (run.count - i < kLanes) mask &= (1U << (run.count - i)) - 1;
    for (; mask != 0; mask &= mask - 1)
      indices[count++] = static_cast<std::uint16_t>(i + static_cast<unsigned>(__builtin_ctz(mask)));
  }
  return count;
}

// W = w K(q) with q = |d|^2 / h^2 and d = p - a: grad W = 2 w K'(q) / h^2 d.
template <class K, bool kMoves>
void add(const AtomRun& run, std::span<const Vec3> velocities, float scale, PointRun& points) {
  for (std::size_t first = 0; first < points.count; first += kLanes) {
    const auto load = [&](const PointRun::Each& a) {
      return *reinterpret_cast<const Floats*>(a + first);
    };
    const auto store = [&](const Floats& v, PointRun::Each& a) {
      *reinterpret_cast<Floats*>(a + first) = v;
    };
    const Floats px = load(points.p[0]), py = load(points.p[1]), pz = load(points.p[2]);
    Floats value{}, magnitude{}, gx{}, gy{}, gz{}, slopes{}, fx{}, fy{}, fz{};
    std::uint16_t indices[AtomRun::kMost];
    const std::size_t count = reaching(run, px, py, pz, indices);
    for (std::size_t n = 0; n < count; ++n) {
      const std::size_t i = indices[n];
      const Floats x = px - run.x[i], y = py - run.y[i], z = pz - run.z[i];
      const Floats r2 = x * x + y * y + z * z, q = r2 * run.inverse2[i];
      const Floats own = run.weight[i] * K::value(q);
      const Floats k = (2 * run.weight[i] * run.inverse2[i]) * K::slope(q);
      value += own;
      magnitude += metaballs::abs(own);
      gx += k * x, gy += k * y, gz += k * z;
      const Floats slope = metaballs::abs(k) * squareRoot(r2);
      slopes += slope;
      if constexpr (kMoves) {
        const Vec3 v = scale * velocities[run.number[i]];
        fx += v.x * slope, fy += v.y * slope, fz += v.z * slope;
      }
    }
    store(value, points.value), store(magnitude, points.magnitude);
    store(gx, points.gradient[0]), store(gy, points.gradient[1]), store(gz, points.gradient[2]);
    store(slopes, points.slopes);
    store(fx, points.flow[0]), store(fy, points.flow[1]), store(fz, points.flow[2]);
  }
}

// The Jacobian of 2 w K' / h^2 d is 2 w K' / h^2 I + 4 w K'' / h^4 d d^T.
template <class K>
void bend(const AtomRun& run, BendRun& points) {
  for (std::size_t first = 0; first < points.count; first += kLanes) {
    const auto at = [&](BendRun::Each& a) -> Floats& {
      return *reinterpret_cast<Floats*>(a + first);
    };
    const Floats px = at(points.p[0]), py = at(points.p[1]), pz = at(points.p[2]);
    Floats gx{}, gy{}, gz{}, identity{}, xx{}, yy{}, zz{}, xy{}, xz{}, yz{};
    Floats magnitude{}, size{}, terms{};
    std::uint16_t indices[AtomRun::kMost];
    const std::size_t count = reaching(run, px, py, pz, indices);
    for (std::size_t n = 0; n < count; ++n) {
      const std::size_t i = indices[n];
      const float inverse2 = run.inverse2[i], k = 2 * run.weight[i] * inverse2;
      const Floats x = px - run.x[i], y = py - run.y[i], z = pz - run.z[i];
      const Floats r2 = x * x + y * y + z * z, q = r2 * inverse2;
      const Floats k1 = k * K::slope(q), k2 = (2 * k * inverse2) * K::curvature(q);
      gx += k1 * x, gy += k1 * y, gz += k1 * z;
      identity += k1;
      const Floats kx = k2 * x, ky = k2 * y;
      xx += kx * x, xy += kx * y, xz += kx * z, yy += ky * y, yz += ky * z, zz += k2 * z * z;
      const float own = std::abs(run.weight[i]) * inverse2 * std::sqrt(inverse2);
      const auto near = q < 1 + 0x1p-18F;
      magnitude += metaballs::abs(k1) + metaballs::abs(k2) * r2;
      size += near ? Floats{} + own : Floats{};
      terms += near ? Floats{} + 1 : Floats{};
    }
    at(points.gradient[0]) = gx, at(points.gradient[1]) = gy, at(points.gradient[2]) = gz;
    at(points.hessian[0]) = identity + xx, at(points.hessian[1]) = identity + yy;
    at(points.hessian[2]) = identity + zz, at(points.hessian[3]) = xy;
    at(points.hessian[4]) = xz, at(points.hessian[5]) = yz;
    at(points.magnitude) = magnitude, at(points.size) = size, at(points.terms) = terms;
  }
}

// Atoms are in the lanes.
template <class K>
void probe(const AtomRun& run, const Point3& p, Probe& probe) {
  Floats value{}, gx{}, gy{}, gz{}, density{};
  for (std::size_t i = 0; i < run.count; i += kLanes) {
    const auto load = [&](const float* a) { return *reinterpret_cast<const Floats*>(a + i); };
    const Floats x = p.x - load(run.x), y = p.y - load(run.y), z = p.z - load(run.z);
    const Floats inverse2 = load(run.inverse2), q = (x * x + y * y + z * z) * inverse2;
    const Floats lane = {0, 1, 2, 3, 4, 5, 6, 7};
    const Floats weight = lane < static_cast<float>(run.count - i) ? load(run.weight) : Floats{};
    // Those beyond the last may be anything: their products with zero, too.
    const auto counts = weight != 0 && q < 1;
    const Floats own = counts ? weight * K::value(q) : Floats{};
    const Floats k = counts ? 2 * weight * inverse2 * K::slope(q) : Floats{};
    value += own;
    density += metaballs::min(metaballs::abs(own), Floats{} + 1);
    gx += counts ? k * x : Floats{}, gy += counts ? k * y : Floats{};
    gz += counts ? k * z : Floats{};
  }
  const Floats s = metaballs::sums(value, gx, gy, gz, density, Floats{}, Floats{}, Floats{});
  probe.value += s[0];
  for (int i = 0; i < 3; ++i) probe.gradient[i] += s[1 + i];
  probe.density += s[4];
}

template <class K, bool kMoves>
void addExactly(std::span<const Atom> atoms, AtomList list, std::span<const Vec3> velocities,
                const DPoint3& p, ExactSums& sums) {
  using metaballs::abs;
  using V = Doubles;
  V value{}, magnitude{}, gx{}, gy{}, gz{}, slopes{};
  V fx{}, fy{}, fz{}, wx{}, wy{}, wz{};
  for (std::size_t i = 0; i < list.size(); i += kLanes) {
    const AtomLanes<V> a(atoms, list, i, p);  // its x is that of -d
    const V inverse2 = a.inverse * a.inverse, r2 = a.x * a.x + a.y * a.y + a.z * a.z;
    const V q = r2 * inverse2;
    const V own = a.weight * K::value(q), size = abs(own);
    value += own;
    magnitude += size;
    const V k = -2 * a.weight * inverse2 * K::slope(q);
    gx += k * a.x, gy += k * a.y, gz += k * a.z;
    if constexpr (kMoves) {
      V slope{}, vx{}, vy{}, vz{};
      for (int n = 0; n < kLanes; ++n) {
        slope[n] = std::sqrt(r2[n]);
        if (i + n >= list.size()) continue;
        const Vec3& v = velocities[list[i + n]];
        vx[n] = v.x, vy[n] = v.y, vz[n] = v.z;
      }
      slope *= abs(k);
      slopes += slope;
      fx += slope * vx, fy += slope * vy, fz += slope * vz;
      wx += size * vx, wy += size * vy, wz += size * vz;
    }
  }
  const V u = metaballs::sums(value, magnitude, gx, gy, gz, slopes, V{}, V{});
  const V v = metaballs::sums(fx, fy, fz, wx, wy, wz, V{}, V{});
  sums.value += u[0];
  sums.magnitude += u[1];
  sums.gradient += DVec3(u[2], u[3], u[4]);
  sums.slopes += u[5];
  sums.flow += DVec3(v[0], v[1], v[2]);
  sums.weighed += DVec3(v[3], v[4], v[5]);
}

extern const AtomLoops kAtomLoops;
const AtomLoops kAtomLoops{gather,
                           [](Kernel kernel, const AtomRun& run, std::span<const Vec3> velocities,
                              float scale, PointRun& points) {
                             withKernel(kernel, [&]<class K>(K) {
                               if (velocities.empty())
                                 add<K, false>(run, velocities, scale, points);
                               else
                                 add<K, true>(run, velocities, scale, points);
                             });
                           },
                           [](Kernel kernel, const AtomRun& run, BendRun& points) {
                             withKernel(kernel, [&]<class K>(K) { bend<K>(run, points); });
                           },
                           [](Kernel kernel, const AtomRun& run, const Point3& p, Probe& sums) {
                             withKernel(kernel, [&]<class K>(K) { probe<K>(run, p, sums); });
                           },
                           [](Kernel kernel, std::span<const Atom> atoms, AtomList list,
                              std::span<const Vec3> velocities, const DPoint3& p, ExactSums& sums) {
                             withKernel(kernel, [&]<class K>(K) {
                               if (velocities.empty())
                                 addExactly<K, false>(atoms, list, velocities, p, sums);
                               else
                                 addExactly<K, true>(atoms, list, velocities, p, sums);
                             });
                           }};

}  // namespace PBRT_LANES
}  // namespace pbrt::surfels
