#include "listing.h"

#include <fmt/format.h>

namespace pbrt {

namespace {

PluginKind kindByName(const std::string& name) {
  std::vector<std::string> names;
  for (std::uint32_t i = 0; i < kPluginKinds; ++i) {
    const auto kind = static_cast<PluginKind>(i);
    if (name == kindName(kind) || name == kindFolder(kind)) return kind;
    names.emplace_back(kindName(kind));
  }
  throw Error(fmt::format("there is no kind of plug-in \"{}\" (it is one of {}){}", name,
                          fmt::join(names, ", "), didYouMean(name, names)),
              Failure::usage);
}

class NoSurface final : public AreaSampler {
 public:
  double area() const override { return 1; }
  AreaSample sample(const DPoint3&, Point2) const override { return {}; }
  float pdf(const DPoint3&, const DPoint3&, const Normal3&) const override { return 0; }
  bool mayHit(const DPoint3&, const DVec3&) const override { return false; }
};

// Lets the plug-in read its parameters once, with nothing given. An object may come of it or not.
std::vector<Declaration> declarations(const PluginInfo& plugin, PluginKind kind) {
  std::vector<Declaration> found;
  Params params = Params::describing(plugin.name, found);
  const NoSurface surface;
  try {
    switch (kind) {
      case PluginKind::shape:
        create<Shape>(plugin, params, {});
        break;
      case PluginKind::material:
        create<Material>(plugin, params, {});
        break;
      case PluginKind::texture:
        create<Texture<Spectrum>>(plugin, params, {});
        break;
      case PluginKind::light:
        create<Light>(plugin, params, {{}, &surface});
        break;
      case PluginKind::camera:
        create<Camera>(plugin, params, {{}, {1, 1}});
        break;
      case PluginKind::sampler:
        create<Sampler>(plugin, params, {});
        break;
      case PluginKind::filter:
        create<Filter>(plugin, params, {});
        break;
      case PluginKind::integrator:
        create<Integrator>(plugin, params, {});
        break;
    }
  } catch (const Error&) {
    // Required parameters have no values here; what was declared before is what counts.
  }
  return found;
}

}  // namespace

std::string listPlugins(PluginLoader& loader) {
  std::string text;
  for (std::uint32_t i = 0; i < kPluginKinds; ++i) {
    const auto kind = static_cast<PluginKind>(i);
    text += fmt::format("{}\n", kindFolder(kind));
    for (const std::string& name : loader.available(kind)) {
      try {
        text += fmt::format("  {:<16} {}\n", name, loader.open(kind, name).summary);
      } catch (const Error& error) {
        text += fmt::format("  {:<16} cannot be used: {}\n", name, error.what());
      }
    }
  }
  return text;
}

std::string describePlugin(PluginLoader& loader, const std::string& kindText,
                           const std::string& name) {
  const PluginKind kind = kindByName(kindText);
  const PluginInfo& plugin = loader.open(kind, name);
  std::string text = fmt::format("{} \"{}\": {}\n", kindName(kind), plugin.name, plugin.summary);
  for (const Declaration& d : declarations(plugin, kind)) {
    const std::string fallback =
        d.defaultValue == "-" ? "" : fmt::format(" (default {})", d.defaultValue);
    const std::string unit = d.unit.empty() ? "" : fmt::format(" [{}]", d.unit);
    text += fmt::format("  {:<17} {:<17} {}{}{}\n", d.type, d.name, d.meaning, unit, fallback);
  }
  return text;
}

}  // namespace pbrt
