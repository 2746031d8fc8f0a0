// The laws of the samples of materials.

#include "chi_square.h"
#include "core/base/warp.h"
#include "scattering.h"
#include "show.h"

namespace pbrt::laws {
namespace {

// Cells of the sphere of equal size, over each of which a density is integrated by midpoints.
// Rows have equal heights; within one it is angles that step evenly, to be fine at the poles.
class Cells {
 public:
  static constexpr int kRows = 16, kColumns = 16, kCount = kRows * kColumns;

  // `fineness`: 1, 2, ... times as many midpoints each way.
  explicit Cells(int fineness) : fineRows_(64 * fineness), around_(kColumns * 8 * fineness) {}

  static int of(const Vec3& w) {
    return rowOf(w) * kColumns + std::min(static_cast<int>(turnOf(w) * kColumns), kColumns - 1);
  }
  // The midpoint that stands for w.
  Vec3 midpoint(const Vec3& w) const {
    const int row = rowOf(w);
    const double begin = theta(row), step = (theta(row + 1) - begin) / fineRows_;
    const double angle = std::acos(std::clamp(w.z, -1.F, 1.F));
    return middle(begin + (std::floor((angle - begin) / step) + 0.5) * step,
                  std::floor(turnOf(w) * around_));
  }

  template <class Density>
  std::vector<double> integrals(Density density) const {
    std::vector<double> cells(kCount);
    for (int i = 0; i < kRows; ++i)
      for (int k = 0; k < fineRows_; ++k) {
        const double step = (theta(i + 1) - theta(i)) / fineRows_;
        const double mid = theta(i) + (k + 0.5) * step;
        const double area = 2 * std::sin(mid) * std::sin(step / 2) * 2 * std::numbers::pi / around_;
        for (int j = 0; j < around_; ++j)
          cells[i * kColumns + j * kColumns / around_] += density(middle(mid, j)) * area;
      }
    return cells;
  }

 private:
  static double theta(double row) { return std::acos(1 - 2 * row / kRows); }
  static int rowOf(const Vec3& w) {
    return std::clamp(static_cast<int>((1 - w.z) / 2 * kRows), 0, kRows - 1);
  }
  // The angle about z over 2 pi, in [0, 1].
  static double turnOf(const Vec3& w) {
    const double turn = std::atan2(w.y, w.x) / (2 * std::numbers::pi);
    return turn < 0 ? turn + 1 : turn;
  }
  Vec3 middle(double theta, double column) const {
    const double phi = 2 * std::numbers::pi * (column + 0.5) / around_;
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
  }

  int fineRows_, around_;
};

// The first cells fine enough for a density that is the same at nearly all these directions and at
// the midpoints that stand for them; none if it is too sharp.
template <class Density>
std::optional<Cells> cellsFor(Density density, const std::vector<Vec3>& directions) {
  for (const int fineness : {1, 2, 4, 8}) {
    const Cells cells(fineness);
    const auto steep = std::ranges::count_if(directions, [&](const Vec3& w) {
      const float here = density(w), there = density(cells.midpoint(w));
      return std::abs(here - there) > 0.2F * std::max(here, there);
    });
    if (static_cast<std::size_t>(steep) * 100 <= directions.size()) return cells;
  }
  return {};
}

// The counts of sample()'s directions in cells of the sphere, and of no direction at all, are
// those that pdf() predicts.
void samplesFollowTheirDensity(const Subject& subject, Judge& judge) {
  constexpr auto wanted = static_cast<std::uint8_t>(kAllLobes & ~kSpecular);
  const Scattering bsdf(subject);
  if (bsdf->lobes(wanted) == 0) return judge.skip("all that it scatters is mirrored or refracted");
  constexpr int samples = 30000;
  bool judged = false;
  for (const double angle : {0, 70, 88, 150}) {
    const Vec3 wo = direction(angle);
    const auto density = [&](const Vec3& wi) { return bsdf->pdf(wo, wi, wanted); };
    std::vector<Vec3> directions;
    Rng rng(3);
    for (int i = 0; i < samples; ++i) {
      const Point2 u{rng.uniform(), rng.uniform()};
      if (const auto s = bsdf->sample(wo, u, wanted)) directions.push_back(s->wi);
    }
    const std::optional<Cells> cells = cellsFor(density, directions);
    if (!cells) continue;
    judged = true;
    std::vector<double> counts(Cells::kCount), expected = cells->integrals(density);
    for (const Vec3& w : directions) ++counts[Cells::of(w)];
    counts.push_back(samples - static_cast<double>(directions.size()));
    double total = 0;
    for (double& e : expected) {
      total += e;
      e *= samples;
    }
    judge.expect(total <= 1.005, "for wo {} the density integrates to {:.4f} over all directions",
                 show(wo), total);
    expected.push_back(samples * std::max(0.0, 1 - total));
    // Cells with few expected counts are put together.
    std::vector<double> e{0}, c{0};
    for (std::size_t k = 0; k < expected.size(); ++k) {
      if (expected[k] < 10) {
        e[0] += expected[k];
        c[0] += counts[k];
      } else {
        e.push_back(expected[k]);
        c.push_back(counts[k]);
      }
    }
    if (e[0] < 10) {
      judge.expect(c[0] <= 40,
                   "for wo {}, {} of {} samples go where the density expects {:.1f} of them",
                   show(wo), c[0], samples, e[0]);
      e.erase(e.begin());
      c.erase(c.begin());
    }
    const double deviation = chiSquareDeviation(c, e);
    judge.expect(deviation < 4.5,
                 "for wo {} ({} degrees) the directions of {} samples are not distributed as pdf() "
                 "says: chi-square is {:.1f} standard deviations off",
                 show(wo), angle, samples, deviation);
  }
  if (!judged) judge.skip("its highlights are too sharp for a grid of directions");
}

// What a sample says, value and density must say.
void expectAgreement(const Bsdf& bsdf, const Vec3& wo, Point2 u, std::string_view where,
                     Judge& judge) {
  const auto s = bsdf.sample(wo, u);
  if (!s) return;
  judge.expect(std::abs(glm::length(s->wi) - 1) < 1e-5F && isFinite(s->f) && s->pdf > 0 &&
                   std::isfinite(s->pdf),
               "sample(wo {}, u {}){} gives f {}, wi {}, pdf {}", show(wo), show(u), where,
               show(s->f), show(s->wi), s->pdf);
  if (s->flags & kSpecular) {
    judge.expect(s->pdf <= 1 + 1e-5F,
                 "sample(wo {}, u {}){} is specular, but its pdf, the probability of its choice, "
                 "is {}",
                 show(wo), show(u), where, s->pdf);
    return;
  }
  // Sharp highlights magnify the rounding of directions.
  const float tolerance = 0.03F + 2e-8F * s->pdf;
  const float pdf = bsdf.pdf(wo, s->wi);
  judge.expect(std::abs(pdf - s->pdf) <= tolerance * s->pdf,
               "sample(wo {}, u {}){} gives wi {} and pdf {}, but pdf() says {}", show(wo), show(u),
               where, show(s->wi), s->pdf, pdf);
  const Spectrum f = bsdf.f(wo, s->wi);
  bool same = true;
  for (int c = 0; c < 3; ++c) same &= std::abs(f[c] - s->f[c]) <= tolerance * s->f[c];
  judge.expect(same, "sample(wo {}, u {}){} gives wi {} and f {}, but f() says {}", show(wo),
               show(u), where, show(s->wi), show(s->f), show(f));
}

void samplesAgreeWithValues(const Subject& subject, Judge& judge) {
  const Scattering bsdf(subject);
  Rng rng(4);
  for (const double angle : {0, 30, 70, 88, 110, 150})
    for (int i = 0; i < 500; ++i)
      expectAgreement(*bsdf, direction(angle), {rng.uniform(), rng.uniform()}, "", judge);
}

// A shading normal up to 89 degrees from the surface's: samples and values still agree, and nothing
// leaks through.
void bentNormalsAreHandled(const Subject& subject, Judge& judge) {
  const auto material = subject.make<Material>();
  for (const double bend : {10., 60., 89.}) {
    SurfaceInteraction at = flatSurface();
    at.ns = direction(bend, 0);
    const Scattering bsdf(*material, at);
    const std::string where = fmt::format(", the shading normal bent by {} degrees,", bend);
    Rng rng(1);
    for (int i = 0; i < 3000; ++i) {
      const Vec3 wo = uniformSphere({rng.uniform(), rng.uniform()});
      expectAgreement(*bsdf, wo, {rng.uniform(), rng.uniform()}, where, judge);
      const Vec3 wi = uniformSphere({rng.uniform(), rng.uniform()});
      const bool reflected = wo.z * wi.z > 0;
      const Spectrum other =
          bsdf->f(wo, wi, kAllLobes & ~(reflected ? kReflection : kTransmission));
      judge.expect(isBlack(other), "f(wo {}, wi {}){} leaks {} through the surface", show(wo),
                   show(wi), where, show(other));
    }
  }
}

// Whatever lobes are asked for, the others' chances go to them: what they scatter adds up.
void partsAddUp(const Subject& subject, Judge& judge) {
  const Scattering bsdf(subject);
  const auto estimate = [&](const Vec3& wo, std::uint8_t wanted) {
    Mean m;
    Rng rng(wanted);
    for (int i = 0; i < 4000; ++i) {
      const auto s = bsdf->sample(wo, {rng.uniform(), rng.uniform()}, wanted);
      m.add(s ? luminance(s->f) * std::abs(s->wi.z) / s->pdf : 0);
    }
    return m;
  };
  for (const double angle : {0, 75, 140}) {
    const Vec3 wo = direction(angle);
    const Mean whole = estimate(wo, kAllLobes);
    double sum = 0, variance = whole.variance();
    for (const std::uint8_t side : {kReflection, kTransmission})
      for (const std::uint8_t kind : {kDiffuse, kGlossy, kSpecular}) {
        const std::uint8_t part = side | kind;
        if (bsdf->lobes(part) == 0) continue;
        const Mean m = estimate(wo, part);
        sum += m.mean();
        variance += m.variance();
      }
    judge.expect(std::abs(whole.mean() - sum) <= 5 * std::sqrt(variance) + 1e-3 * sum,
                 "of light from {} degrees it scatters {:.4f}, but its kinds of lobes, asked for "
                 "one by one, {:.4f} together",
                 angle, whole.mean(), sum);
  }
}

constexpr std::array<Law, 4> kLaws = {{
    {"samples-follow-their-density", "the directions of sample() are distributed as pdf() says",
     samplesFollowTheirDensity},
    {"samples-agree-with-values", "sample() tells the same value and density as f() and pdf()",
     samplesAgreeWithValues},
    {"bent-normals-are-handled", "so it does where the shading normal is not the surface's",
     bentNormalsAreHandled},
    {"parts-add-up", "the kinds of lobes, asked for one by one, scatter what they do together",
     partsAddUp},
}};

}  // namespace

std::span<const Law> materialSampleLaws() {
  return kLaws;
}

}  // namespace pbrt::laws
