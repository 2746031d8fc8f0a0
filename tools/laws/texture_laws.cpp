// The laws of every texture.

#include "laws.h"

namespace pbrt::laws {

std::span<const Law> textureLaws() {
  return {};
}

}  // namespace pbrt::laws
