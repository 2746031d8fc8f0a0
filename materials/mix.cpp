#include "core/plugin/plugin.h"

namespace pbrt {

// Blends what two materials scatter. Their bump maps: the first one's, or else the second one's.
class Mix final : public Material {
 public:
  explicit Mix(Params& p) {
    // pbrt-v3 names them one by one and `amount` is the share of the first; in pbrt-v4 it is the
    // share of the second.
    auto first = p.materials("namedmaterial1", "the first of the two");
    const auto second = p.materials("namedmaterial2", "the second");
    const auto both = p.materials("materials", "both, as pbrt-v4 names them");
    amount_ = p.texture<Spectrum>(
        "amount", 0.5F, "share of namedmaterial1; of the second one where both are in materials");
    first.insert(first.end(), second.begin(), second.end());
    if (p.describing()) return;
    if (!both.empty() && !first.empty())
      p.fail("materials", "cannot be given together with namedmaterial1 or namedmaterial2");
    secondsShare_ = !both.empty();
    const auto& materials = both.empty() ? first : both;
    const char* name = both.empty() ? "namedmaterial1" : "materials";
    if (materials.size() != 2) p.fail(name, "must name two materials (with namedmaterial2)");
    one_ = materials[0];
    two_ = materials[1];
    if (mixes() > 2) p.fail(name, "mixes mixes of mixes: that is too deep");
  }

  void scatter(const SurfaceInteraction& at, Bsdf& bsdf, Scratch& scratch) const override {
    const Spectrum amount = glm::clamp(amount_(at), 0.F, 1.F), rest = 1.F - amount;
    const int before = bsdf.count();
    one_->scatter(at, bsdf, scratch);
    bsdf.scale(before, secondsShare_ ? rest : amount, scratch);
    const int between = bsdf.count();
    two_->scatter(at, bsdf, scratch);
    bsdf.scale(between, secondsShare_ ? amount : rest, scratch);
  }
  bool filters() const override { return amount_.filters() || one_->filters() || two_->filters(); }
  int mixes() const override { return 1 + std::max(one_->mixes(), two_->mixes()); }
  const Textured<float>* bumpMap() const override {
    return one_->bumpMap() ? one_->bumpMap() : two_->bumpMap();
  }

 private:
  std::shared_ptr<const Material> one_, two_;
  Textured<Spectrum> amount_;
  bool secondsShare_ = false;
};

}  // namespace pbrt

PBRT_PLUGIN(Material, pbrt::Mix, "mix", "a blend of two other materials")
