#pragma once
// The laws of shapes, by what they ask. Those of another sort of shape skip themselves.

#include "laws.h"

namespace pbrt::laws {

// Of shapes that are asked ray by ray.
std::span<const Law> shapeHitLaws();
std::span<const Law> shapeSurfaceLaws();
std::span<const Law> shapeObjectLaws();
// Of those that bring colours along.
std::span<const Law> shapeColourLaws();
// Of those that can be area lights.
std::span<const Law> shapeAreaLaws();
// Of those that lend an implicit field.
std::span<const Law> implicitLaws();
// Of those that are handed over as triangles.
std::span<const Law> meshLaws();

}  // namespace pbrt::laws
