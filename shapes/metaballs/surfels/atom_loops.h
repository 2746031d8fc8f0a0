#pragma once
// The inner loops of the field of moving atoms, for each instruction set as metaballs/loops.h.

#include "shapes/metaballs/loops.h"

namespace pbrt::surfels {

using metaballs::Atom;
using metaballs::AtomList;
using metaballs::Floats;
using metaballs::Kernel;
using metaballs::kLanes;

// A cell of a grid whose sides are the unit of length.
struct CellFrame {
  DPoint3 centre{};
  double side = 1;
  double slack = 0;  // how far beyond its faces the points asked for in it may lie

  Point3 inward(const DPoint3& p) const { return Point3((p - centre) / side); }
};

// Atoms of cells, each in the frame of its own. kLanes numbers after the last may be read.
struct CellAtoms {
  const float *x = nullptr, *y = nullptr, *z = nullptr;
  const float *inverse2 = nullptr, *weight = nullptr;  // as in AtomRun
  const std::uint32_t* number = nullptr;
};

// Some atoms, which touch a cell or are near it, in its frame.
struct alignas(metaballs::kLaneAlignment) AtomRun {
  static constexpr std::size_t kMost = 256;
  float x[kMost], y[kMost], z[kMost];
  float inverse2[kMost];  // 1 / h^2
  float weight[kMost];
  std::uint32_t number[kMost];
  std::size_t count = 0;  // beyond it, numbers may be anything
};

// What the atoms of a run add to the field at some points of a cell, in its frame. The sums of a
// point have the order of the atoms, whatever the other points are.
struct alignas(metaballs::kLaneAlignment) PointRun {
  static constexpr std::size_t kMost = 64;
  using Each = float[kMost];
  Each p[3];              // from here on, numbers up to the next multiple of kLanes may be anything
  Each value, magnitude;  // of w K and of |w K|
  Each gradient[3];
  Each slopes;            // of |grad W|
  Each flow[3];           // of |grad W| v
  std::size_t count = 0;  // beyond it, numbers may be anything
};

// The same for what shape() asks.
struct alignas(metaballs::kLaneAlignment) BendRun {
  static constexpr std::size_t kMost = PointRun::kMost;
  using Each = float[kMost];
  Each p[3];
  Each gradient[3];
  Each hessian[6];        // xx, yy, zz, xy, xz, yz
  Each magnitude;         // of |grad W| / |d| + |4 w K'' / h^4 d^2|
  Each size;              // of |w| / h^3, where the point is in the support or next to it
  Each terms;             // of 1, where it is
  std::size_t count = 0;  // as in PointRun
};

// What a PointRun has, at one point, in double and in the units of space.
struct ExactSums {
  double value = 0, magnitude = 0;
  DVec3 gradient{};
  double slopes = 0;
  DVec3 flow{};
  DVec3 weighed{};  // of |w K| v
};

// At one point of a cell, in its frame.
struct Probe {
  float value = 0, gradient[3] = {};
  float density = 0;  // of min(1, |w K|)
};

struct AtomLoops {
  // Puts the first `count` atoms, those at least whose supports reach within `half` of the centre
  // of a cell along all axes, at the end of its run, until it is full or nearly so. `offset` is the
  // centre of their own cell. How many were looked at.
  std::size_t (*gather)(const CellAtoms&, std::size_t count, const Vec3& offset, float half,
                        AtomRun&);
  // `velocities`: of all atoms, multiplied by `scale`; empty: sums with v are not made.
  void (*add)(Kernel, const AtomRun&, std::span<const Vec3> velocities, float scale, PointRun&);
  void (*bend)(Kernel, const AtomRun&, BendRun&);
  void (*probe)(Kernel, const AtomRun&, const Point3&, Probe&);
  // Without velocities there are no slopes, either.
  void (*addExactly)(Kernel, std::span<const Atom>, AtomList, std::span<const Vec3> velocities,
                     const DPoint3&, ExactSums&);
};

// Those that this machine supports: the portable ones first, the best last.
std::span<const AtomLoops* const> allAtomLoops();
// The best.
const AtomLoops& atomLoops();

}  // namespace pbrt::surfels
