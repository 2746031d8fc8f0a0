#pragma once
// What AttributeBegin saves and AttributeEnd restores, beside the transforms.

#include <array>
#include <memory>
#include <optional>

#include "core/parse/directive.h"
#include "core/scene/resources.h"

namespace pbrt {

// For whose parameters an Attribute statement (pbrt-v4) gives defaults.
enum class AttributeTarget : std::uint8_t { shape, light, material, medium, texture };
inline constexpr std::array<std::string_view, 5> kAttributeTargets = {"shape", "light", "material",
                                                                      "medium", "texture"};

// Cheap to copy: what it points to never changes, it is only replaced.
struct Attributes {
  bool reverse = false;
  std::shared_ptr<MaterialDefinition> material;
  std::shared_ptr<const Directive> areaLight;
  std::shared_ptr<const Directive> media;  // MediumInterface, two words; null: clear air
  std::size_t mediaNamed = 0;  // how many MakeNamedMedium statements came before the shape
  std::shared_ptr<const ParamList> areaLightDefaults;
  Scope scope;
  std::array<std::shared_ptr<const ParamList>, kAttributeTargets.size()> defaults;

  // Null: none.
  const std::shared_ptr<const ParamList>& defaultsOf(AttributeTarget target) const {
    return defaults[static_cast<std::size_t>(target)];
  }
};

}  // namespace pbrt
