#pragma once
// Water in a closed tank, by smoothed particles whose density is a constraint on their positions
// (M. Macklin and M. Mueller 2013, "Position Based Fluids"): stable for any time step.

#include <span>
#include <vector>

#include "core/base/bounds.h"

namespace pbrt::motion {

inline constexpr float kGravity = 9.81F;  // along -y

// Particles of unit mass. All is deterministic for any number of threads.
class Water {
 public:
  // `spacing`: the distance of neighbours on a cubic lattice at rest density. `depth`: from where
  // the water can fall at most; it bounds the time step.
  Water(std::vector<Point3> positions, const Bounds3& tank, float spacing, float depth);

  // In steps of equal length, in which no wave goes further than a fraction of the spacing.
  void advance(double seconds);

  // By the numbers of the particles, which stay. Always within the tank.
  std::span<const Point3> positions() const { return positions_; }
  std::span<const Vec3> velocities() const { return velocities_; }
  // Over the rest density, at most times between 1 and 1.05, lower next to the open; 1 is also
  // what a particle in a lattice has.
  std::vector<float> densities();

 private:
  struct Wall {
    float value = 0;
    Vec3 gradient{};
  };
  struct Vectors {
    std::vector<float> x, y, z;
    void assign(std::size_t n, float value);
    void set(std::size_t i, const Vec3& v);
    Vec3 operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
  };
  // What is near some particles that follow each other in the order of the cells.
  struct Piece {
    std::vector<std::uint32_t> starts;  // of each one's neighbours; and the end
    std::vector<std::uint32_t> others;
  };

  void step(float dt);
  void sort(std::span<const Point3> points);
  void weigh();
  void push(float dt);
  void findNeighbours(std::size_t i, Piece& piece) const;
  template <class Body>
  void forEach(Body&& body);
  template <class Body>
  void forNeighbours(std::size_t i, const Piece& piece, Body&& body) const;
  Wall wall(const Point3& p) const;
  Point3 inside(const Point3& p) const;
  glm::ivec3 cell(const Point3& p) const;

  std::vector<Point3> positions_;
  std::vector<Vec3> velocities_;
  Bounds3 tank_;
  float spacing_;
  float support_;
  float longestStep_;
  float fastest_;
  glm::ivec3 cells_;

  std::vector<Point3> aims_;  // where they would be without each other
  // In the order of the cells; then one that is far away, and room for lanes that do not count.
  std::vector<std::uint32_t> number_;     // of the particle
  std::vector<std::uint32_t> cellStart_;  // the first particle of each cell, and the end
  Vectors at_, speed_;
  std::vector<float> density_;
  std::vector<float> pressure_;  // the constraint's Lagrange multiplier
  std::vector<Vec3> drag_;       // by how much neighbours are faster, on the mean
  std::vector<Piece> pieces_;
};

}  // namespace pbrt::motion
