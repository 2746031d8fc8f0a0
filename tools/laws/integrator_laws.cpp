// The laws of every integrator.

#include "allocations.h"
#include "laws.h"
#include "mean.h"
#include "show.h"
#include "stage.h"

namespace pbrt::laws {
namespace {

using Options = Stage::Options;

constexpr int kColours = 3;

// A pixel of a picture, by its place in the channels.
std::string pixel(const Image& image, std::size_t i) {
  const int width = image.window.width(), at = static_cast<int>(i);
  return fmt::format("pixel ({}, {})", image.window.lo.x + at % width,
                     image.window.lo.y + at / width);
}

// One trial: whether they have the same bits.
void expectSame(Judge& judge, const Stage& stage, const Image& a, const Image& b,
                std::string_view when) {
  std::size_t different = 0;
  std::string first;
  for (std::size_t c = 0; c < a.channels.size(); ++c)
    for (std::size_t i = 0; i < a.channels[c].size(); ++i)
      if (a.channels[c][i] != b.channels[c][i] && different++ == 0)
        first = fmt::format("{} of {} is {}, then {}", a.names[c], pixel(a, i), a.channels[c][i],
                            b.channels[c][i]);
  judge.expect(different == 0, "{}: {} {}; {} of {} values differ", stage.name(), first, when,
               different, a.channels.size() * a.channels[0].size());
}

// Calls Li itself, to be able to tell which sample is wrong.
void everySampleIsFinite(const Stage& stage, const SamplingIntegrator& integrator, Judge& judge) {
  const auto sampler = stage.sampler(1, 4);
  Scratch scratch;
  integrator.prepare(stage, Stage::kResolution);
  for (int y = 0; y < Stage::kResolution.y; ++y)
    for (int x = 0; x < Stage::kResolution.x; ++x)
      for (std::uint32_t s = 0; s < 4; ++s) {
        sampler->start({x, y}, s);
        CameraSample sample;
        sample.film = Point2(x, y) + sampler->pixel2D();
        const RayDifferential ray = stage.camera().generate(sample, stage.filters()).ray;
        Hit hit;
        const Ray* const only = &ray;
        integrator.look(stage, {&only, 1}, 1, {&hit, 1});
        const Spectrum L = integrator.Li(stage, ray, hit, *sampler, scratch);
        scratch.release();
        judge.expect(isFinite(L) && L.x >= 0 && L.y >= 0 && L.z >= 0,
                     "{}: Li of sample {} of pixel ({}, {}) is {}; ray o {} d {}", stage.name(), s,
                     x, y, show(L), show(ray.o), show(ray.d));
      }
}

void isFiniteAndNotNegative(const Subject& subject, Judge& judge) {
  for (const auto& stage : stages(subject)) {
    if (const SamplingIntegrator* sampling = stage->integrator().sampling())
      everySampleIsFinite(*stage, *sampling, judge);
    const auto [image, bad] = stage->render(Options{});
    judge.expect(bad == 0, "{}: {} samples are not finite numbers", stage->name(), bad);
    for (std::size_t c = 0; c < image.channels.size(); ++c)
      for (std::size_t i = 0; i < image.channels[c].size(); ++i)
        judge.expect(std::isfinite(image.channels[c][i]) && image.channels[c][i] >= 0,
                     "{}: {} of {} is {}", stage->name(), image.names[c], pixel(image, i),
                     image.channels[c][i]);
  }
}

void isBlackWithoutLight(const Subject& subject, Judge& judge) {
  for (const auto& stage : stages(subject)) {
    if (stage->isLit()) continue;
    if (!stage->integrator().usesLights()) return judge.skip("it says that it uses no lights");
    const Image image = stage->render(Options{}).image;
    for (std::size_t c = 0; c < kColours; ++c)
      for (std::size_t i = 0; i < image.channels[c].size(); ++i)
        judge.expect(image.channels[c][i] == 0,
                     "{}: {} of {} is {}, but usesLights() says that it is black without light",
                     stage->name(), image.names[c], pixel(image, i), image.channels[c][i]);
  }
}

void isTheSameAgain(const Subject& subject, Judge& judge) {
  for (const auto& stage : stages(subject)) {
    const Image first = stage->render(Options{}).image;
    expectSame(judge, *stage, first, stage->render(Options{}).image, "in the same render again");
    Film film = stage->film();
    stage->render(*stage->makeIntegrator(), Options{}, film);
    expectSame(judge, *stage, first, film.image(), "by another object of the same parameters");
  }
}

void isTheSameInManyThreads(const Subject& subject, Judge& judge) {
  for (const auto& stage : stages(subject)) {
    Options options;
    const Image one = stage->render(options).image;
    options.threads = 4;
    for (int again = 0; again < 2; ++again)
      expectSame(judge, *stage, one, stage->render(options).image, "in 4 threads");
  }
}

void samplesAddUp(const Subject& subject, Judge& judge) {
  for (const auto& stage : stages(subject)) {
    Options options;
    options.samples = 4;
    Film whole = stage->film(), parts = stage->film();
    stage->render(stage->integrator(), options, whole);
    for (options.first = 0; options.first < 4; options.first += 2) {
      options.end = options.first + 2;
      stage->render(stage->integrator(), options, parts);
    }
    expectSame(judge, *stage, whole.image(), parts.image(),
               "from samples 0 and 1, and then 2 and 3, than from 0 to 3");
  }
}

void cropIsAPart(const Subject& subject, Judge& judge) {
  for (const auto& stage : stages(subject)) {
    Options options;
    const Image whole = stage->render(options).image;
    options.crop = {{7, 5}, {37, 33}};
    const Image crop = stage->render(options).image;
    Image part = crop;
    for (std::size_t c = 0; c < part.channels.size(); ++c)
      for (std::size_t i = 0; i < part.channels[c].size(); ++i) {
        const int x = 7 + static_cast<int>(i) % 30, y = 5 + static_cast<int>(i) / 30;
        part.channels[c][i] = whole.channels[c][y * Stage::kResolution.x + x];
      }
    expectSame(judge, *stage, part, crop, "in a crop");
  }
}

// Pixels of two seeds are independent estimates of the same: their differences have the mean 0.
void seedsAgree(const Subject& subject, Judge& judge) {
  constexpr double sigmas = 5;
  bool differ = false;
  for (const auto& stage : stages(subject)) {
    Options options;
    options.samples = 8;
    const Image a = stage->render(options).image;
    options.seed = 1;
    const Image b = stage->render(options).image;
    differ = differ || a.channels != b.channels;
    for (std::size_t c = 0; c < kColours; ++c) {
      Mean difference, level;
      for (std::size_t i = 0; i < a.channels[c].size(); ++i) {
        difference.add(double{a.channels[c][i]} - b.channels[c][i]);
        level.add(a.channels[c][i]);
      }
      judge.expect(
          std::abs(difference.mean()) <= sigmas * difference.error() + 1e-6 * level.mean(),
          "{}: the means of {} over the pictures of seeds 0 and 1 differ by {} +- {}, of {}",
          stage->name(), a.names[c], difference.mean(), difference.error(), level.mean());
    }
  }
  judge.expect(differ,
               "pictures of seeds 0 and 1 are the same in every scene: it does not use the "
               "sampler that it is given, nor its camera rays");
}

void allocatesNothing(const Subject& subject, Judge& judge) {
  if (!countsAllocations()) return judge.skip("this program does not count what it allocates");
  for (const auto& stage : stages(subject)) {
    const auto asked = [&](std::uint32_t samples) {
      Options options;
      options.samples = samples;
      Film film = stage->film();
      const std::size_t before = allocations();
      stage->render(stage->integrator(), options, film);
      return allocations() - before;
    };
    asked(4);  // it may get ready
    const std::size_t few = asked(4), many = asked(8);
    const double pixels = double{1} * Stage::kResolution.x * Stage::kResolution.y;
    judge.expect(many <= few,
                 "{}: 4 more samples per pixel ask {} times more for memory (operator new), {:.2f} "
                 "times a sample; what lives as long as a ray belongs into the scratch memory",
                 stage->name(), many - few, static_cast<double>(many - few) / (4 * pixels));
  }
}

void transmittanceIsAShare(const Subject& subject, Judge& judge) {
  for (const auto& stage : stages(subject)) {
    const VolumeIntegrator* volume = stage->integrator().volume();
    if (!volume) return judge.skip("it is no volume integrator");
    const auto sampler = stage->sampler(1, 1);
    for (int i = 0; i < 1000; ++i) {
      sampler->start({i, 0}, 0);
      const Point2 place = sampler->pixel2D();
      const Ray ray = stage->camera().generate({place * Point2(Stage::kResolution)}, false).ray;
      const float t = 8 * sampler->get1D();
      const Spectrum T = volume->transmittance(*stage, ray, t), none(0);
      const std::string at =
          fmt::format("{}: ray o {} d {}", stage->name(), show(ray.o), show(ray.d));
      for (int c = 0; c < kColours; ++c) {
        judge.expect(T[c] >= 0 && T[c] <= 1, "{}: the transmittance up to t = {} is {}", at, t,
                     show(T));
        judge.expect(T[c] == 1 || !stage->regions().empty(),
                     "{}: the transmittance up to t = {} is {} in clear air", at, t, show(T));
      }
      Hit hit;
      hit.t = t;
      const Spectrum gained = volume->through(*stage, ray, hit, none, *sampler);
      judge.expect(isFinite(gained) && gained.x >= 0 && gained.y >= 0 && gained.z >= 0,
                   "{}: what is added up to t = {} is {}", at, t, show(gained));
    }
  }
}

constexpr Law kLaws[] = {
    {"finite", "radiance is finite and not negative, in scenes of any sort",
     isFiniteAndNotNegative},
    {"black-without-light", "without light the picture is black, or usesLights() says otherwise",
     isBlackWithoutLight},
    {"repeatable", "the same render gives the same bits, by another object as well",
     isTheSameAgain},
    {"thread-safe", "any number of threads gives the same bits", isTheSameInManyThreads},
    {"samples-add-up", "a render in two passes gives the same bits as one", samplesAddUp},
    {"crop-is-a-part", "a crop has the bits that the whole picture has there", cropIsAPart},
    {"seeds-agree", "another seed gives another noise about the same picture", seedsAgree},
    {"allocates-nothing", "no sample asks for memory", allocatesNothing},
    {"transmittance-is-a-share",
     "what a volume integrator lets through is from 0 to 1, and 1 in clear air",
     transmittanceIsAShare},
};

}  // namespace

std::span<const Law> integratorLaws() {
  return kLaws;
}

}  // namespace pbrt::laws
