#include "core/scene/resources.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace pbrt {

namespace {

template <class T>
std::vector<std::string> namesOf(const Named<T>* last) {
  std::vector<std::string> names;
  for (; last; last = last->before) names.push_back(last->name);
  return names;
}

// What is seen where something could not be had.
ParamList magenta(const std::string& name) {
  return {{ParamType::rgb, name, {}, {}, std::vector<float>{1, 0, 1}}};
}

Error noTexture(std::string_view name, bool isFloat, bool otherKind,
                const std::vector<std::string>& names) {
  constexpr std::array kKinds = {"color", "float"};
  if (otherKind)
    return Error(fmt::format("texture \"{}\" is a {} texture, but a {} texture is needed",
                             shown(name), kKinds[isFloat ? 0 : 1], kKinds[isFloat ? 1 : 0]));
  return Error(fmt::format("there is no {} texture \"{}\"{}", kKinds[isFloat ? 1 : 0], shown(name),
                           didYouMean(name, names)));
}

}  // namespace

void Resources::define(Scope& scope, const std::string& name, TextureDefinition<float> d) {
  floats_.add(scope.floats, name, std::move(d));
}
void Resources::define(Scope& scope, const std::string& name, TextureDefinition<Spectrum> d) {
  spectra_.add(scope.spectra, name, std::move(d));
}
void Resources::define(Scope& scope, const std::string& name,
                       std::shared_ptr<MaterialDefinition> material) {
  materials_.add(scope.materials, name, std::move(material));
}

std::shared_ptr<const Texture<float>> Resources::floatTexture(const Scope& scope,
                                                              const std::string& name) {
  auto* found = floats_.find(scope.floats, name);
  if (!found)
    throw noTexture(name, true, spectra_.find(scope.spectra, name), namesOf(scope.floats));
  return build(found->value);
}

std::shared_ptr<const Texture<Spectrum>> Resources::spectrumTexture(const Scope& scope,
                                                                    const std::string& name) {
  auto* found = spectra_.find(scope.spectra, name);
  if (!found)
    throw noTexture(name, false, floats_.find(scope.floats, name), namesOf(scope.spectra));
  return build(found->value);
}

std::shared_ptr<void> Resources::nest() {
  if (depth_ >= kDeepest)
    throw Error(fmt::format("definitions name one another more than {} deep", kDeepest));
  ++depth_;
  return {nullptr, [this](void*) { --depth_; }};
}

template <class T>
std::shared_ptr<const Texture<T>> Resources::build(TextureDefinition<T>& d) {
  if (!d.built) {
    const auto nested = nest();
    const std::size_t outer = std::exchange(lookups_, 1);
    Library library(*this, d.scope);
    const bool made = factory_.attempt([&] {
      auto texture = factory_.make<Texture<T>>(d.plugin, d.params, d.where, d.place, &library,
                                               d.attributes.get());
      if (lookups_ > kMostLookups)
        throw Error(d.where,
                    fmt::format("to look this texture up takes more than {} lookups: what it "
                                "names names others, again and again",
                                kMostLookups));
      d.built = std::move(texture);
    });
    if (!made) {
      ParamList value = magenta("value");
      if constexpr (std::is_same_v<T, float>)
        value = {{ParamType::number, "value", {}, {}, std::vector<float>{1}}};
      d.built = factory_.make<Texture<T>>("constant", value, d.where);
      lookups_ = 1;
    }
    d.lookups = std::exchange(lookups_, outer);
  }
  lookups_ += d.lookups;
  return d.built;
}

std::shared_ptr<MaterialDefinition> Resources::material(const Scope& scope,
                                                        const std::string& name) const {
  const auto* found = materials_.find(scope.materials, name);
  if (!found)
    throw Error(fmt::format("there is no named material \"{}\"{}", shown(name),
                            didYouMean(name, namesOf(scope.materials))));
  return found->value;
}

std::shared_ptr<const Material> Library::material(const std::string& name) {
  const auto definition = resources_.material(scope_, name);
  if (definition->isInterface())
    throw Error(fmt::format("material \"{}\" is no surface, and cannot be mixed", shown(name)));
  return definition->shared(resources_, scope_);
}

bool MaterialDefinition::isInterface() const {
  return plugin_.empty() || plugin_ == "none" || plugin_ == "interface";
}

std::shared_ptr<const Material> MaterialDefinition::shared(Resources& resources,
                                                           const Scope& shapeScope) {
  const Scope& scope = scope_ ? *scope_ : shapeScope;
  const auto isTexture = [](const Param& p) { return p.type == ParamType::texture; };
  const bool usesTextures =
      std::any_of(params_.begin(), params_.end(), isTexture) ||
      (attributes_ && std::any_of(attributes_->begin(), attributes_->end(), isTexture));
  if (built_ && (!usesTextures || builtIn_.sameTextures(scope))) return built_;
  const auto nested = resources.nest();
  Library library(resources, scope);
  Factory& factory = resources.factory();
  const bool made = factory.attempt([&] {
    built_ = factory.make<Material>(plugin_, params_, where_, {}, &library, attributes_.get());
  });
  if (!made) built_ = factory.make<Material>("matte", magenta("Kd"), where_);
  builtIn_ = scope;
  return built_;
}

std::shared_ptr<const Material> MaterialDefinition::overridden(Resources& resources,
                                                               const Scope& shapeScope,
                                                               ParamList& overrides) {
  Factory& factory = resources.factory();
  const PluginInfo& plugin = factory.open(PluginKind::material, plugin_, where_);
  std::vector<const ParamList*> lists = {&overrides, &params_};
  if (attributes_) lists.push_back(attributes_.get());
  Library library(resources, shapeScope);
  Params params = factory.params(plugin, plugin_, where_, std::move(lists), &library);
  std::shared_ptr<const Material> material = Factory::make<Material>(plugin, params, {});
  factory.attempt([&] { params.refuseUnread(1); });
  ParamList left;
  for (const Param* unread : params.unread(0)) left.push_back(*unread);
  overrides = std::move(left);
  return material;
}

}  // namespace pbrt
