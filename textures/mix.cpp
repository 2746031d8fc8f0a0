#include "core/plugin/plugin.h"

namespace pbrt {

template <class T>
class Mix final : public Texture<T> {
 public:
  explicit Mix(Params& p)
      : tex1_(p.texture<T>("tex1", 0, "what there is where amount is 0")),
        tex2_(p.texture<T>("tex2", 1, "what there is where amount is 1")),
        amount_(p.floatTexture("amount", 0.5F, "share of tex2")) {}

  T evaluate(const SurfaceInteraction& at) const override {
    const float amount = amount_(at);
    if (amount == 0) return tex1_(at);
    if (amount == 1) return tex2_(at);
    return (1 - amount) * tex1_(at) + amount * tex2_(at);
  }
  bool filters() const override { return tex1_.filters() || tex2_.filters() || amount_.filters(); }

 private:
  Textured<T> tex1_, tex2_;
  Textured<float> amount_;
};

}  // namespace pbrt

PBRT_TEXTURE_PLUGIN(pbrt::Mix, "mix",
                    "a blend of two textures, in the shares that a third one gives")
