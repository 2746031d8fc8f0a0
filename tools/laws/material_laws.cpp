// The laws of every material: what its bsdf is worth. Those of its samples are in
// material_sample_laws.cpp.

#include "core/base/warp.h"
#include "laws.h"
#include "probe.h"
#include "scattering.h"
#include "show.h"
#include "steady.h"

namespace pbrt::laws {
namespace {

bool near(const Spectrum& a, const Spectrum& b, float relative) {
  for (int c = 0; c < 3; ++c)
    if (!(std::abs(a[c] - b[c]) <= relative * std::abs(a[c]) + 1e-9F)) return false;
  return true;
}

void reflectionIsReciprocal(const Subject& subject, Judge& judge) {
  const Scattering bsdf(subject);
  Rng rng(2);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 a = uniformSphere({rng.uniform(), rng.uniform()});
    Vec3 b = uniformSphere({rng.uniform(), rng.uniform()});
    if (a.z * b.z < 0) b.z = -b.z;
    const Spectrum f = bsdf->f(a, b), g = bsdf->f(b, a);
    judge.expect(near(f, g, 1e-3F), "f(wo {}, wi {}) is {}, but the other way round {}", show(a),
                 show(b), show(f), show(g));
  }
}

// Radiance is denser by the square of the index in the denser medium.
void transmissionIsReciprocal(const Subject& subject, Judge& judge) {
  const Scattering bsdf(subject);
  int kinds = 0;
  for (const std::uint8_t kind : {kDiffuse, kGlossy}) {
    const std::uint8_t lobe = kTransmission | kind;
    if (bsdf->lobes(lobe) == 0) continue;
    ++kinds;
    Rng rng(2);
    int lit = 0;
    constexpr int n = 2000;
    for (int i = 0; i < n; ++i) {
      const Vec3 a = uniformSphere({rng.uniform(), rng.uniform()});
      const auto s = bsdf->sample(a, {rng.uniform(), rng.uniform()}, lobe);
      if (!s) continue;
      ++lit;
      judge.expect(a.z * s->wi.z < 0, "a transmitted sample for wo {} goes to {}, the same side",
                   show(a), show(s->wi));
      const Spectrum f = bsdf->f(a, s->wi, lobe), g = bsdf->f(s->wi, a, lobe) / sqr(s->eta);
      // Sharp highlights magnify the rounding of directions.
      const float tolerance = std::min(0.03F, 2e-3F + 1e-6F * s->pdf);
      judge.expect(near(f, g, tolerance),
                   "f(wo {}, wi {}) is {}, but the other way round {}, over eta^2 ({})", show(a),
                   show(s->wi), show(f), show(g), s->eta);
    }
    judge.expect(lit > n / 4, "of {} calls of sample() for its transmission only {} give one", n,
                 lit);
  }
  if (kinds == 0) judge.skip("it lets no light through, but as glass does");
}

void noEnergyIsMade(const Subject& subject, Judge& judge) {
  const Scattering bsdf(subject);
  for (const double angle : {0, 30, 70, 88, 110, 150}) {
    const Mean share = albedo(*bsdf, direction(angle), 12000);
    judge.expect(share.mean() <= subject.traits.albedo * 1.005 + 4.5 * share.error(),
                 "of light from {} degrees to the normal it scatters {:.4f} +- {:.1g}; at most {} "
                 "may come back",
                 angle, share.mean(), share.error(), subject.traits.albedo);
    judge.expect(share.mean() >= 0, "of light from {} degrees it scatters {:.4f}, below 0", angle,
                 share.mean());
  }
}

bool isSound(const Spectrum& f) {
  return isFinite(f) && f.x >= 0 && f.y >= 0 && f.z >= 0;
}

void expectSound(const Bsdf& bsdf, const Vec3& wo, const Vec3& wi, std::string_view where,
                 Judge& judge) {
  const Spectrum f = bsdf.f(wo, wi);
  const float pdf = bsdf.pdf(wo, wi);
  judge.expect(isSound(f), "f(wo {}, wi {}){} is {}", show(wo), show(wi), where, show(f));
  judge.expect(std::isfinite(pdf) && pdf >= 0, "pdf(wo {}, wi {}){} is {}", show(wo), show(wi),
               where, pdf);
}

void expectSoundSample(const Bsdf& bsdf, const Vec3& wo, Point2 u, std::string_view where,
                       Judge& judge) {
  if (const auto s = bsdf.sample(wo, u))
    judge.expect(isSound(s->f) && std::isfinite(s->pdf) && s->pdf > 0 &&
                     std::abs(glm::length(s->wi) - 1) < 1e-5F,
                 "sample(wo {}, u {}){} gives f {}, wi {}, pdf {}", show(wo), show(u), where,
                 show(s->f), show(s->wi), s->pdf);
}

void extremesAreFinite(const Subject& subject, Judge& judge) {
  const Scattering bsdf(subject);
  std::vector<Vec3> extremes = {{0, 0, 1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}};
  for (const float z : {1e-3F, 1e-7F, 1e-20F, 1e-38F, 0.3F})
    for (const float x : {-1.F, 1.F}) extremes.push_back({x * std::sqrt(1 - z * z), 0, z});
  for (std::size_t i = 0, n = extremes.size(); i < n; ++i) extremes.push_back(-extremes[i]);
  for (const Vec3& wo : extremes) {
    for (const Vec3& wi : extremes) expectSound(*bsdf, wo, wi, "", judge);
    for (const Point2 u : {Point2(0), Point2(0, kOneMinusEpsilon), Point2(kOneMinusEpsilon, 0),
                           Point2(0.5F), Point2(kOneMinusEpsilon)})
      expectSoundSample(*bsdf, wo, u, "", judge);
  }
}

// A texture may have any value: what is no reflectance, roughness or index must be brought to one.
void texturesMayHaveAnyValue(const Subject& subject, Judge& judge) {
  bool any = false;
  for (const float value : {-1.F, 0.F, 1e-20F, 1.F, 1e6F})
    forEveryTextureIn<Material>(
        subject, value, [&](const std::string& name, const Material& material, const Probes&) {
          any = true;
          const Scattering bsdf(material);
          const std::string where = fmt::format(" with a texture \"{}\" of {}", name, value);
          Rng rng(12);
          for (int i = 0; i < 50; ++i) {
            const Vec3 a = uniformSphere({rng.uniform(), rng.uniform()});
            expectSound(*bsdf, a, uniformSphere({rng.uniform(), rng.uniform()}), where, judge);
            expectSoundSample(*bsdf, a, {rng.uniform(), rng.uniform()}, where, judge);
          }
        });
  if (!any) judge.skip("no parameter may be a texture");
}

// Rays carry no footprint where nothing says that it filters.
void filteringIsSaid(const Subject& subject, Judge& judge) {
  forEveryTextureIn<Material>(
      subject, 0.5F, [&](const std::string& name, const Material& material, const Probes& probes) {
        const Scattering bsdf(material);
        const Textured<float>* bump = material.bumpMap();
        judge.expect(
            material.filters() || !(probes.asked() || (bump && bump->filters())),
            "it looks into the texture \"{}\", which filters, but filters() is false: rays have no "
            "footprint then",
            name);
      });
  const auto material = subject.make<Material>();
  if (material->filters()) return;
  SurfaceInteraction wide = flatSurface();
  wide.dpdx = {1, 2, 3};
  wide.dpdy = {3, 2, 1};
  wide.dudx = wide.dvdx = wide.dudy = wide.dvdy = 5;
  const Scattering with(*material, wide), without(*material);
  Rng rng(13);
  for (int i = 0; i < 200; ++i) {
    const Vec3 a = uniformSphere({rng.uniform(), rng.uniform()}),
               b = uniformSphere({rng.uniform(), rng.uniform()});
    judge.expect(with->f(a, b) == without->f(a, b),
                 "f(wo {}, wi {}) depends on the footprint, but filters() is false", show(a),
                 show(b));
  }
}

void lobesAreFew(const Subject& subject, Judge& judge) {
  const auto material = subject.make<Material>();
  const Scattering bsdf(*material);
  const int most = Bsdf::kMaxLobes / (material->mixes() > 0 ? 1 : 4);
  judge.expect(bsdf->count() <= most, "it adds {} lobes; a mix of mixes has room for {} of each",
               bsdf->count(), most);
}

// Each question is a surface, and all that a bsdf can tell of two directions there.
struct MaterialQuestions {
  explicit MaterialQuestions(const Subject& subject) : material(subject.make<Material>()) {
    Rng rng(14);
    const auto direction = [&] { return uniformSphere({rng.uniform(), rng.uniform()}); };
    for (int i = 0; i < count; ++i) {
      SurfaceInteraction at = flatSurface();
      at.p = direction();
      at.uv = {rng.uniform(), rng.uniform()};
      at.tangent = at.dpdu = direction();
      asked.push_back({at, direction(), direction(), {rng.uniform(), rng.uniform()}});
    }
  }

  static constexpr std::array<std::string_view, 14> names = {
      "the number of lobes", "f(wo, wi).x",        "f(wo, wi).y",        "f(wo, wi).z",
      "pdf(wo, wi)",         "sample(wo, u).f.x",  "sample(wo, u).f.y",  "sample(wo, u).f.z",
      "sample(wo, u).wi.x",  "sample(wo, u).wi.y", "sample(wo, u).wi.z", "sample(wo, u).pdf",
      "sample(wo, u).flags", "sample(wo, u).eta"};
  std::array<float, 14> ask(int i) const {
    const auto& [at, wo, wi, u] = asked[i];
    alignas(std::max_align_t) std::array<std::byte, 16384> memory;
    Scratch scratch(memory.data(), memory.size());
    Bsdf bsdf(at);
    material->scatter(at, bsdf, scratch);
    const Spectrum f = bsdf.f(wo, wi);
    const BsdfSample s = bsdf.sample(wo, u).value_or(BsdfSample{});
    return {static_cast<float>(bsdf.count()),
            f.x,
            f.y,
            f.z,
            bsdf.pdf(wo, wi),
            s.f.x,
            s.f.y,
            s.f.z,
            s.wi.x,
            s.wi.y,
            s.wi.z,
            s.pdf,
            static_cast<float>(s.flags),
            s.eta};
  }
  std::string about(int i) const {
    const auto& [at, wo, wi, u] = asked[i];
    return fmt::format("wo {}, wi {}, u {}, at p {}, uv {}", show(wo), show(wi), show(u),
                       show(at.p), show(at.uv));
  }

  struct Question {
    SurfaceInteraction at;
    Vec3 wo{}, wi{};
    Point2 u{};
  };
  std::unique_ptr<Material> material;
  std::vector<Question> asked;
  static constexpr int count = 1000;
};

}  // namespace

std::span<const Law> materialLaws() {
  static const std::vector<Law> all = [] {
    std::vector<Law> laws = {
        {"reflection-is-reciprocal", "f() is the same with its two directions exchanged",
         reflectionIsReciprocal},
        {"transmission-is-reciprocal",
         "so it is from the other side, but for the square of the index", transmissionIsReciprocal},
        {"no-energy-is-made", "no more light is scattered than comes in", noEnergyIsMade},
        {"extremes-are-finite",
         "values are finite, and not below 0, at grazing angles and the "
         "ends of u",
         extremesAreFinite},
        {"textures-may-have-any-value", "so they are whatever value a texture has",
         texturesMayHaveAnyValue},
        {"filtering-is-said", "filters() tells if a texture in use filters", filteringIsSaid},
        {"lobes-are-few", "a bsdf has room for the lobes", lobesAreFew},
    };
    const auto samples = materialSampleLaws();
    laws.insert(laws.end(), samples.begin(), samples.end());
    laws.insert(laws.end(), Steady<MaterialQuestions>::laws.begin(),
                Steady<MaterialQuestions>::laws.end());
    return laws;
  }();
  return all;
}

}  // namespace pbrt::laws
