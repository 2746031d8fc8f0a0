#include "laws.h"

namespace pbrt::laws {

std::span<const Law> lawsOf(PluginKind kind) {
  switch (kind) {
    case PluginKind::shape:
      return shapeLaws();
    case PluginKind::material:
      return materialLaws();
    case PluginKind::texture:
      return textureLaws();
    case PluginKind::light:
      return lightLaws();
    case PluginKind::camera:
      return cameraLaws();
    case PluginKind::sampler:
      return samplerLaws();
    case PluginKind::filter:
      return filterLaws();
    case PluginKind::integrator:
      return integratorLaws();
    case PluginKind::volume:
      return volumeLaws();
  }
  return {};
}

}  // namespace pbrt::laws
