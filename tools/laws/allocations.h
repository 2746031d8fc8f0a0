#pragma once
// Counts the memory that is asked for.

#include <cstddef>

namespace pbrt::laws {

// How often this thread has called operator new so far, in programs that link counting_new; always
// 0 in others, and under sanitizers, which bring an operator new of their own.
std::size_t allocations();
// Whether this program counts at all.
bool countsAllocations();

// For operator new alone: one more.
void countAllocation();

}  // namespace pbrt::laws
