#include "core/api/mapping.h"
#include "core/base/noise.h"
#include "core/plugin/plugin.h"

namespace pbrt {

template <class T>
class Wrinkled final : public Texture<T> {
 public:
  Wrinkled(Params& p, const typename Texture<T>::Setup& setup)
      : toTexture_(setup.placement.inverse()),
        octaves_(p.integer("octaves", 8, 0, 64, "scales of noise, each twice as fine as the last")),
        roughness_(p.inRange("roughness", 0.5F, 0, 1, "strength of a scale against the last")) {}

  T evaluate(const SurfaceInteraction& at) const override {
    const SolidPoint s = solidPoint(toTexture_, at);
    return T(turbulence(s.p, s.dx, s.dy, roughness_, octaves_));
  }
  bool filters() const override { return true; }

 private:
  Transform toTexture_;
  int octaves_;
  float roughness_;
};

}  // namespace pbrt

PBRT_TEXTURE_PLUGIN(pbrt::Wrinkled, "wrinkled",
                    "creases, as of crumpled paper or leather: noise at several scales")
