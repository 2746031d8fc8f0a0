#pragma once
// The parameters of a metaballs shape: atoms from the scene file or from a file of particles.

#include "core/base/spectrum.h"
#include "core/plugin/params.h"
#include "shapes/metaballs/field.h"

namespace pbrt::metaballs {

struct Input {
  Field field;
  std::vector<Spectrum> colors;  // empty, or one for each atom of the field
};

// Throws Error with the place of the parameter, or of the file, and the number of the atom at
// fault.
Input readInput(Params& params);

}  // namespace pbrt::metaballs
