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

// Neighbouring cells overlap a little, so that a crossing near a shared face lies well inside one
// of them, whatever the rounding of a ray that is clipped to both.
class Cells {
 public:
  // Splits the box of all supports until cells are small against the supports that reach them, and
  // drops every cell over which the field provably does not reach the threshold.
  explicit Cells(const Field& field);

  std::span<const Cell> cells() const { return cells_; }
  AtomList atoms(const Cell& cell) const {
    return AtomList(atoms_).subspan(cell.first, cell.count);
  }

 private:
  void split(const Field& field, const Bounds3& box, AtomList parents);

  std::vector<Cell> cells_;
  std::vector<std::uint32_t> atoms_;
};

}  // namespace pbrt::metaballs
