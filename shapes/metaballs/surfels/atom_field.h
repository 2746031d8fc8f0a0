#pragma once
// The field of a fluid: atoms that move.

#include "shapes/metaballs/surfels/atom_hash.h"
#include "shapes/metaballs/surfels/moving_field.h"

namespace pbrt::surfels {

class AtomField final : public MovingField {
 public:
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
  // The next three take few points.
  void some(std::span<const DPoint3> points, std::span<FieldAt> out) const;
  // Calls visit(frame, members, run) with cells, which of the points are in it, and some of the
  // atoms that touch it, until all were in a run.
  template <class Visit>
  void visitCells(std::span<const DPoint3> points, const Visit& visit) const;
  bool seed(std::uint64_t number, DPoint3& out) const;

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
};

}  // namespace pbrt::surfels
