#pragma once
// The field of a fluid: atoms that move.

#include "shapes/metaballs/surfels/atom_hash.h"
#include "shapes/metaballs/surfels/moving_field.h"

namespace pbrt::surfels {

class AtomField final : public MovingField {
 public:
  // The inverted hash is here to be measured: what its looks save, its building costs, for which
  // the other threads wait, unless each atom is looked up by 30 points and more a frame.
  explicit AtomField(HashKind hash = HashKind::traditional) : hash_(hash) {}

  // The atoms of the next frame, anything that metaballs::Field accepts, and the velocity of each,
  // length per time, finite; none: all are at rest. `atoms` and `velocities` must stay until the
  // next call. Uses all threads and the memory of earlier frames.
  void set(metaballs::Kernel kernel, std::span<const metaballs::Atom> atoms,
           std::span<const Vec3> velocities);

  Bounds3 bounds() const override { return bounds_; }
  double grain() const override { return grain_; }
  void at(std::span<const DPoint3> points, std::span<FieldAt> out) const override;
  void shape(std::span<const DPoint3> points, std::span<ShapeAt> out) const override;
  bool seeds(std::uint64_t first, std::span<DPoint3> out) const override;

 private:
  static constexpr std::size_t kChunk = 512;  // points that are looked at together

  // These take at most kChunk points.
  void some(std::span<const DPoint3> points, std::span<FieldAt> out) const;
  void bend(std::span<const DPoint3> points, std::span<ShapeAt> out) const;
  void exactly(std::span<const DPoint3> points, std::span<const Vec3> velocities,
               std::span<ExactSums> sums) const;
  ShapeAt shapeExactly(const DPoint3& p) const;
  // Puts the members in the frame of their cell; lanes to spare get the last.
  template <class Run>
  static void fill(Run& run, const CellFrame& frame, std::span<const DPoint3> points,
                   std::span<const std::uint16_t> members) {
    run.count = std::min(members.size(), Run::kMost);
    for (std::size_t i = 0; i < (run.count + kLanes - 1) / kLanes * kLanes; ++i) {
      const Point3 p = frame.inward(points[members[std::min(i, run.count - 1)]]);
      run.p[0][i] = p.x, run.p[1][i] = p.y, run.p[2][i] = p.z;
    }
  }
  // Calls visit(frame, members, run) with cells, which of the points are in it, and some of the
  // atoms that touch it, until all were in a run.
  template <class Visit>
  void visitCells(std::span<const DPoint3> points, const Visit& visit) const;

  // A place near the surface, and the support radius of an atom about there; 0: there is none.
  struct Place {
    DPoint3 p{};
    double h = 0;
  };
  struct Look {
    double value = -1;  // f
    DVec3 gradient{};
    double density = 0;
  };
  Look look(const DPoint3& p) const;  // in floats
  Place propose(std::uint64_t trial, Rng& rng) const;
  Place find(std::uint64_t& trial, std::uint64_t end) const;
  void findOne();
  bool settle(DPoint3& p, double h) const;

  HashKind hash_;
  metaballs::Kernel kernel_ = metaballs::Kernel::poly6;
  std::span<const metaballs::Atom> atoms_;
  std::span<const Vec3> velocities_;
  float fastest_ = 1;  // component of a velocity
  Bounds3 bounds_;
  double grain_ = 1;
  // Atoms by their radius, a level for each factor of 4, the largest first: the cells of a level
  // suit its atoms. A fluid has one level or two.
  std::vector<AtomHash> levels_;
  std::size_t levelCount_ = 0;
  std::vector<std::vector<std::uint32_t>> byLevel_;
  // For seeds.
  std::vector<double> byArea_;  // sums, up to each atom, of what it is chosen by
  Place known_;
  std::uint64_t trial_ = 0;  // number of the next for known_, which goes on from frame to frame
};

// Points of one cell are taken together: what touches the cell is looked up once for all of them.
template <class Visit>
void AtomField::visitCells(std::span<const DPoint3> points, const Visit& visit) const {
  struct Group {
    CellKey key;
    std::uint16_t count, end;  // in `order`
  };
  std::array<Group, kChunk> groups;
  std::array<std::uint16_t, kChunk> groupOf, order;
  for (std::size_t level = 0; level < levelCount_; ++level) {
    const AtomHash& hash = levels_[level];
    std::array<std::uint16_t, 2 * kChunk> table{};  // open addressing: a group + 1, or 0
    std::size_t count = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!isFinite(Vec3(points[i]))) continue;
      const CellKey key = hash.cellAt(points[i]);
      std::size_t slot = key.hash() % table.size();
      while (table[slot] > 0 && groups[table[slot] - 1U].key != key)
        slot = (slot + 1) % table.size();
      if (table[slot] == 0) {
        groups[count++] = {key, 0, 0};
        table[slot] = static_cast<std::uint16_t>(count);
      }
      groupOf[i] = static_cast<std::uint16_t>(table[slot] - 1U);
      ++groups[groupOf[i]].count;
    }
    std::uint16_t end = 0;
    for (std::size_t g = 0; g < count; ++g) {
      groups[g].end = end;
      end = static_cast<std::uint16_t>(end + groups[g].count);
    }
    for (std::size_t i = 0; i < points.size(); ++i)
      if (isFinite(Vec3(points[i])))
        order[groups[groupOf[i]].end++] = static_cast<std::uint16_t>(i);
    for (std::size_t g = 0; g < count; ++g) {
      const std::span members(order.data() + groups[g].end - groups[g].count, groups[g].count);
      hash.visit(groups[g].key,
                 [&](const CellFrame& frame, const AtomRun& run) { visit(frame, members, run); });
    }
  }
}

}  // namespace pbrt::surfels
