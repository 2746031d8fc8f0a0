#include "core/plugin/plugin.h"

namespace pbrt {

template <class T>
class ScaleTexture final : public Texture<T> {
 public:
  explicit ScaleTexture(Params& p)
      : tex1_(p.texture<T>("tex1", 1, "one factor")),
        tex2_(p.texture<T>("tex2", 1, "the other factor")) {}

  T evaluate(const SurfaceInteraction& at) const override { return tex1_(at) * tex2_(at); }
  bool filters() const override { return tex1_.filters() || tex2_.filters(); }

 private:
  Textured<T> tex1_, tex2_;
};

}  // namespace pbrt

PBRT_TEXTURE_PLUGIN(pbrt::ScaleTexture, "scale", "the product of two textures")
