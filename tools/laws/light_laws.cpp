// The laws of every light: its samples, its bounds, and what finds it by chance. Those that need
// an integral are in light_integral_laws.cpp.

#include "awry.h"
#include "lamp.h"
#include "laws.h"
#include "show.h"
#include "steady.h"
#include "tally.h"

namespace pbrt::laws {
namespace {

constexpr int kPlaces = 2000;

bool isLight(const Spectrum& L) {
  return isFinite(L) && L.x >= 0 && L.y >= 0 && L.z >= 0;
}

// What is wrong with a sample; empty if nothing is.
std::string complaint(const Light& light, const Point3& p, const LightSample& s) {
  if (!(std::isfinite(s.pdf) && s.pdf >= 0)) return fmt::format("pdf is {}", s.pdf);
  if (s.pdf == 0) return "";
  if (light.isDelta() && s.pdf != 1)
    return fmt::format("pdf is {}, but of a delta light it is 1", s.pdf);
  if (!isLight(s.L)) return fmt::format("L is {}", show(s.L));
  if (!(std::abs(glm::length(s.wi) - 1) < 1e-5F))
    return fmt::format("wi is {}, of length {}, not 1", show(s.wi), glm::length(s.wi));
  if (!(std::isfinite(s.error) && s.error >= 0)) return fmt::format("error is {}", s.error);
  if (s.finite == light.bounds().box.empty())
    return fmt::format("finite is {}, but the box of bounds() is {}empty", s.finite,
                       s.finite ? "" : "not ");
  const float distance = glm::length(s.p - p);
  const float rounding = 4 * std::numeric_limits<float>::epsilon() * glm::length(s.p) / distance;
  if (s.finite && distance > 0 && !(glm::length((s.p - p) / distance - s.wi) < 1e-5F + rounding))
    return fmt::format("p is {}, which is not where wi {} points", show(s.p), show(s.wi));
  return "";
}

void expectSound(const Lamp& light, const Point3& p, Point2 u, Judge& judge) {
  const std::string wrong = complaint(*light.operator->(), p, light->sample(p, u));
  judge.expect(wrong.empty(), "sample(p {}, u {}): {}", show(p), show(u), wrong);
}

void samplesAreSound(const Subject& subject, Judge& judge) {
  const Lamp light(subject);
  judge.expect(light->samples() >= 1, "samples() is {}", light->samples());
  Rng rng(1);
  int lit = 0;
  for (int i = 0; i < kPlaces; ++i) {
    const Point3 p = light.place(rng);
    const Point2 u{rng.uniform(), rng.uniform()};
    expectSound(light, p, u, judge);
    lit += light->sample(p, u).pdf > 0;
  }
  judge.expect(lit > kPlaces / 100, "of {} places about the light only {} are lit (pdf > 0)",
               kPlaces, lit);
}

void extremesAreSound(const Subject& subject, Judge& judge) {
  const Lamp light(subject);
  const auto corners = {0.F, 0x1p-24F, 0.5F, kOneMinusEpsilon};
  Rng rng(7);
  std::vector<Point3> places = {light.centre(), Point3(0)};
  // From beside the light to where the square of the distance is near the largest float.
  for (const float size : {1e-7F, 1e-5F, 1e-2F, 1e2F, 1e6F, 1e12F, 1e18F})
    for (int i = 0; i < 20; ++i) places.push_back(light.centre() + size * light.direction(rng).w);
  for (const Point3& p : places)
    for (const float u : corners)
      for (const float v : corners) expectSound(light, p, {u, v}, judge);
  for (int i = 0; i < 200; ++i) {
    Vec3 w = uniformSphere({rng.uniform(), rng.uniform()});
    if (i < 6) w = (i < 3 ? 1.F : -1.F) * Vec3(i % 3 == 0, i % 3 == 1, i % 3 == 2);
    const Spectrum escaped = light->escaped(w);
    const float pdf = light->pdfEscaped(w);
    judge.expect(isLight(escaped), "escaped({}) is {}", show(w), show(escaped));
    judge.expect(std::isfinite(pdf) && pdf >= 0, "pdfEscaped({}) is {}", show(w), pdf);
  }
}

// Who finds the light by chance must agree with who samples it.
void strategiesAgree(const Subject& subject, Judge& judge) {
  const Lamp light(subject);
  if (light->isDelta()) return judge.skip("a delta light is not found by chance");
  Rng rng(2);
  for (int i = 0; i < kPlaces; ++i) {
    const Point3 p = light.place(rng);
    const LightSample s = light->sample(p, {rng.uniform(), rng.uniform()});
    if (s.pdf == 0) continue;
    SurfaceInteraction on;
    on.p = s.p;
    on.n = s.n;
    const bool infinite = light->isInfinite();
    const float pdf = infinite ? light->pdfEscaped(s.wi) : light->pdf(p, on);
    judge.expect(std::abs(pdf - s.pdf) <= 0.01F * s.pdf,
                 "sample(p {}) goes along {} with pdf {}, but {} says {}", show(p), show(s.wi),
                 s.pdf, infinite ? "pdfEscaped()" : "pdf()", pdf);
    const Spectrum L = infinite ? light->escaped(s.wi) : light->emitted(s.p, s.n, -s.wi);
    bool same = true;
    for (int c = 0; c < 3; ++c) same &= std::abs(L[c] - s.L[c]) <= (infinite ? 0.01F : 0) * s.L[c];
    judge.expect(same, "sample(p {}) goes along {} with L {}, but {} says {}", show(p), show(s.wi),
                 show(s.L), infinite ? "escaped()" : "emitted()", show(L));
    // A hair inside the edge, which rounding may miss.
    judge.expect(infinite || light->mayHit(p, glm::mix(s.p, Point3(0), 1e-4F) - p),
                 "sample(p {}) reaches {}, but mayHit() says that no ray from there does", show(p),
                 show(s.p));
  }
}

void deltaLightsAreNotFound(const Subject& subject, Judge& judge) {
  const Lamp light(subject);
  if (!light->isDelta()) return judge.skip("it is no delta light");
  judge.expect(!light->isInfinite(), "isInfinite() says that rays find it, isDelta() that none do");
  Rng rng(8);
  for (int i = 0; i < kPlaces; ++i) {
    const Point3 p = light.place(rng);
    const Vec3 w = i % 2 == 0 ? light.centre() - p : uniformSphere({rng.uniform(), rng.uniform()});
    judge.expect(!light->mayHit(p, w), "mayHit(p {}, w {}) is true", show(p), show(w));
    judge.expect(isBlack(light->escaped(w)), "escaped({}) is {}, not black", show(w),
                 show(light->escaped(w)));
  }
}

// A light that forgets Setup::toRender, or puts it where it does not belong. Edges of pictures and
// cones may fall on either side by rounding.
void movesWithItsSpace(const Subject& subject, Judge& judge) {
  const Transform T = awry();
  const Lamp light(subject, {}), moved(subject, T);
  const bool infinite = light->isInfinite(), far = light->bounds().box.empty();
  if (!infinite && !(light->isDelta() && (far || light.isPoint())))
    return judge.skip("it shines from a surface, which the scene has moved");
  Rng rng(11);
  Tally tally;
  const auto near = [](const Spectrum& a, const Spectrum& b) {
    return glm::length(a - b) <= 0.01F * std::max(glm::length(a), glm::length(b));
  };
  for (int i = 0; i < kPlaces; ++i) {
    if (infinite) {
      const Vec3 w = uniformSphere({rng.uniform(), rng.uniform()});
      const Vec3 there = glm::normalize(T.vector(DVec3(w)));
      const Spectrum L = light->escaped(w), real = moved->escaped(there);
      tally.expect(near(L, real), "escaped({}) is {}, but turned by toRender to {} it is {}",
                   show(w), show(L), show(there), show(real));
      continue;
    }
    const Point3 p = light.place(rng), there = T.point(DPoint3(p));
    const Point2 u{rng.uniform(), rng.uniform()};
    const LightSample s = light->sample(p, u), real = moved->sample(there, u);
    const bool lit = s.pdf > 0;
    const Vec3 wi = T.vector(DVec3(s.wi));
    tally.expect(
        lit == (real.pdf > 0) && (!lit || (near(s.L, real.L) && glm::length(wi - real.wi) < 1e-4F)),
        "toRender takes the sample of p {} to wi {} with L {} (pdf {}), but of the light "
        "made with it that of p {} is wi {} with L {} (pdf {})",
        show(p), show(wi), show(s.L), s.pdf, show(there), show(real.wi), show(real.L), real.pdf);
  }
  tally.judge(judge, kPlaces / 100);
}

// Light comes from within the box, and only into directions that the bounds allow.
void boundsHold(const Subject& subject, Judge& judge) {
  const Lamp light(subject);
  const LightBounds b = light->bounds();
  const double power = light->power(1);
  judge.expect(std::isfinite(power) && power >= 0, "power(1) is {}", power);
  // The mean over all directions of a finite light's intensity is power / (4 pi). That over all
  // surfaces of the irradiance by an infinite one is a quarter of the integral of its radiance,
  // whose power into the unit ball is pi times that integral: power / (4 pi) as well.
  const double mean = power / (4 * std::numbers::pi);
  judge.expect(std::isfinite(b.intensity) && b.intensity >= 0.98 * mean,
               "bounds() has the intensity {}, but power() means {} over all directions",
               b.intensity, mean);
  if (b.box.empty()) return;
  const auto isCosine = [](float x) { return x >= -1 && x <= 1; };
  judge.expect(isFinite(b.box.lo) && isFinite(b.box.hi), "the box of bounds() is from {} to {}",
               show(b.box.lo), show(b.box.hi));
  if (!judge.expect(std::abs(glm::length(b.normals.axis) - 1) < 1e-5F &&
                        isCosine(b.normals.cosine) && isCosine(b.cosEmission),
                    "bounds() has normals about {} (unit?) with cosine {}, and cosEmission {}",
                    show(b.normals.axis), b.normals.cosine, b.cosEmission))
    return;
  Rng rng(6);
  const double reach = std::acos(b.normals.cosine) + std::acos(b.cosEmission) + 1e-3;
  for (int i = 0; i < 5000; ++i) {
    const Point3 p = light.place(rng);
    const LightSample s = light->sample(p, {rng.uniform(), rng.uniform()});
    if (!(s.pdf > 0) || isBlack(s.L)) continue;
    const Bounds3 wider{b.box.lo - 1e-5F, b.box.hi + 1e-5F};
    judge.expect(wider.contains(s.p), "sample(p {}) comes from {}, outside of the box {} to {}",
                 show(p), show(s.p), show(b.box.lo), show(b.box.hi));
    float cosine = -glm::dot(s.wi, b.normals.axis);
    if (b.twoSided) cosine = std::abs(cosine);
    const double angle = std::acos(std::clamp(cosine, -1.F, 1.F));
    judge.expect(angle <= reach,
                 "p {} is lit along {}, {} radians from the axis {}; bounds() allows {}", show(p),
                 show(-s.wi), angle, show(b.normals.axis), reach);
  }
}

// Only AreaLightSource gives a surface: a light that needs one must say so.
void missingSurfaceIsSaid(const Subject& subject, Judge& judge) {
  std::unique_ptr<Light> light;
  try {
    light = withoutSurface(subject);
  } catch (const Error&) {
    return judge.skip("it is an area light, and refuses to be made without a surface");
  }
  judge.expect(!(light->sample({1, 2, 3}, {0.5F, 0.5F}).pdf < 0), "pdf is below 0");
}

// Each question asks for all that a light can tell of a place and a direction.
struct LightQuestions {
  explicit LightQuestions(const Subject& subject) : light(subject) {
    Rng rng(10);
    for (int i = 0; i < count; ++i)
      asked.push_back({light.place(rng),
                       {rng.uniform(), rng.uniform()},
                       uniformSphere({rng.uniform(), rng.uniform()})});
  }

  static constexpr std::array<std::string_view, 19> names = {
      "sample(p, u).L.x",  "sample(p, u).L.y",  "sample(p, u).L.z", "sample(p, u).wi.x",
      "sample(p, u).wi.y", "sample(p, u).wi.z", "sample(p, u).p.x", "sample(p, u).p.y",
      "sample(p, u).p.z",  "sample(p, u).pdf",  "pdf(p)",           "mayHit(p, w)",
      "emitted(w).x",      "emitted(w).y",      "emitted(w).z",     "escaped(w).x",
      "escaped(w).y",      "escaped(w).z",      "pdfEscaped(w)"};
  std::array<float, 19> ask(int i) const {
    const auto& [p, u, w] = asked[i];
    const LightSample s = light->sample(p, u);
    SurfaceInteraction on;
    on.p = s.p;
    on.n = s.n;
    const Spectrum out = s.pdf > 0 ? light->emitted(s.p, s.n, w) : Spectrum(0);
    const Spectrum in = light->escaped(w);
    const float pdf = s.pdf > 0 ? light->pdf(p, on) : 0;
    return {s.L.x,
            s.L.y,
            s.L.z,
            s.wi.x,
            s.wi.y,
            s.wi.z,
            s.p.x,
            s.p.y,
            s.p.z,
            s.pdf,
            pdf,
            light->mayHit(p, w) ? 1.F : 0.F,
            out.x,
            out.y,
            out.z,
            in.x,
            in.y,
            in.z,
            light->pdfEscaped(w)};
  }
  std::string about(int i) const {
    const auto& [p, u, w] = asked[i];
    return fmt::format("p {}, u {}, w {}", show(p), show(u), show(w));
  }

  struct Question {
    Point3 p{};
    Point2 u{};
    Vec3 w{};
  };
  Lamp light;
  std::vector<Question> asked;
  static constexpr int count = 1000;
};

}  // namespace

std::span<const Law> lightLaws() {
  static const std::vector<Law> all = [] {
    std::vector<Law> laws = {
        {"samples-are-sound", "samples have unit directions, light and densities that are finite",
         samplesAreSound},
        {"extremes-are-sound", "so they have from very near, very far, and at the ends of u",
         extremesAreSound},
        {"strategies-agree",
         "whoever meets the light by chance finds the radiance and density of its samples",
         strategiesAgree},
        {"delta-lights-are-not-found", "no ray meets a delta light", deltaLightsAreNotFound},
        {"moves-with-its-space", "toRender takes its light wherever the light is put",
         movesWithItsSpace},
        {"bounds-hold", "bounds() holds whatever shines, and where it shines to", boundsHold},
        {"missing-surface-is-said", "an area light refuses to be made without a surface",
         missingSurfaceIsSaid},
    };
    const auto integrals = lightIntegralLaws();
    laws.insert(laws.end(), integrals.begin(), integrals.end());
    laws.insert(laws.end(), Steady<LightQuestions>::laws.begin(),
                Steady<LightQuestions>::laws.end());
    return laws;
  }();
  return all;
}

}  // namespace pbrt::laws
