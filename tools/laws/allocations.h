#pragma once
// Counts the memory that is asked for. A program that calls this gets operator new from
// allocations.cpp.

#include <cstddef>

namespace pbrt::laws {

// How often this thread has called operator new so far. Always 0 under a sanitizer, which brings an
// operator new of its own.
std::size_t allocations();

}  // namespace pbrt::laws
