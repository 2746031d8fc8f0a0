#pragma once
// One reader a format. Each throws Error at what is malformed, before it makes room for more
// particles than the file can hold; whether the numbers are finite is left to the caller.

#include "particles.h"
#include "shapes/files/input.h"

namespace pbrt::particles {

using files::Input;

// Stanford PLY: ascii, binary in either byte order; of its elements only "vertex" is read.
Particles readPly(const Input& input);

// Legacy VTK files, text or binary, that hold POLYDATA or an UNSTRUCTURED_GRID.
Particles readVtk(const Input& input);

// Rows of text with commas, semicolons, tabs or blanks between, with or without a row of names.
Particles readTable(const Input& input);

// Positions alone, as little-endian float32.
Particles readRaw(const Input& input);
// Whether that is what a file is that may also be text. Throws Error if it might be either.
bool isRaw(const Input& input);

// Houdini's classic geometry (to version 11; .bhclassic since).
Particles readBgeo(const Input& input);

}  // namespace pbrt::particles
