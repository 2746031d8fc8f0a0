#include "making.h"

namespace pbrt::laws {
namespace {

class NoSurface final : public AreaSampler {
 public:
  double area() const override { return 1; }
  AreaSample sample(const DPoint3&, Point2) const override { return {}; }
  float pdf(const DPoint3&, const DPoint3&, const Normal3&) const override { return 0; }
  bool mayHit(const DPoint3&, const DVec3&) const override { return false; }
};

class NoLight final : public SamplingIntegrator {
 public:
  Spectrum Li(const World&, const RayDifferential&, const Hit&, Sampler&, Scratch&) const override {
    return Spectrum(0);
  }
};

template <class Interface>
void make(const PluginInfo& plugin, Params& reader, const typename Interface::Setup& setup = {}) {
  if (!create<Interface>(plugin, reader, setup))
    throw Error("its create() gives no object", Failure::plugin);
}

}  // namespace

void make(const PluginInfo& plugin, Params& reader) {
  const NoSurface surface;
  const NoLight light;
  switch (plugin.kind) {
    case PluginKind::shape:
      return make<Shape>(plugin, reader);
    case PluginKind::material:
      return make<Material>(plugin, reader);
    case PluginKind::texture:
      return make<Texture<Spectrum>>(plugin, reader);
    case PluginKind::light:
      return make<Light>(plugin, reader, {{}, &surface});
    case PluginKind::camera:
      return make<Camera>(plugin, reader, {{}, {1, 1}});
    case PluginKind::sampler:
      return make<Sampler>(plugin, reader);
    case PluginKind::filter:
      return make<Filter>(plugin, reader);
    case PluginKind::integrator:
      return make<Integrator>(plugin, reader, {&light});
    case PluginKind::volume:
      return make<Medium>(plugin, reader);
  }
}

std::vector<Declaration> declarationsOf(const PluginInfo& plugin) {
  std::vector<Declaration> found;
  Params reader = Params::describing(plugin.name, found);
  try {
    make(plugin, reader);
  } catch (const Error&) {
    // Required parameters have no values here; what was declared before is what counts.
  }
  return found;
}

}  // namespace pbrt::laws
