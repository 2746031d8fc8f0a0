#pragma once
// Values as findings show them.

#include <fmt/format.h>

#include "core/base/math.h"

namespace pbrt::laws {

inline std::string show(Vec2 v) {
  return fmt::format("({}, {})", v.x, v.y);
}
inline std::string show(const Vec3& v) {
  return fmt::format("({}, {}, {})", v.x, v.y, v.z);
}

}  // namespace pbrt::laws
