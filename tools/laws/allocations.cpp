#include "allocations.h"

#include <new>

namespace pbrt::laws {
namespace {
thread_local std::size_t count = 0;
}

std::size_t allocations() {
  return count;
}
bool countsAllocations() {
  const std::size_t before = count;
  ::operator delete(::operator new(1));
  return count != before;
}
void countAllocation() {
  ++count;
}

}  // namespace pbrt::laws
