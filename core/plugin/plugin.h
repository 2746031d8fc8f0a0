#pragma once
// The entry point of a plug-in: the last line of its file is
//   PBRT_PLUGIN(Shape, Sphere, "sphere", "a ball about the origin")

#include "core/plugin/stamp.h"

namespace pbrt {

// What the entry function returns.
struct PluginInfo {
  PluginStamp stamp;  // comes first in every version
  PluginKind kind;
  const char* name;
  const char* summary;  // one sentence for a student
  // Reads its parameters and makes the object, which the caller owns (delete through the
  // interface). `setup` points to the interface's Setup. Throws Error.
  void* (*create)(Params& params, const void* setup);
  // Textures alone: the same for Texture<Spectrum>, where create makes Texture<float>.
  void* (*createSpectrum)(Params& params, const void* setup);
};

using PluginEntry = const PluginInfo* (*)();
inline constexpr const char* kPluginSymbol = "pbrt_plugin";

template <class Interface, class Class>
void* createPlugin(Params& params, const void* setup) {
  using Setup = typename Interface::Setup;
  Interface* object;
  if constexpr (std::is_constructible_v<Class, Params&, const Setup&>)
    object = new Class(params, *static_cast<const Setup*>(setup));
  else
    object = new Class(params);
  return object;
}

}  // namespace pbrt

#define PBRT_PLUGIN_EXPORT extern "C" __attribute__((visibility("default")))

// Interface: Shape, Material, Light, Camera, Sampler, Filter, Integrator or Medium.
// `constexpr` puts the stamp into the file, where the loader finds it before anything runs.
#define PBRT_PLUGIN(Interface, Class, name, summary)                                   \
  PBRT_PLUGIN_EXPORT const pbrt::PluginInfo* pbrt_plugin() {                           \
    static constexpr pbrt::PluginInfo info{{},                                         \
                                           pbrt::kindOf<pbrt::Interface>,              \
                                           name,                                       \
                                           summary,                                    \
                                           pbrt::createPlugin<pbrt::Interface, Class>, \
                                           nullptr};                                   \
    return &info;                                                                      \
  }

// Class is a template over float and Spectrum.
#define PBRT_TEXTURE_PLUGIN(Class, name, summary)                                  \
  PBRT_PLUGIN_EXPORT const pbrt::PluginInfo* pbrt_plugin() {                       \
    static constexpr pbrt::PluginInfo info{                                        \
        {},                                                                        \
        pbrt::PluginKind::texture,                                                 \
        name,                                                                      \
        summary,                                                                   \
        pbrt::createPlugin<pbrt::Texture<float>, Class<float>>,                    \
        pbrt::createPlugin<pbrt::Texture<pbrt::Spectrum>, Class<pbrt::Spectrum>>}; \
    return &info;                                                                  \
  }
