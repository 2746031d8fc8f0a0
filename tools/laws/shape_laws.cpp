// The laws of every shape.

#include "laws.h"

namespace pbrt::laws {

std::span<const Law> shapeLaws() {
  return {};
}

}  // namespace pbrt::laws
