#include "core/scene/aov.h"

#include <algorithm>
#include <array>

namespace pbrt {

namespace {

constexpr std::array<std::string_view, 10> kNames = {
    "variance", "albedo", "normal",          "position",    "depth",
    "samples",  "uv",     "geometricnormal", "derivatives", "shape"};

}  // namespace

std::span<const std::string_view> aovNames() {
  return kNames;
}

std::optional<AovSet> aovByName(std::string_view name) {
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end()) return {};
  return static_cast<AovSet>(1U << (found - kNames.begin()));
}

}  // namespace pbrt
