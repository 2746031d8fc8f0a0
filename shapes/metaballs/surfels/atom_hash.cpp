#include "shapes/metaballs/surfels/atom_hash.h"

#include <algorithm>

namespace pbrt::surfels {

CellFrame AtomHash::frame(const CellKey& key) const {
  CellFrame f;
  f.side = side_;
  f.centre = side_ * (DVec3(static_cast<double>(key.x), static_cast<double>(key.y),
                            static_cast<double>(key.z)) +
                      0.5);
  // By rounding, a point may be taken for one of the next cell.
  f.slack = 0x1p-20 * side_ +
            0x1p-50 * std::max({std::abs(f.centre.x), std::abs(f.centre.y), std::abs(f.centre.z)});
  return f;
}

void AtomHash::enter(std::uint32_t number, const CellKey& key) {
  std::size_t slot = slotOf(key);
  if (table_[slot] == 0) {
    cells_.push_back({key});
    table_[slot] = static_cast<std::uint32_t>(cells_.size());
    if (2 * cells_.size() > table_.size()) {
      table_.assign(2 * table_.size(), 0);
      for (std::uint32_t i = 0; i < cells_.size(); ++i) table_[slotOf(cells_[i].key)] = i + 1;
      slot = slotOf(key);
    }
  }
  Cell& cell = cells_[table_[slot] - 1];
  ++cell.count;
  entries_.push_back({number, table_[slot] - 1});
}

// A counting sort: each cell's atoms are counted, get a run of their own, and are put there.
void AtomHash::build(std::span<const Atom> atoms, std::span<const std::uint32_t> numbers,
                     double largest, HashKind kind) {
  kind_ = kind;
  float extent = 0;
  for (const std::uint32_t j : numbers)
    for (int i = 0; i < 3; ++i) extent = std::max(extent, std::abs(atoms[j].centre[i]));
  side_ = std::max(largest, 0x1p-50 * extent);  // cells are told apart by doubles
  cells_.clear();
  entries_.clear();
  table_.assign(std::max<std::size_t>(table_.size(), 64), 0);
  for (const std::uint32_t j : numbers) {
    const DPoint3 p(atoms[j].centre);
    if (kind == HashKind::traditional) {
      enter(j, cellAt(p));
      continue;
    }
    visitAbout(cellAt(p), [&](const CellKey& key) {
      const CellFrame cell = frame(key);
      const DVec3 beyond =
          glm::max(glm::abs(p - cell.centre) - (0.5 * side_ + cell.slack), DVec3(0));
      if (lengthSquared(beyond) <= sqr(static_cast<double>(atoms[j].radius))) enter(j, key);
    });
  }
  numbers_.resize(entries_.size() + kLanes);
  for (std::vector<float>* each : {&x_, &y_, &z_, &inverse2_, &weight_})
    each->resize(numbers_.size());
  std::uint32_t end = 0;
  for (Cell& cell : cells_) cell.first = end += cell.count;
  for (std::size_t i = entries_.size(); i-- > 0;) {
    Cell& cell = cells_[entries_[i].cell];
    const std::uint32_t at = --cell.first, number = entries_[i].number;
    const Atom& atom = atoms[number];
    const Point3 p = frame(cell.key).inward(DPoint3(atom.centre));
    numbers_[at] = number;
    x_[at] = p.x, y_[at] = p.y, z_[at] = p.z;
    // Finite also where an atom is as nothing beside its cell.
    inverse2_[at] = static_cast<float>(std::min(sqr(side_ / atom.radius), 1e30));
    weight_[at] = atom.lightWeight;
  }
}

}  // namespace pbrt::surfels
