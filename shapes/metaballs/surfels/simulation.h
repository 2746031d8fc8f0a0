#pragma once
// Surface particles ("surfels"): free particles that cover a moving implicit surface, each of
// which stands for a small disc of it. J. van Kooten, G. van den Bergen and A. Telea 2007,
// "Point-Based Visualization of Metaballs on a GPU", after Witkin and Heckbert 1994.

#include <memory>
#include <vector>

#include "shapes/metaballs/surfels/moving_field.h"

namespace pbrt::surfels {

// A disc on the surface.
struct Surfel {
  DPoint3 p{};         // on the surface: |f| < 1e-3
  Normal3 n{0, 0, 1};  // unit, outward: -gradient
  float radius = 0;    // of the disc; together the discs leave no gap
  float density = 0;   // sigma: sum of the kernels of the surfels about it, its own 1 included
  // How the normal turns: that at p + x, x across n, is along n + B x, where B is symmetric:
  // xx, yy, zz, xy, xz, yz.
  float bend[6] = {};
};

class Simulation {
 public:
  struct Settings {
    std::size_t count = 16384;
    std::uint64_t seed = 0;
  };
  // What is known of the surfels after a step.
  struct Report {
    double reach = 0;        // h_p: within it surfels push one another away
    double evenness = 0;     // coefficient of variation of sigma
    double residual = 0;     // the greatest |f|
    std::size_t moved = 0;   // surfels that were set elsewhere: by dispersion, or to close a hole
    std::size_t holes = 0;   // places looked at that no disc covered
    std::size_t looked = 0;  // places looked at
  };

  // Throws std::invalid_argument for a count of 2^31 or more.
  explicit Simulation(const Settings& settings);
  ~Simulation();

  // Carries the surfels on to the surface of `field`, which is now where it is dt after the last
  // step's. dt may be anything finite from 0 on (else std::invalid_argument), and the field
  // anything: what cannot be followed is set anew. The first step makes the surfels. Uses all
  // threads; the bits do not depend on their number.
  void step(const MovingField& field, double dt);

  // As many as were asked for; none while there is no surface. In an order in which neighbours are
  // mostly near each other; it changes from step to step.
  std::span<const Surfel> surfels() const;
  const Report& report() const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace pbrt::surfels
