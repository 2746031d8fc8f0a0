#include "core/scene/resources.h"

#include <fmt/format.h>

namespace pbrt {

namespace {

std::string shown(std::string_view name) {
  return name.size() > 60 ? fmt::format("{}...", name.substr(0, 60)) : std::string(name);
}

}  // namespace

const PluginInfo& Factory::open(PluginKind kind, const std::string& name, const Location& where) {
  try {
    const Alias* alias = findAlias(kind, name);
    const bool own = !alias || [&] {  // a plug-in of that very name goes before its stand-in
      if (alias->exact) return false;
      const auto names = loader_.available(kind);
      return std::find(names.begin(), names.end(), name) != names.end();
    }();
    if (own) return loader_.open(kind, name);
    if (!alias->exact && !substituted_[{kind, name}]) {
      substituted_[{kind, name}] = true;
      report(Severity::warning, where,
             fmt::format("there is no {} \"{}\" yet; \"{}\" takes its place", kindName(kind), name,
                         alias->target));
    }
    return loader_.open(kind, std::string(alias->target));
  } catch (const Error& error) {
    throw error.at(where);
  }
}

Params Factory::params(const PluginInfo& plugin, const Location& where,
                       std::vector<const ParamList*> lists, TextureLibrary* textures) const {
  return {fmt::format("{}/{}", kindFolder(plugin.kind), plugin.name),
          where,
          std::move(lists),
          textures,
          report_,
          &parameterDefaults(dialect_, plugin.kind, plugin.name)};
}

TextureScope::TextureScope(const std::shared_ptr<TextureScope>& outer, const std::string& name,
                           bool isSpectrum, Definition definition)
    : factory_(outer->factory_), floats_(outer->floats_), spectra_(outer->spectra_) {
  if (isSpectrum)
    spectra_[name] = std::make_shared<Entry<Spectrum>>(Entry<Spectrum>{std::move(definition), {}});
  else
    floats_[name] = std::make_shared<Entry<float>>(Entry<float>{std::move(definition), {}});
}

template <class T>
std::shared_ptr<const Texture<T>> TextureScope::find(const std::string& name, Entries<T>& entries) {
  const auto found = entries.find(name);
  if (found == entries.end()) {
    constexpr bool isFloat = std::is_same_v<T, float>;
    const bool otherKind = isFloat ? spectra_.contains(name) : floats_.contains(name);
    if (otherKind)
      throw Error(fmt::format("texture \"{}\" is a {} texture, but a {} texture is needed",
                              shown(name), isFloat ? "color" : "float",
                              isFloat ? "float" : "color"));
    throw Error(fmt::format("there is no {} texture \"{}\"{}", isFloat ? "float" : "color",
                            shown(name), didYouMeanKey(name, entries)));
  }
  Entry<T>& entry = *found->second;
  if (!entry.built) {
    const Definition& d = entry.definition;
    entry.built = factory_.make<Texture<T>>(d.plugin, d.params, d.where,
                                            {d.place.placement, d.place.world}, d.scope.get());
  }
  return entry.built;
}

std::shared_ptr<const Material> MaterialDefinition::shared(
    Factory& factory, const std::shared_ptr<TextureScope>& shapeScope) {
  const std::shared_ptr<TextureScope>& scope = scope_ ? scope_ : shapeScope;
  const bool usesTextures = std::any_of(
      params_.begin(), params_.end(), [](const Param& p) { return p.type == ParamType::texture; });
  if (!built_ || (usesTextures && builtIn_ != scope)) {
    built_ = factory.make<Material>(plugin_, params_, where_, {}, scope.get());
    builtIn_ = scope;
  }
  return built_;
}

std::shared_ptr<const Material> MaterialDefinition::overridden(Factory& factory,
                                                               TextureScope& scope,
                                                               ParamList& overrides) {
  const PluginInfo& plugin = factory.open(PluginKind::material, plugin_, where_);
  Params params = factory.params(plugin, where_, {&overrides, &params_}, &scope);
  std::shared_ptr<const Material> material = create<Material>(plugin, params, {});
  params.refuseUnread(1);
  ParamList left;
  for (const Param* unread : params.unread(0)) left.push_back(*unread);
  overrides = std::move(left);
  return material;
}

}  // namespace pbrt
