#include "core/plugin/mapping_params.h"
#include "core/plugin/plugin.h"

namespace pbrt {

template <class T>
class Bilerp final : public Texture<T> {
 public:
  Bilerp(Params& p, const typename Texture<T>::Setup& setup)
      : mapping_(readMapping(p, setup.placement, setup.world)) {
    const auto corner = [&](const char* name, float fallback, const char* where) {
      if constexpr (std::is_same_v<T, float>)
        return p.number(name, fallback, where);
      else
        return p.spectrum(name, Spectrum(fallback), where);
    };
    v00_ = corner("v00", 0, "value at (0, 0)");
    v01_ = corner("v01", 1, "value at (0, 1)");
    v10_ = corner("v10", 0, "value at (1, 0)");
    v11_ = corner("v11", 1, "value at (1, 1)");
  }

  T evaluate(const SurfaceInteraction& at) const override {
    // It goes on beyond the square, as far as the product of both coordinates is finite.
    const Point2 st = glm::clamp(mapping_(at).st, -1e15F, 1e15F);
    return (1 - st.x) * ((1 - st.y) * v00_ + st.y * v01_) +
           st.x * ((1 - st.y) * v10_ + st.y * v11_);
  }

 private:
  Mapping2D mapping_;
  T v00_{}, v01_{}, v10_{}, v11_{};
};

}  // namespace pbrt

PBRT_TEXTURE_PLUGIN(pbrt::Bilerp, "bilerp", "a blend of four values at the corners of a square")
