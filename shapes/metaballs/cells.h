#pragma once
// The partition of space behind a metaballs shape: boxes that together hold the whole surface.

#include "core/base/bounds.h"
#include "shapes/metaballs/field.h"

namespace pbrt::metaballs {

// A box that may hold a piece of the surface, and the atoms that reach it.
struct Cell {
  Bounds3 box;
  std::uint32_t first = 0, count = 0;  // in Cells::atoms
};

// How far a ray is followed over the faces of a cell, over the cell's edges: a crossing near a
// shared face lies well inside one of the cells, whatever the rounding of a ray that is clipped to
// both. The atoms of a cell reach that far.
inline constexpr double kOverlap = 0x1p-14;

// The cells are boxes of an octree, shrunk: no two share more than a face.
class Cells {
 public:
  // Splits the box of all supports until cells are small against the supports that reach them, and
  // drops every cell over which the field provably does not reach the threshold. Uses all threads;
  // the cells and their order do not depend on their number.
  explicit Cells(const Field& field);

  std::span<const Cell> cells() const { return cells_; }
  // The box of a cell with its overlap: where a ray may meet it.
  static Bounds3 bounds(const Cell& cell) {
    const DPoint3 overlap = kOverlap * DVec3(cell.box.diagonal());
    return roundOutward(DPoint3(cell.box.lo) - overlap, DPoint3(cell.box.hi) + overlap);
  }
  AtomList atoms(const Cell& cell) const {
    return AtomList(atoms_).subspan(cell.first, cell.count);
  }

 private:
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> atoms_;
};

}  // namespace pbrt::metaballs
