// The laws of every integrator.

#include "laws.h"

namespace pbrt::laws {

std::span<const Law> integratorLaws() {
  return {};
}

}  // namespace pbrt::laws
