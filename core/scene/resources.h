#pragma once
// What a scene defines by name and builds only when something uses it: textures and materials.

#include <map>
#include <memory>

#include "core/api/material.h"
#include "core/plugin/loader.h"
#include "core/scene/dialect.h"

namespace pbrt {

// `; did you mean "..."?` over the keys of a map, or nothing.
template <class Map>
std::string didYouMeanKey(std::string_view name, const Map& map) {
  std::vector<std::string> names;
  for (const auto& entry : map) names.push_back(entry.first);
  return didYouMean(name, names);
}

// Makes objects of plug-ins for a scene: finds them by the names its dialect knows, gives them its
// defaults, and refuses parameters that they do not read.
class Factory {
 public:
  Factory(PluginLoader& loader, Dialect dialect, Reporter report)
      : loader_(loader), dialect_(dialect), report_(std::move(report)) {}

  template <class Interface>
  std::unique_ptr<Interface> make(const std::string& name, const ParamList& params,
                                  const Location& where,
                                  const typename Interface::Setup& setup = {},
                                  TextureLibrary* textures = nullptr) {
    const PluginInfo& plugin = open(kindOf<Interface>, name, where);
    Params reader = this->params(plugin, where, {&params}, textures);
    auto object = create<Interface>(plugin, reader, setup);
    reader.refuseUnread();
    return object;
  }

  const PluginInfo& open(PluginKind kind, const std::string& name, const Location& where);
  Params params(const PluginInfo& plugin, const Location& where,
                std::vector<const ParamList*> lists, TextureLibrary* textures = nullptr) const;

  PluginLoader& loader() { return loader_; }
  Dialect dialect() const { return dialect_; }
  void report(Severity severity, const Location& where, std::string message) const {
    if (report_) report_(diagnose(severity, where, std::move(message)));
  }

 private:
  PluginLoader& loader_;
  Dialect dialect_;
  Reporter report_;
  std::map<std::pair<PluginKind, std::string>, bool> substituted_;  // warned about already
};

// The textures that can be named at some place of a scene. A scope never changes once it is made:
// a Texture statement makes a new one on top of the old.
class TextureScope final : public TextureLibrary {
 public:
  struct Definition {
    std::string plugin;
    ParamList params;
    Location where;
    Texture<float>::Setup place;
    std::shared_ptr<TextureScope> scope;  // of the textures that it may name itself
  };

  explicit TextureScope(Factory& factory) : factory_(factory) {}
  // `outer` with one texture more.
  TextureScope(const std::shared_ptr<TextureScope>& outer, const std::string& name, bool isSpectrum,
               Definition definition);

  std::shared_ptr<const Texture<float>> floatTexture(const std::string& name) override {
    return find<float>(name, floats_);
  }
  std::shared_ptr<const Texture<Spectrum>> spectrumTexture(const std::string& name) override {
    return find<Spectrum>(name, spectra_);
  }

 private:
  template <class T>
  struct Entry {
    Definition definition;
    std::shared_ptr<const Texture<T>> built;
  };
  template <class T>
  using Entries = std::map<std::string, std::shared_ptr<Entry<T>>>;

  template <class T>
  std::shared_ptr<const Texture<T>> find(const std::string& name, Entries<T>& entries);

  Factory& factory_;
  Entries<float> floats_;
  Entries<Spectrum> spectra_;
};

// A Material or MakeNamedMaterial statement.
class MaterialDefinition {
 public:
  // `scope`: where a named material finds its textures, that of its statement. Null for an unnamed
  // one: as in pbrt, it finds them where the shape is.
  MaterialDefinition(std::string plugin, ParamList params, Location where,
                     std::shared_ptr<TextureScope> scope = nullptr)
      : plugin_(std::move(plugin)),
        params_(std::move(params)),
        where_(where),
        scope_(std::move(scope)) {}

  // The material for shapes in `shapeScope` that add nothing to it; built once for each scope that
  // matters.
  std::shared_ptr<const Material> shared(Factory& factory,
                                         const std::shared_ptr<TextureScope>& shapeScope);
  // The material with some parameters of a shape before its own, all textures from the scope of the
  // shape. Those that it does not know either are left in `overrides`.
  std::shared_ptr<const Material> overridden(Factory& factory, TextureScope& scope,
                                             ParamList& overrides);

 private:
  std::string plugin_;
  ParamList params_;
  Location where_;
  std::shared_ptr<TextureScope> scope_;
  std::shared_ptr<const Material> built_;
  std::shared_ptr<TextureScope> builtIn_;
};

}  // namespace pbrt
