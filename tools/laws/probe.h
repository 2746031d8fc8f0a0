#pragma once
// Textures that a plug-in under trial is given, which tell whether it looks into them.

#include "parameters.h"

namespace pbrt::laws {

// Every texture of the library has one value everywhere, and says that it filters.
class Probes final : public TextureLibrary {
 public:
  explicit Probes(float value) : value_(value) {}
  bool asked() const { return asked_; }

  std::shared_ptr<const Texture<float>> floatTexture(const std::string&) override {
    return std::make_shared<Probe<float>>(*this);
  }
  std::shared_ptr<const Texture<Spectrum>> spectrumTexture(const std::string&) override {
    return std::make_shared<Probe<Spectrum>>(*this);
  }
  std::shared_ptr<const Material> material(const std::string& name) override {
    throw Error("there is no material " + name);
  }

 private:
  template <class T>
  class Probe final : public Texture<T> {
   public:
    explicit Probe(Probes& of) : of_(of) {}
    T evaluate(const SurfaceInteraction&) const override {
      of_.asked_ = true;
      return T(of_.value_);
    }
    bool filters() const override { return true; }

   private:
    Probes& of_;
  };

  float value_;
  bool asked_ = false;
};

// Calls check(name, object, probes) for every parameter that may be a texture, of an object whose
// parameter of this name is one of this value, if the object can be made so.
template <class Interface, class Check>
void forEveryTextureIn(const Subject& subject, float value, Check check) {
  for (const Declaration& d : Declared(subject)) {
    if (!d.type.ends_with("texture")) continue;
    Probes probes(value);
    const ParamList probe = {
        {ParamType::texture, d.name, {}, {}, std::vector<std::string>{"probe"}}};
    Params params(subject.plugin->name, {}, {&probe, &subject.params}, &probes);
    std::unique_ptr<Interface> object;
    try {
      object = create<Interface>(*subject.plugin, params, {});
    } catch (const Error&) {
      continue;  // it does not go with the other parameters
    }
    check(d.name, *object, probes);
  }
}

}  // namespace pbrt::laws
