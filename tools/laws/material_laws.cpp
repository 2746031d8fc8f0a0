// The laws of every material.

#include "laws.h"

namespace pbrt::laws {

std::span<const Law> materialLaws() {
  return {};
}

}  // namespace pbrt::laws
