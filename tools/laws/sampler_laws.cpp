// The laws of every sampler: what it may be asked, and by whom.

#include "sampler_laws.h"

#include <set>

#include "laws.h"
#include "parameters.h"
#include "show.h"
#include "steady.h"

namespace pbrt::laws {
namespace {

constexpr int kSide = 30, kIndices = 20;

// Each of clones of one sampler: a thread has its own.
struct SamplerQuestions {
  static constexpr int count = kSide * kIndices;
  using Answer = std::array<float, 14>;

  explicit SamplerQuestions(const Subject& subject) : prototype(makeSampler(subject, 16)) {}

  static Point2i pixel(int i) { return {i % kSide, 7}; }
  static std::uint32_t index(int i) { return static_cast<std::uint32_t>(i / kSide); }
  static Answer draw(Sampler& s, int i) {
    s.start(pixel(i), index(i));
    std::array<Point2, 7> p;
    p[0] = s.pixel2D();
    p[1] = s.get2D();
    p[2].x = s.get1D();
    p[2].y = s.get1D();
    s.get2D(std::span(p).subspan(3, 3));
    p[6] = s.get2D();
    Answer answer;
    for (std::size_t k = 0; k < p.size(); ++k) answer[2 * k] = p[k].x, answer[2 * k + 1] = p[k].y;
    return answer;
  }
  static std::string about(int i) {
    return fmt::format("sample {} of pixel ({}, {})", index(i), pixel(i).x, pixel(i).y);
  }
  Answer ask(int i) const { return draw(*prototype->clone(), i); }

  std::unique_ptr<Sampler> prototype;
};

void orderDoesNotMatter(const Subject& subject, Judge& judge) {
  const auto own = makeSampler(subject, 16), clone = own->clone();
  judge.expect(own->samplesPerPixel() == clone->samplesPerPixel(),
               "a clone takes {} samples of a pixel, the sampler {}", clone->samplesPerPixel(),
               own->samplesPerPixel());
  std::vector<SamplerQuestions::Answer> forth;
  for (int i = 0; i < SamplerQuestions::count; ++i)
    forth.push_back(SamplerQuestions::draw(*own, i));
  for (Sampler* back : {clone.get(), own.get()})
    for (int i = SamplerQuestions::count; i-- > 0;) {
      const SamplerQuestions::Answer again = SamplerQuestions::draw(*back, i);
      judge.expect(again == forth[i],
                   "{}: the numbers begin with {} {} {} {}; taken in another order{} with {} {} {} "
                   "{}. They may depend on the seed, the pixel and the sample only",
                   SamplerQuestions::about(i), forth[i][0], forth[i][1], forth[i][2], forth[i][3],
                   back == own.get() ? "" : " by a clone", again[0], again[1], again[2], again[3]);
    }
}

// Far out in every direction: pixels, samples, counts that are no power of two, seeds.
void numbersAreBelowOneAndDiffer(const Subject& subject, Judge& judge) {
  for (const int n : {1, 3, 16, 1000})
    for (const Point2i resolution : {Point2i(1), Point2i(1, 16384), Point2i(16384)}) {
      const auto s = makeSampler(subject, n, ~std::uint64_t{0}, resolution);
      std::set<std::pair<float, float>> seen;
      int drawn = 0;
      for (const Point2i pixel : {Point2i(0), resolution - 1, Point2i(-3), Point2i(65535, 65536)})
        for (const std::uint32_t index : {0U, 2U, 1U << 20U, (1U << 20U) + 1U, 3000000001U}) {
          s->start(pixel, index);
          for (int d = 0; d < 50; ++d, ++drawn) {
            const Point2 p = d == 0 ? s->pixel2D() : s->get2D();
            judge.expect(inUnit(p),
                         "point {} of sample {} of pixel ({}, {}) is {}: not in [0, 1) ({} samples "
                         "per pixel, a picture of {} x {})",
                         d, index, pixel.x, pixel.y, show(p), n, resolution.x, resolution.y);
            seen.insert({p.x, p.y});
          }
        }
      // A point of 2^48 is hardly drawn twice; of resolution 1 the last pixel is the first.
      const int distinct = resolution == Point2i(1) ? drawn * 3 / 4 : drawn;
      judge.expect(static_cast<int>(seen.size()) >= distinct - 2,
                   "of {} points of various pixels, samples and dimensions only {} differ ({} "
                   "samples per pixel, a picture of {} x {})",
                   distinct, seen.size(), n, resolution.x, resolution.y);
    }
}

void hugeCountsCostNothing(const Subject& subject, Judge& judge) {
  constexpr int huge = 1000000000;
  const auto s = makeSampler(subject, huge);
  judge.expect(s->samplesPerPixel() >= huge, "asked for {} samples per pixel it takes {}", huge,
               s->samplesPerPixel());
  std::vector<Point2> set(3000);
  for (const std::uint32_t i : {0U, 999999999U, 0xffffffffU}) {
    s->start({-5, 100000}, i);
    for (int d = 0; d < 600; ++d) {
      const float u = s->get1D();
      judge.expect(inUnit(u), "number {} of sample {} of pixel (-5, 100000) is {}: not in [0, 1)",
                   d, i, u);
    }
    s->get2D(set);
    for (const Point2& p : set)
      judge.expect(inUnit(p), "of a set of {} points of sample {} one is {}: not in [0, 1)",
                   set.size(), i, show(p));
    s->get2D(std::span<Point2>());
  }
}

void countIsThatOfTheRender(const Subject& subject, Judge& judge) {
  for (const int n : {1, 4, 64, 4096}) {
    const int taken = makeSampler(subject, n)->samplesPerPixel();
    judge.expect(taken == n, "asked for {} samples per pixel (Setup) it takes {}", n, taken);
  }
  for (const int n : {3, 7, 1000}) {
    const int taken = makeSampler(subject, n)->samplesPerPixel();
    judge.expect(taken >= n, "asked for {} samples per pixel (Setup) it takes only {}", n, taken);
  }
}

void seedsGiveOtherNumbers(const Subject& subject, Judge& judge) {
  const auto first = [](const Subject& s, std::uint64_t seed) {
    const auto sampler = makeSampler(s, 16, seed);
    std::vector<SamplerQuestions::Answer> all;
    for (int i = 0; i < 16; ++i) all.push_back(SamplerQuestions::draw(*sampler, i * kSide));
    return all;
  };
  const auto plain = first(subject, 0);
  judge.expect(plain == first(subject, 0), "the same seed gives other numbers each time");
  judge.expect(plain != first(subject, 1), "seeds 0 and 1 of the render give the same numbers");
  if (!Declared(subject).has("seed")) return;
  const Subject five = with(subject, {integer("seed", 5)});
  const auto ofScene = first(five, 0);
  judge.expect(ofScene == first(five, 0), "\"integer seed\" 5 gives other numbers each time");
  judge.expect(ofScene != plain, "\"integer seed\" 5 gives the same numbers as none");
  judge.expect(ofScene != first(five, 1),
               "with \"integer seed\" 5 seeds 0 and 1 of the render give the same numbers");
  judge.expect(ofScene != first(with(subject, {integer("seed", -6)}), 0),
               "\"integer seed\" 5 and -6 give the same numbers");
}

void countsBelowOneAreErrors(const Subject& subject, Judge& judge) {
  bool any = false;
  for (const Declaration& d : Declared(subject)) {
    if (!d.name.ends_with("samples")) continue;
    any = true;
    for (const int n : {0, -1, -2000000000})
      judge.expect(!accepts<Sampler>(subject, {integer(d.name, n)}, {0, {}, {64, 64}}),
                   "\"integer {}\" {} is not refused by an Error", d.name, n);
  }
  if (!any) judge.skip("it declares no parameter whose name ends with \"samples\"");
}

void drawingAllocatesNothing(const Subject& subject, Judge& judge) {
  if (!countsAllocations()) return judge.skip("this program does not count what it allocates");
  const auto s = makeSampler(subject, 16);
  std::vector<Point2> set(64);
  const auto drawAll = [&](std::uint32_t first) {
    for (int x = 0; x < 16; ++x)
      for (std::uint32_t i = first; i < first + 16; ++i) {
        s->start({x, 3}, i);
        s->pixel2D();
        for (int d = 0; d < 20; ++d) s->get1D(), s->get2D();
        s->get2D(set);
      }
  };
  drawAll(0);  // it may get ready
  const std::size_t before = allocations();
  drawAll(16);
  const std::size_t made = allocations() - before;
  judge.expect(made == 0,
               "for 256 samples memory was asked for {} times (operator new); a sampler may do so "
               "when it is made or cloned only",
               made);
}

constexpr Law kLaws[] = {
    {"order-does-not-matter",
     "a number depends on the seed, the pixel, the sample and the dimension only",
     orderDoesNotMatter},
    {"below-one", "all numbers are in [0, 1), and pixels, samples and dimensions have their own",
     numbersAreBelowOneAndDiffer},
    {"huge-counts", "any number of samples per pixel can be asked for", hugeCountsCostNothing},
    {"count-of-the-render", "Setup::samplesPerPixel wins; more is taken only if it must be",
     countIsThatOfTheRender},
    {"seeds-differ", "another seed gives other numbers, the same seed the same",
     seedsGiveOtherNumbers},
    {"counts-from-one", "numbers of samples below one are refused", countsBelowOneAreErrors},
    {"uniform", "every dimension of every sample is uniform over the pixels", samplesAreUniform},
    {"sets-uniform", "every point of a set is uniform over the pixels", setsAreUniform},
    {"independent", "dimensions, neighbouring pixels and seeds have nothing to do with each other",
     dimensionsAndPixelsAreIndependent},
    {"not-aligned", "no dimension repeats another's pattern over the samples of a pixel",
     dimensionsAreNotAligned},
    {"well-spread", "the samples of a pixel integrate better than independent numbers",
     samplesAreWellSpread},
    {"sets-well-spread", "sets integrate better than independent points, alone and together",
     setsAreWellSpread},
    {"twins", "two samplers of the same parameters give the same numbers",
     Steady<SamplerQuestions>::twins},
    {"thread-safe", "clones in many threads give the same numbers as one alone",
     Steady<SamplerQuestions>::threadSafe},
    {"allocates-nothing", "drawing asks for no memory", drawingAllocatesNothing},
};

}  // namespace

std::span<const Law> samplerLaws() {
  return kLaws;
}

}  // namespace pbrt::laws
