#pragma once
// How surfels push one another away: van Kooten et al. 2007, section 4.

#include "shapes/metaballs/surfels/neighbours.h"

namespace pbrt::surfels {

// What the surfels within the reach do to one.
struct Repulsion {
  float push[3] = {};    // where it is to go, in reaches, across its normal
  float density = 0;     // sigma
  float neighbours = 0;  // how many there are
  float crowding = 0;    // mean of theirs and its own, the nearer the more
};

// For the surfels of the given cells; out[i] is that of surfel i.
using Repel = void(const GridView& grid, std::span<const Cell> cells, Repulsion* out);
Repel repel;
// Those that this machine supports, which give the same bits: the portable one first, the best
// last.
std::span<Repel* const> allRepels();

}  // namespace pbrt::surfels
