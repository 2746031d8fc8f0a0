#pragma once
// Textures with textures inside.

#include "tests/support.h"

namespace pbrt::test {

// A texture that says what it is asked for: u, and that it filters.
template <class T>
class Ramp final : public Texture<T> {
 public:
  T evaluate(const SurfaceInteraction& at) const override { return T(at.uv.x); }
  bool filters() const override { return true; }
};

class Ramps final : public TextureLibrary {
 public:
  std::shared_ptr<const Texture<float>> floatTexture(const std::string&) override {
    return std::make_shared<Ramp<float>>();
  }
  std::shared_ptr<const Texture<Spectrum>> spectrumTexture(const std::string&) override {
    return std::make_shared<Ramp<Spectrum>>();
  }
  std::shared_ptr<const Material> material(const std::string& name) override {
    throw Error("no texture asks for the material " + name);
  }
};

inline Param ramp(std::string name) {
  return {ParamType::texture, std::move(name), {}, {}, std::vector<std::string>{"ramp"}};
}

template <class T>
std::unique_ptr<Texture<T>> makeOver(const std::string& name, const ParamList& list) {
  Ramps ramps;
  Params params(name, {}, {&list}, &ramps);
  return create<Texture<T>>(loader().open(PluginKind::texture, name), params, {});
}

}  // namespace pbrt::test
