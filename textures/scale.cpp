#include "core/plugin/plugin.h"

namespace pbrt {

template <class T>
class ScaleTexture final : public Texture<T> {
 public:
  explicit ScaleTexture(Params& p)
      : tex1_(p.texture<T>("tex1", 1, "one factor")),
        tex2_(p.texture<T>("tex2", 1, "the other factor")),
        tex_(p.texture<T>("tex", 1, "a factor, under its name in pbrt-v4")),
        scale_(p.floatTexture("scale", 1, "a number by which the rest is multiplied")) {}

  T evaluate(const SurfaceInteraction& at) const override {
    return tex1_(at) * tex2_(at) * tex_(at) * scale_(at);
  }
  bool filters() const override {
    return tex1_.filters() || tex2_.filters() || tex_.filters() || scale_.filters();
  }

 private:
  Textured<T> tex1_, tex2_, tex_;
  Textured<float> scale_;
};

}  // namespace pbrt

PBRT_TEXTURE_PLUGIN(pbrt::ScaleTexture, "scale", "the product of two textures")
