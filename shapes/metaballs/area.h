#pragma once
// Points on the surface, chosen so that a metaball can be an area light, with their exact density.
//
// Method. The cells are split into patches: boxes over which an interval bound of the gradient g
// proves, for one axis a, that g_a keeps its sign and that the unit normal has |n_a| >= 0.3. A line
// along a then meets the surface within the patch at most once. A point is chosen by
// 1. a patch i with probability P_i, about in proportion to the area that it can hold;
// 2. a line: a point uniform on the patch's face across a, or rather on those tiles of a grid on
// it,
//    of total area A_i, below which the surface may lie;
// 3. where the line meets the surface; if it does not, there is no sample.
// A piece dS of the surface covers |n_a| dS of the face, so the density per area at a point is
//   sum of P_i |n_a| / (A_i N_i) over the patches i that hold the point,                        (1)
// with N_i = 1. This is what sample() does and no approximation: P_i and A_i may be anything above
// zero. Its integral over the surface is the share of draws that give a sample, 0.65 to 0.9.
//
// Where the surface touches or pinches itself (f = 0 and g = 0) no box is small enough for such a
// proof. At a limit of the depth a box becomes three patches, one for each axis: then n_a cannot
// vanish in all terms of (1). All crossings of a line within the patch are found, and one of the
// N_i, at most 16, is chosen. Two of them nearer than 2^-20 of the patch count as one; that alone,
// in a vanishing part of the surface, keeps (1) from being exact.

#include "core/api/shape.h"
#include "shapes/metaballs/cells.h"

namespace pbrt::metaballs {

class PatchSampler final : public AreaSampler {
 public:
  // Both must outlive it. `deepest`: halvings of a cell before its pieces are taken as they are.
  PatchSampler(const Field& field, const Cells& cells, int deepest = 12);

  // An estimate with one line through each tile: off by one or two hundredths for one atom, less
  // for more. Nothing else depends on it. 0: there is nothing to sample.
  double area() const override { return area_; }
  AreaSample sample(const DPoint3& from, Point2 u) const override;
  float pdf(const DPoint3& from, const DPoint3& p, const Normal3& n) const override;
  bool mayHit(const DPoint3& from, const DVec3& w) const override;

 private:
  static constexpr int kTiles = 4;  // along each edge of a face

  // A half-open box, so that patches that share a face share no point.
  struct Patch {
    Bounds3 box;
    std::uint32_t cell = 0;
    std::uint16_t tiles = 0;  // bit kTiles j + i: the i-th along axis + 1, the j-th along axis + 2
    std::uint8_t axis = 0;
    bool once = true;   // whether no line along the axis meets the surface twice
    double weight = 0;  // P_i times the sum of all weights

    DVec3 size() const { return DVec3(box.hi) - DVec3(box.lo); }
    double tileArea() const {
      return size()[(axis + 1) % 3] * size()[(axis + 2) % 3] / (kTiles * kTiles);
    }
    // The number of the tile in front of a point of the box.
    int tileOf(const DPoint3& p) const;
    // The point of the box's lower face across the axis, from tile coordinates in [0, kTiles).
    DPoint3 onFace(double x, double y) const;
  };

  void split(std::uint32_t cell, const Bounds3& box, int depth);
  void add(Patch patch);
  void sortIntoTree(std::size_t node, std::size_t first, std::size_t last);
  template <class Visit>
  void visitHolding(const DPoint3& p, std::size_t node, std::size_t first, std::size_t last,
                    const Visit& visit) const;
  template <class Visit>
  void visitCrossings(const Patch& patch, const DPoint3& onFace, const Visit& visit) const;
  double density(const DPoint3& p, const Normal3& n) const;
  AtomList atoms(const Patch& patch) const { return cells_.atoms(cells_.cells()[patch.cell]); }

  const Field& field_;
  const Cells& cells_;
  int deepest_;
  double area_ = 0;
  std::vector<Patch> patches_;
  std::vector<double> cumulative_;  // the weight of all patches up to and including the i-th
  std::vector<Bounds3> tree_;  // a heap of boxes: node k is over its children 2 k + 1 and 2 k + 2
};

}  // namespace pbrt::metaballs
