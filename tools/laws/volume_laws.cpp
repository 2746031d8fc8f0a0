// The laws of every volume.

#include "laws.h"

namespace pbrt::laws {

std::span<const Law> volumeLaws() {
  return {};
}

}  // namespace pbrt::laws
