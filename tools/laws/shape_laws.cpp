#include "shape_laws.h"

namespace pbrt::laws {

std::span<const Law> shapeLaws() {
  static const std::vector<Law> all = [] {
    std::vector<Law> laws;
    for (const auto& part : {shapeHitLaws(), shapeSurfaceLaws(), shapeObjectLaws(),
                             shapeColourLaws(), shapeAreaLaws(), implicitLaws(), meshLaws()})
      laws.insert(laws.end(), part.begin(), part.end());
    return laws;
  }();
  return all;
}

}  // namespace pbrt::laws
