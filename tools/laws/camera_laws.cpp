// The laws of every camera.

#include "laws.h"

namespace pbrt::laws {

std::span<const Law> cameraLaws() {
  return {};
}

}  // namespace pbrt::laws
