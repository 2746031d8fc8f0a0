// Laws of lights that compare samples with integrals over all directions.

#include "chi_square.h"
#include "lamp.h"
#include "mean.h"
#include "show.h"

namespace pbrt::laws {
namespace {

// Whether cells of this solid angle are fine enough for the density seen from p. A sun is not
// found by a grid.
bool resolves(const Lamp& light, const Point3& p, double cell) {
  Rng rng(11);
  for (int i = 0; i < 1000; ++i)
    if (light->sample(p, {rng.uniform(), rng.uniform()}).pdf * cell > 0.01) return false;
  return true;
}
constexpr const char* kTooNarrow = "its light comes from directions too narrow for a grid";

// Pearson's test over boxes of equal solid angle: samples go where the density says. Of an area
// light those that face away give no sample, which is a box of its own.
void directionsFollowTheDensity(const Subject& subject, Judge& judge) {
  const Lamp light(subject);
  if (light->isDelta()) return judge.skip("a delta light has no density");
  for (const Point3 p : {Point3(0.3F, -0.4F, 1), Point3(-4, 3, 2)}) {
    constexpr int n = 16, fine = 60, samples = 100000, side = n * fine;
    constexpr double cell = 4 * std::numbers::pi / (side * side);
    if (!resolves(light, p, cell)) return judge.skip(kTooNarrow);
    std::vector<double> expected(n * n + 1), counts(n * n + 1);
    const auto box = [](const Vec3& w) {
      const double phi = std::atan2(w.y, w.x) / (2 * std::numbers::pi);
      const int i = std::clamp(static_cast<int>((1 - w.z) / 2 * n), 0, n - 1);
      const int j = std::clamp(static_cast<int>((phi < 0 ? phi + 1 : phi) * n), 0, n - 1);
      return i * n + j;
    };
    double total = 0;
    for (int i = 0; i < side; ++i)
      for (int j = 0; j < side; ++j) {
        const Vec3 w = uniformSphere({(i + 0.5F) / side, (j + 0.5F) / side});
        const double share = light.pdf(p, w) * cell;
        expected[box(w)] += share * samples;
        total += share;
      }
    judge.expect(std::abs(total - 1) <= 5e-3,
                 "the density seen from {} integrates to {} over all directions, not 1", show(p),
                 total);
    Rng rng(3);
    for (int i = 0; i < samples; ++i) {
      const LightSample s = light->sample(p, {rng.uniform(), rng.uniform()});
      ++counts[s.pdf > 0 ? box(s.wi) : n * n];
    }
    std::vector<double> drawn, wanted;
    for (int c = 0; c < n * n; ++c)
      if (expected[c] > 50) {
        drawn.push_back(counts[c]);
        wanted.push_back(expected[c]);
      }
    // The integral over a box is itself not exact to more than about 1 %.
    const double deviation = chiSquareDeviation(drawn, wanted);
    judge.expect(deviation < 5,
                 "seen from {}, the directions of {} samples are not distributed as the density "
                 "says: chi-square is {:.1f} standard deviations off",
                 show(p), samples, deviation);
  }
}

// What arrives at a surface element: by samples of the light, and by directions all around.
void irradianceIsThatOfTheRadiance(const Subject& subject, Judge& judge) {
  const Lamp light(subject);
  if (light->isDelta()) return judge.skip("a delta light has no radiance");
  for (const Point3 p : {Point3(0.3F, -0.4F, 1), Point3(-1, 2, 3)}) {
    constexpr int side = 700;
    if (!resolves(light, p, std::numbers::pi / (side * side))) return judge.skip(kTooNarrow);
    const Normal3 n = glm::normalize(Vec3(0.3F, 0.2F, 0) - p);
    double expected = 0;
    const Frame frame = Frame::fromZ(n);
    for (int i = 0; i < side; ++i)
      for (int j = 0; j < side; ++j) {
        const Vec3 w = frame.fromLocal(cosHemisphere({(i + 0.5F) / side, (j + 0.5F) / side}));
        expected += luminance(light.radiance(p, w)) * std::numbers::pi / (side * side);
      }
    Mean E;
    Rng rng(4);
    for (int i = 0; i < 50000; ++i) {
      const LightSample s = light->sample(p, {rng.uniform(), rng.uniform()});
      E.add(s.pdf > 0 ? double{luminance(s.L)} * std::max(0.F, glm::dot(s.wi, n)) / s.pdf : 0);
    }
    judge.expect(
        std::abs(E.mean() - expected) <= 4.5 * E.error() + 3e-3 * expected,
        "a surface at {} that faces {} receives {} by samples, but {} by the radiance from "
        "all directions",
        show(p), show(n), E.mean(), expected);
  }
}

// The flux of a finite light passes through any sphere about it; that of an infinite one into a
// ball is pi r^2 times the integral of its radiance.
void powerIsTheIntegralOfEmission(const Subject& subject, Judge& judge) {
  const Lamp light(subject);
  const LightBounds bounds = light->bounds();
  const bool finite = !bounds.box.empty();
  const double radius = finite ? std::max(6.0, 2.0 * glm::length(bounds.box.diagonal())) : 6;
  Mean flux;
  Rng rng(5);
  for (int i = 0; i < 200000; ++i) {
    const auto [w, pdf] = light.direction(rng);
    // About a point the spheres may have any radius.
    const double r = light.isPoint() ? radius * (0.1 + rng.uniform()) : radius;
    const Point3 p = light.centre() + static_cast<float>(r) * w;
    const LightSample s = light->sample(p, {rng.uniform(), rng.uniform()});
    const double L = s.pdf > 0 ? double{luminance(s.L)} / s.pdf : 0;
    flux.add(finite ? L * std::abs(glm::dot(s.wi, w)) * sqr(r) / pdf
                    : L * std::numbers::pi * sqr(radius));
  }
  const double power = light->power(radius);
  judge.expect(std::abs(flux.mean() - power) <= 4.5 * flux.error() + 5e-3 * flux.mean(),
               "power({}) is {}, but its samples carry {} +- {:.1g} {}", radius, power, flux.mean(),
               flux.error(), finite ? "out of it" : "into a ball of that radius");
}

constexpr std::array<Law, 3> kLaws = {{
    {"directions-follow-the-density", "the directions of sample() are distributed as pdf() says",
     directionsFollowTheDensity},
    {"irradiance-is-that-of-the-radiance",
     "samples carry as much light as the radiance from all directions",
     irradianceIsThatOfTheRadiance},
    {"power-is-the-integral-of-emission", "power() is what samples carry out of the light",
     powerIsTheIntegralOfEmission},
}};

}  // namespace

std::span<const Law> lightIntegralLaws() {
  return kLaws;
}

}  // namespace pbrt::laws
