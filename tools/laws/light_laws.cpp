// The laws of every light.

#include "laws.h"

namespace pbrt::laws {

std::span<const Law> lightLaws() {
  return {};
}

}  // namespace pbrt::laws
