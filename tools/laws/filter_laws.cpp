// The laws of every filter.

#include <cmath>

#include "core/base/rng.h"
#include "core/scene/film.h"
#include "laws.h"
#include "parameters.h"
#include "show.h"
#include "steady.h"

namespace pbrt::laws {
namespace {

struct FilterQuestions {
  static constexpr int count = 400;

  explicit FilterQuestions(const Subject& subject) : filter(subject.make<Filter>()) {}

  Vec2 place(int i) const { return (Vec2(i % 20, i / 20) / 8.F - 1.2F) * filter->radius(); }
  std::string about(int i) const { return "the weight at " + show(place(i)); }
  std::array<float, 1> ask(int i) const { return {filter->evaluate(place(i))}; }

  std::unique_ptr<Filter> filter;
};

ParamList widths(float x, float y) {
  return {number("xwidth", x), number("ywidth", y)};
}
bool hasWidths(const Subject& subject) {
  return Declared(subject).has(widths(1, 1));
}

// The filter of each of these radii; as it is, if it cannot be told.
std::vector<std::unique_ptr<Filter>> ofRadii(const Subject& subject, std::span<const Vec2> radii) {
  std::vector<std::unique_ptr<Filter>> filters;
  if (!hasWidths(subject))
    filters.push_back(subject.make<Filter>());
  else
    for (const Vec2& r : radii) filters.push_back(with(subject, widths(r.x, r.y)).make<Filter>());
  return filters;
}

constexpr Vec2 kRadii[] = {{0.5F, 0.5F}, {2, 2}, {1.5F, 3.25F}, {4, 0.75F}};

void isEven(const Subject& subject, Judge& judge) {
  for (const auto& f : ofRadii(subject, kRadii))
    for (float x = 0; x < 1.2F; x += 0.07F)
      for (float y = 0; y < 1.2F; y += 0.07F) {
        const Vec2 p = Vec2(x, y) * f->radius();
        const float w = f->evaluate(p);
        judge.expect(std::isfinite(w), "the weight at {} is {} (radius {})", show(p), w,
                     show(f->radius()));
        for (const Vec2& q : {Vec2(-p.x, p.y), Vec2(p.x, -p.y), -p}) {
          const float mirrored = f->evaluate(q);
          judge.expect(mirrored == w, "the weight at {} is {}, but at {} it is {} (radius {})",
                       show(p), w, show(q), mirrored, show(f->radius()));
        }
      }
}

void isZeroBeyondItsRadius(const Subject& subject, Judge& judge) {
  for (const auto& f : ofRadii(subject, kRadii)) {
    const Vec2 r = f->radius();
    const Vec2 beyond(std::nextafter(r.x, kInfinity), std::nextafter(r.y, kInfinity));
    for (float t = 0; t < 2; t += 0.1F)
      for (const Vec2& p :
           {Vec2(beyond.x, t * r.y), Vec2(t * r.x, -beyond.y), Vec2((1.001F + t) * r.x, t)}) {
        const float w = f->evaluate(p);
        judge.expect(w == 0, "the weight at {}, beyond the radius {}, is {}, not 0", show(p),
                     show(r), w);
      }
  }
}

void peaksAtTheCentre(const Subject& subject, Judge& judge) {
  for (const auto& f : ofRadii(subject, kRadii)) {
    const Vec2 r = f->radius();
    const float peak = f->evaluate(Vec2(0));
    double sum = 0;
    for (int i = -100; i < 100; ++i)
      for (int j = -100; j < 100; ++j) {
        const Vec2 p = (Vec2(i, j) + 0.5F) * r / 100.F;
        const float w = f->evaluate(p);
        judge.expect(std::abs(w) <= peak, "the weight at {} is {}, at the centre only {}", show(p),
                     w, peak);
        sum += w;
      }
    judge.expect(sum > 0, "the mean of the weights over the radius {} is {}: it must be positive",
                 show(r), sum / 40000);
  }
}

void isContinuous(const Subject& subject, Judge& judge) {
  if (subject.traits.hasSteps) return judge.skip("it is known to have steps");
  constexpr Vec2 radii[] = {{2, 2}, {4, 3}};  // whole: where a sinc is zero
  for (const auto& f : ofRadii(subject, radii)) {
    const float most = 0.004F * f->evaluate(Vec2(0));
    const auto expectNear = [&](Vec2 p, Vec2 q) {
      p *= f->radius(), q *= f->radius();
      const float a = f->evaluate(p), b = f->evaluate(q);
      judge.expect(std::abs(a - b) <= most, "the weight jumps from {} at {} to {} at {}", a,
                   show(p), b, show(q));
    };
    for (int i = -2100; i < 2100; ++i) {
      const float x = static_cast<float>(i) / 2000, next = static_cast<float>(i + 1) / 2000;
      for (const float y : {0.F, 0.3F, 0.7F}) {
        expectNear({x, y}, {next, y});
        expectNear({y, x}, {y, next});
      }
    }
  }
}

// The film divides by the sum of weights: so divided, what a filter weighs is one in all. That sum
// is taken over samples, at places that the film rounds to 1/32 of the radius; were it not near the
// integral, the brightness of a detail would depend on where in the pixel it lies.
void isSmoothForTheFilm(const Subject& subject, Judge& judge) {
  constexpr Vec2 radii[] = {{0.1F, 0.1F}, {0.5F, 0.5F}, {1, 1}, {2, 2}, {4, 0.3F}, {20, 20}};
  for (const auto& f : ofRadii(subject, radii)) {
    const Vec2 r = f->radius();
    // By the midpoint rule, of 32 and of 256 cells a radius.
    const auto integral = [&](int cells) {
      double sum = 0;
      for (int i = -cells; i < cells; ++i)
        for (int j = -cells; j < cells; ++j)
          sum += f->evaluate((Vec2(i, j) + 0.5F) * r / static_cast<float>(cells));
      return sum * r.x * r.y / (double{1} * cells * cells);
    };
    const double exact = integral(256), rounded = integral(32);
    judge.expect(exact > 0, "its integral is {} (radius {})", exact, show(r));
    judge.expect(
        std::abs(rounded / exact - 1) < 0.01,
        "of radius {} its integral is {}, but {} by the film's table of 32 cells a radius: "
        "details would be brighter here and darker there",
        show(r), exact, rounded);
  }
}

void evenLightStaysEven(const Subject& subject, Judge& judge) {
  constexpr Vec2 radii[] = {{0.1F, 0.1F}, {0.5F, 0.5F}, {1.5F, 1.5F}, {20, 3}};
  for (const auto& f : ofRadii(subject, radii)) {
    const Point2i size(6, 5);
    std::optional<Film> film;
    try {
      film.emplace(size, Bounds2i{{0, 0}, size}, *f, Film::Settings());
    } catch (const Error& error) {
      judge.expect(false, "no film can be made of it: {}", error.what());
      return;
    }
    Rng rng(7);
    for (int tile = 0; tile < film->tiles(); ++tile) {
      const Bounds2i pixels = film->tilePixels(tile);
      for (int y = pixels.lo.y; y < pixels.hi.y; ++y)
        for (int x = pixels.lo.x; x < pixels.hi.x; ++x)
          for (int i = 0; i < 400; ++i)
            film->add(tile, Point2(x + rng.uniform(), y + rng.uniform()), Spectrum(0.75F), true);
    }
    const Image image = film->image();
    for (const std::size_t c : {0, 1, 2, 3})
      for (std::size_t i = 0; i < image.channels[c].size(); ++i) {
        const float expected = c == 3 ? 1 : 0.75F, v = image.channels[c][i];
        judge.expect(
            std::abs(v - expected) <= 1e-6F,
            "a film lit by {} everywhere is {} in channel {} of pixel ({}, {}) (radius {})",
            expected, v, image.names[c], i % 6, i / 6, show(f->radius()));
      }
  }
}

// Whatever else a filter is told: an error, or finite weights.
void extremesAreFiniteOrErrors(const Subject& subject, Judge& judge) {
  bool any = false;
  for (const Declaration& d : Declared(subject)) {
    if (d.type != "float" || d.name == "xwidth" || d.name == "ywidth") continue;
    any = true;
    for (const float v : {1e-30F, 1e-6F, 0.3F, 1.F, 50.F, 1e6F, 1e30F, -1e30F, -2.F, 0.F}) {
      std::unique_ptr<Filter> f;
      try {
        f = with(subject, {number(d.name, v)}).make<Filter>();
      } catch (const Error&) {
        continue;
      }
      for (float x = 0; x < 1.1F; x += 0.05F)
        for (float y = 0; y < 1.1F; y += 0.05F) {
          const Vec2 p = Vec2(x, y) * f->radius();
          const float w = f->evaluate(p);
          judge.expect(std::isfinite(w),
                       "with \"float {}\" {} the weight at {} is {}: refuse it by Params::fail",
                       d.name, v, show(p), w);
        }
    }
  }
  if (!any) judge.skip("it has no numbers but its widths");
}

void widthsArePositive(const Subject& subject, Judge& judge) {
  if (!hasWidths(subject)) return judge.skip("it declares no xwidth and ywidth");
  for (const Vec2& r : kRadii) {
    const Vec2 own = with(subject, widths(r.x, r.y)).make<Filter>()->radius();
    judge.expect(own == r, "of xwidth and ywidth {} its radius() is {}", show(r), show(own));
  }
  for (const float bad : {0.F, -1.F, std::numeric_limits<float>::quiet_NaN()})
    for (const Vec2& r : {Vec2(bad, 1), Vec2(1, bad)})
      judge.expect(!accepts<Filter>(subject, widths(r.x, r.y)),
                   "xwidth and ywidth {} are not refused by an Error", show(r));
}

constexpr std::array<Law, 8> kLaws = {{
    {"even", "evaluate(p) is finite and the same for -x and for -y", isEven},
    {"zero-beyond-radius", "evaluate(p) is 0 where p is farther off than radius(), in x or in y",
     isZeroBeyondItsRadius},
    {"peaks-at-centre", "no weight is above that at the centre, and their sum is positive",
     peaksAtTheCentre},
    {"continuous", "the weight does not jump, at the edge neither", isContinuous},
    {"smooth-for-the-film", "places rounded to 1/32 of the radius give the same integral",
     isSmoothForTheFilm},
    {"even-light-stays-even", "a film that is evenly lit gives an even picture",
     evenLightStaysEven},
    {"extremes", "extreme numbers are errors or give finite weights", extremesAreFiniteOrErrors},
    {"widths", "xwidth and ywidth are the radius, and must be positive", widthsArePositive},
}};

}  // namespace

std::span<const Law> filterLaws() {
  static const auto laws = withSteady<FilterQuestions>(kLaws);
  return laws;
}

}  // namespace pbrt::laws
