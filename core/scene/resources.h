#pragma once
// What a scene defines by name and builds only when something uses it: textures and materials.

#include <memory>
#include <optional>

#include "core/api/material.h"
#include "core/scene/factory.h"
#include "core/scene/names.h"

namespace pbrt {

class MaterialDefinition;

// A Texture statement.
template <class T>
struct TextureDefinition;

// What can be named at some place of a scene. Copied freely: definitions never change what others
// see, they only come before it.
struct Scope {
  Named<TextureDefinition<float>>* floats = nullptr;
  Named<TextureDefinition<Spectrum>>* spectra = nullptr;
  Named<std::shared_ptr<MaterialDefinition>>* materials = nullptr;

  bool sameTextures(const Scope& other) const {
    return floats == other.floats && spectra == other.spectra;
  }
};

template <class T>
struct TextureDefinition {
  std::string plugin;
  ParamList params;
  std::shared_ptr<const ParamList> attributes;  // of lower rank, by Attribute "texture"
  Location where;
  typename Texture<T>::Setup place;
  Scope scope;  // of the textures that it may name itself
  std::shared_ptr<const Texture<T>> built;
  std::size_t lookups = 0;  // of textures, for one of this; once it is built
};

// Keeps all definitions of a scene, and builds those that are used.
class Resources {
 public:
  // Definitions that name one another may be nested this deep.
  static constexpr int kDeepest = 100;
  // To look a texture up may take so many lookups of others. They are counted as often as they are
  // named: where each names the one before twice, a hundred would take 2^100.
  static constexpr std::size_t kMostLookups = 10000;

  explicit Resources(Factory& factory) : factory_(factory) {}
  Resources(const Resources&) = delete;
  Resources& operator=(const Resources&) = delete;

  void define(Scope& scope, const std::string& name, TextureDefinition<float> definition);
  void define(Scope& scope, const std::string& name, TextureDefinition<Spectrum> definition);
  void define(Scope& scope, const std::string& name, std::shared_ptr<MaterialDefinition> material);

  // Never null; they throw Error (with "did you mean") if the scope has none of this name. In a
  // permissive scene a magenta texture stands for one that cannot be had.
  std::shared_ptr<const Texture<float>> floatTexture(const Scope& scope, const std::string& name);
  std::shared_ptr<const Texture<Spectrum>> spectrumTexture(const Scope& scope,
                                                           const std::string& name);
  std::shared_ptr<MaterialDefinition> material(const Scope& scope, const std::string& name) const;

  Factory& factory() { return factory_; }
  // Definitions that name one another may be nested this deep: while it lives, one is being built.
  std::shared_ptr<void> nest();

 private:
  template <class T>
  std::shared_ptr<const Texture<T>> build(TextureDefinition<T>& definition);

  Factory& factory_;
  int depth_ = 0;            // of what is being built
  std::size_t lookups_ = 0;  // that one of the texture being built takes so far
  NamedList<TextureDefinition<float>> floats_;
  NamedList<TextureDefinition<Spectrum>> spectra_;
  NamedList<std::shared_ptr<MaterialDefinition>> materials_;
};

// The textures of a scope, for parameters that name some. Both must outlive it.
class Library final : public TextureLibrary {
 public:
  Library(Resources& resources, const Scope& scope) : resources_(resources), scope_(scope) {}
  std::shared_ptr<const Texture<float>> floatTexture(const std::string& name) override {
    return resources_.floatTexture(scope_, name);
  }
  std::shared_ptr<const Texture<Spectrum>> spectrumTexture(const std::string& name) override {
    return resources_.spectrumTexture(scope_, name);
  }
  std::shared_ptr<const Material> material(const std::string& name) override;

 private:
  Resources& resources_;
  const Scope& scope_;
};

// A Material or MakeNamedMaterial statement.
class MaterialDefinition {
 public:
  // `scope`: where a named material finds its textures, that of its statement. None for an unnamed
  // one: as in pbrt, it finds them where the shape is.
  MaterialDefinition(std::string plugin, ParamList params,
                     std::shared_ptr<const ParamList> attributes, Location where,
                     std::optional<Scope> scope = {})
      : plugin_(std::move(plugin)),
        params_(std::move(params)),
        attributes_(std::move(attributes)),
        where_(where),
        scope_(scope) {}

  // Whether it is no material, but the border between media: nothing to be seen.
  bool isInterface() const;
  // The material for shapes in `shapeScope` that add nothing to it; built once for each scope that
  // matters.
  std::shared_ptr<const Material> shared(Resources& resources, const Scope& shapeScope);
  // The material with some parameters of a shape before its own, all textures from the scope of the
  // shape. Those that it does not know either are left in `overrides`.
  std::shared_ptr<const Material> overridden(Resources& resources, const Scope& shapeScope,
                                             ParamList& overrides);

 private:
  std::string plugin_;
  ParamList params_;
  std::shared_ptr<const ParamList> attributes_;  // of lower rank, by Attribute "material"
  Location where_;
  std::optional<Scope> scope_;
  std::shared_ptr<const Material> built_;
  Scope builtIn_;
};

}  // namespace pbrt
