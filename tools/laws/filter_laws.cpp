// The laws of every filter.

#include "laws.h"

namespace pbrt::laws {

std::span<const Law> filterLaws() {
  return {};
}

}  // namespace pbrt::laws
