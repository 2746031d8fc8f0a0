// What a shape promises as an object that many threads ask: the same answers, and no memory.

#include "shape_laws.h"
#include "shape_probe.h"
#include "steady.h"

namespace pbrt::laws {
namespace {

// Traces a ray, and chooses a point of the surface as light for where it starts.
class RayQuestions {
 public:
  explicit RayQuestions(const Subject& subject)
      : probe_(subject), area_(probe_.shape().areaSampler()) {
    for (int i = 0; i < count; ++i) rays_.push_back(probe_.ray());
  }

  static constexpr int count = 1000;

  std::array<double, 24> ask(int i) const {
    std::array<double, 24> answer{};
    auto* next = answer.data();
    const auto add = [&](auto... x) { ((*next++ = static_cast<double>(x)), ...); };
    const ObjectRay& r = rays_[i];
    if (const auto found = probe_.nearest(r)) {
      const SurfacePoint s = probe_.shape().surface(r, found->hit);
      add(found->hit.t, found->hit.u, found->hit.v, found->primitive);
      add(s.p.x, s.p.y, s.p.z, s.error, s.n.x, s.n.y, s.n.z, s.uv.x, s.uv.y, s.dpdu.x, s.dndv.y);
      add(probe_.shape().occluded(r, found->primitive));
    }
    if (area_) {
      const AreaSample s = area_->sample(r.o, {(i + 0.5F) / count, (i * 7 % count + 0.5F) / count});
      add(s.p.x, s.p.y, s.p.z, s.error, s.n.x, s.pdf, area_->pdf(r.o, s.p, s.n),
          area_->mayHit(r.o, r.d));
    }
    return answer;
  }
  std::string about(int i) const { return show(rays_[i]); }

 private:
  ShapeProbe probe_;
  const AreaSampler* area_;  // null: it cannot be sampled
  std::vector<ObjectRay> rays_;
};

using Traced = Steady<RayQuestions>;

// A law of traced shapes that makes its own objects.
template <void (*check)(const Subject&, Judge&)>
void ofTraced(const Subject& subject, Judge& judge) {
  if (ShapeProbe(subject).shape().triangles()) return judge.skip("it is handed over as triangles");
  check(subject, judge);
}

void coloursAreSound(ShapeProbe& probe, Judge& judge) {
  const SurfaceColor* colour = probe.shape().color();
  if (!colour) return judge.skip("it has no colours of its own");
  probe.forHits(
      ShapeProbe::kHits, judge, [&](const ObjectRay&, const Found& f, const SurfacePoint& s) {
        const Spectrum c = colour->at(s.p, f.primitive);
        judge.expect(isFinite(c) && std::min({c.x, c.y, c.z}) >= 0,
                     "the colour at {}, primitive {}, is {}", show(s.p), f.primitive, show(c));
      });
}

constexpr Law kLaws[] = {
    {"repeatable", "An answer does not depend on the questions before it.",
     ofTraced<Traced::repeatable>},
    {"twins", "Two objects of the same parameters give the same answers.", ofTraced<Traced::twins>},
    {"thread-safe", "Many threads at once get the same answers as one.",
     ofTraced<Traced::threadSafe>},
    {"allocates-nothing", "What rays touch asks for no memory.",
     ofTraced<Traced::allocatesNothing>},
};

constexpr Law kColourLaws[] = {
    {"colours-are-sound", "Its own colours are finite and not negative.", traced<coloursAreSound>},
};

}  // namespace

std::span<const Law> shapeObjectLaws() {
  return kLaws;
}
std::span<const Law> shapeColourLaws() {
  return kColourLaws;
}

}  // namespace pbrt::laws
