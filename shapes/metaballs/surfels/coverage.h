#pragma once
// How well surfels cover a surface, judged apart from the simulation that spread them.

#include <vector>

#include "shapes/metaballs/surfels/simulation.h"

namespace pbrt::surfels {

// A place on a surface.
struct Place {
  DPoint3 p{};
  Normal3 n{};        // unit, outward
  double weight = 1;  // the area that it stands for, in any unit
};

// At most `count` places, spread about as the surface's area is: the field's seeds from number
// `first` on, each brought onto the surface (|f| < 1e-4). Seeds for which that fails are left out.
std::vector<Place> places(const MovingField& field, std::uint64_t first, std::size_t count);

// Shares of the surface, by the places' weights. A surfel of another sheet, whose normal is more
// than a right angle off the place's, does not count.
struct Coverage {
  double covered = 1;  // nearer to some surfel than the radius of its disc
  double near = 1;     // nearer to some surfel than was asked for
};

// Without places: all is covered. Quickest if neighbours follow one another among the surfels, as
// they do in Simulation::surfels(). Uses all threads; the bits do not depend on their number.
Coverage coverage(std::span<const Surfel> surfels, std::span<const Place> places, double within);

}  // namespace pbrt::surfels
