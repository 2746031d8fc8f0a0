#include <array>

#include "core/api/mapping.h"
#include "core/base/noise.h"
#include "core/plugin/plugin.h"

namespace pbrt {

template <class T>
class Marble final : public Texture<T> {
 public:
  Marble(Params& p, const typename Texture<T>::Setup& setup)
      : toTexture_(setup.placement.inverse()),
        octaves_(p.integer("octaves", 8, 0, 64, "scales of noise, each twice as fine as the last")),
        roughness_(p.inRange("roughness", 0.5F, 0, 1, "strength of a scale against the last")),
        scale_(p.number("scale", 1, "multiplies the coordinates")),
        variation_(p.number("variation", 0.2F, "by how much noise bends the layers")) {
    if constexpr (std::is_same_v<T, float>)
      if (!p.describing()) throw Error("\"marble\" is a color texture, not a float one");
  }

  T evaluate(const SurfaceInteraction& at) const override {
    const SolidPoint s = solidPoint(toTexture_, at);
    const double scale = scale_;
    const double bent =
        variation_ * fbm(scale * s.p, scale * s.dx, scale * s.dy, roughness_, octaves_);
    const Spectrum c = color(static_cast<float>(0.5 + 0.5 * std::sin(scale * s.p.y + bent)));
    if constexpr (std::is_same_v<T, float>)
      return luminance(c);
    else
      return c;
  }
  bool filters() const override { return true; }

 private:
  // Through the colours of pbrt's marble for t from 0 to 1: six Bezier segments, of which each
  // begins one control point after the last, by de Casteljau's algorithm; then brightened by half.
  static Spectrum color(float t) {
    static constexpr std::array<float, 27> points = {
        .58F, .58F, .6F,  .58F, .58F, .6F,  .58F, .58F, .6F, .5F,  .5F,  .5F,  .6F, .59F,
        .58F, .58F, .58F, .6F,  .58F, .58F, .6F,  .2F,  .2F, .33F, .58F, .58F, .6F};
    constexpr int segments = 6;
    const int first = std::min(static_cast<int>(t * segments), segments - 1);
    const float u = t * segments - static_cast<float>(first);
    std::array<Spectrum, 4> c;
    for (int i = 0; i < 4; ++i)
      for (int k = 0; k < 3; ++k) c[i][k] = points[3 * (first + i) + k];
    for (int n = 3; n > 0; --n)
      for (int i = 0; i < n; ++i) c[i] = (1 - u) * c[i] + u * c[i + 1];
    return 1.5F * c[0];
  }

  Transform toTexture_;
  int octaves_;
  float roughness_, scale_, variation_;
};

}  // namespace pbrt

PBRT_TEXTURE_PLUGIN(pbrt::Marble, "marble", "layers of stone, bent by noise")
