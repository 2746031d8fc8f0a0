#include "core/base/colorspace.h"

namespace pbrt {
std::optional<ColorSpace> colorSpaceByName(std::string_view name) {
  for (std::size_t i = 0; i < kColorSpaceNames.size(); ++i)
    if (kColorSpaceNames[i] == name) return static_cast<ColorSpace>(i);
  return {};
}
glm::dmat3 rec709From(ColorSpace) { return glm::dmat3(1); }
}  // namespace pbrt
