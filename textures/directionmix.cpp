#include "core/plugin/plugin.h"

namespace pbrt {

template <class T>
class DirectionMix final : public Texture<T> {
 public:
  DirectionMix(Params& p, const typename Texture<T>::Setup& setup)
      : tex1_(p.texture<T>("tex1", 0, "what there is where the surface faces dir")),
        tex2_(p.texture<T>("tex2", 1, "what there is where it is edge-on to dir")) {
    const Vec3 dir = p.vector("dir", {0, 1, 0}, "in texture space; its length does not matter");
    if (!(lengthSquared(dir) > 0)) p.fail("dir", "must not be zero");
    dir_ = glm::normalize(setup.placement.vector(DVec3(dir)));
  }

  T evaluate(const SurfaceInteraction& at) const override {
    const float amount = std::abs(glm::dot(at.n, dir_));
    return amount * tex1_(at) + (1 - amount) * tex2_(at);
  }
  bool filters() const override { return tex1_.filters() || tex2_.filters(); }

 private:
  Textured<T> tex1_, tex2_;
  Vec3 dir_{};  // unit, in render space
};

}  // namespace pbrt

PBRT_TEXTURE_PLUGIN(
    pbrt::DirectionMix, "directionmix",
    "one texture where the surface faces a direction, another where it is edge-on to it")
