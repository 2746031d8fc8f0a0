#pragma once
// The kinds of plug-in, and the interface that each implements.

#include <string_view>

#include "core/api/camera.h"
#include "core/api/filter.h"
#include "core/api/integrator.h"
#include "core/api/light.h"
#include "core/api/material.h"
#include "core/api/medium.h"
#include "core/api/sampler.h"
#include "core/api/shape.h"
#include "core/api/texture.h"

namespace pbrt {

enum class PluginKind : std::uint32_t {
  shape,
  material,
  texture,
  light,
  camera,
  sampler,
  filter,
  integrator,
  volume
};
inline constexpr std::uint32_t kPluginKinds = 9;

// "shape" and, for its folder, "shapes".
std::string_view kindName(PluginKind kind);
std::string_view kindFolder(PluginKind kind);

template <class Interface>
inline constexpr PluginKind kindOf = [] {
  static_assert(sizeof(Interface) == 0, "not an interface that plug-ins implement");
  return PluginKind::shape;
}();
template <>
inline constexpr PluginKind kindOf<Shape> = PluginKind::shape;
template <>
inline constexpr PluginKind kindOf<Material> = PluginKind::material;
template <>
inline constexpr PluginKind kindOf<Texture<float>> = PluginKind::texture;
template <>
inline constexpr PluginKind kindOf<Texture<Spectrum>> = PluginKind::texture;
template <>
inline constexpr PluginKind kindOf<Light> = PluginKind::light;
template <>
inline constexpr PluginKind kindOf<Camera> = PluginKind::camera;
template <>
inline constexpr PluginKind kindOf<Sampler> = PluginKind::sampler;
template <>
inline constexpr PluginKind kindOf<Filter> = PluginKind::filter;
template <>
inline constexpr PluginKind kindOf<Integrator> = PluginKind::integrator;
template <>
inline constexpr PluginKind kindOf<Medium> = PluginKind::volume;

}  // namespace pbrt
