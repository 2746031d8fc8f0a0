// The laws of every sampler.

#include "laws.h"

namespace pbrt::laws {

std::span<const Law> samplerLaws() {
  return {};
}

}  // namespace pbrt::laws
