#include "measure.h"

#include <fmt/format.h>

#include <utility>

#include "clock.h"
#include "core/scene/render.h"
#include "tools/compare/flip.h"

namespace pbrt {

namespace {

constexpr std::array<const char*, 3> kChannels = {"R", "G", "B"};

// A picture that grows.
struct Rendering {
  Film film;
  std::unique_ptr<Sampler> sampler;
  Run run;
  int threads;
  std::uint32_t textureSamples;
  std::uint64_t badSamples = 0;  // as in RenderControl

  Rendering(const Variant& variant, std::uint64_t seed, std::uint32_t samplesPerPixel,
            int maxThreads, std::uint32_t samplesOfTextures)
      : film(variant.scene->film()),
        sampler(variant.scene->makeSampler(seed, static_cast<int>(samplesPerPixel))),
        threads(maxThreads),
        textureSamples(samplesOfTextures) {}

  void advance(const Scene& scene, std::uint32_t endSample) {
    RenderControl control;
    control.firstSample = run.samples;
    control.endSample = endSample;
    control.threads = threads;
    control.samplesPerPixel = textureSamples;
    const Clock clock;
    scene.integrator().render(scene, *sampler, film, control);
    run.seconds += clock.seconds();
    run.cpuSeconds += clock.cpuSeconds();
    run.rays += control.rays;
    run.samples = endSample;
    badSamples += control.faults.count();
  }

  // As many whole samples as come nearest to the time, one at least.
  void advanceUntil(const Scene& scene, double seconds) {
    while (true) {
      const double room = run.samples == 0 ? 1 : (seconds / run.seconds - 1) * run.samples;
      if (room < 0.5) return;
      const auto step = static_cast<std::uint32_t>(
          std::clamp(room, 1.0, std::max(1.0, static_cast<double>(run.samples))));
      advance(scene, run.samples + step);
    }
  }

  Image image() const {
    Image image = film.image();
    image.attributes["samplesPerPixel"] = static_cast<int>(run.samples);
    image.attributes["filterNoise"] = static_cast<float>(film.filterNoise());
    return image;
  }
};

// The bias of a snapshot, from the block means of its runs and the noise that the pictures state.
// Samplers better than random leave less than that: then fewer blocks stand out, never more.
void setBias(Snapshot& snapshot, const std::vector<Blocks>& runs, const Reference& reference) {
  const auto k = static_cast<double>(runs.size());
  if (snapshot.runs.front().samples < 2) return;  // one sample states no noise
  const auto z = [&](std::size_t b) {
    double mean = 0, variance = reference.blocks.variance[b];
    for (const Blocks& run : runs) {
      mean += run.mean[b] / k;
      variance += run.variance[b] / (k * k);
    }
    const double rounding = 1e-7 * mean + 1e-15;
    return (mean - reference.blocks.mean[b]) / std::sqrt(variance + rounding * rounding);
  };
  const std::size_t blocks = reference.blocks.mean.size() - 1;
  std::size_t beyond = 0;
  for (std::size_t b = 0; b < blocks; ++b) beyond += std::abs(z(b)) > 3;
  snapshot.biasShare = static_cast<double>(beyond) / static_cast<double>(blocks);
  snapshot.biasZ = z(blocks);
}

// The points (log seconds, log RMSE) of one seed, of those snapshots that are well above the error
// of the reference, which is taken off: E(I - R)^2 = E(I - mu)^2 + E(R - mu)^2.
std::optional<Estimate> slopeOfSeed(const std::vector<Snapshot>& snapshots, std::size_t seed,
                                    double referenceMse, int& points) {
  std::vector<double> x, y;
  for (const Snapshot& s : snapshots) {
    const Run& run = s.runs[seed];
    if (!(run.errors.mse > 3 * referenceMse) || !(run.seconds > 0)) continue;
    x.push_back(std::log(run.seconds));
    y.push_back(0.5 * std::log(run.errors.mse - referenceMse));
  }
  points = static_cast<int>(x.size());
  return slopeOf(x, y);
}

void setSlope(Curve& curve, const Plan& plan, const Reference& reference) {
  std::vector<double> slopes;
  std::optional<Estimate> one;
  for (int s = 0; s < plan.seeds; ++s) {
    one = slopeOfSeed(curve.snapshots, static_cast<std::size_t>(s), reference.mse.value_or(0),
                      curve.slopePoints);
    if (!one) return;
    slopes.push_back(one->value);
  }
  // The points of a growing render are not independent: how they scatter tells no error.
  if (plan.progressive) one->error.reset();
  curve.slope = plan.seeds > 1 ? meanOf(slopes) : one;
}

}  // namespace

Blocks::Blocks(const Image& image) {
  constexpr int kSize = 16;
  const int width = image.window.width(), height = image.window.height();
  const int across = (width + kSize - 1) / kSize, down = (height + kSize - 1) / kSize;
  const double noise = image.number("filterNoise", 1);
  const std::size_t whole = static_cast<std::size_t>(across) * down;
  mean.resize(whole + 1);
  variance.resize(whole + 1);
  std::vector<double> count(whole + 1);
  for (const char* name : kChannels) {
    const std::vector<float>& values = *image.channel(name);
    const std::vector<float>* const variances = image.channel(std::string("Variance.") + name);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const std::size_t i = static_cast<std::size_t>(y) * width + x;
        const std::size_t block = static_cast<std::size_t>(y / kSize) * across + x / kSize;
        for (const std::size_t b : {block, whole}) {
          mean[b] += values[i];
          if (variances) variance[b] += (*variances)[i] / noise;
          count[b] += 1.0 / 3;
        }
      }
  }
  for (std::size_t b = 0; b <= whole; ++b) {
    mean[b] /= 3 * count[b];
    variance[b] /= 3 * sqr(count[b]);
  }
}

Estimate Snapshot::mean(const std::function<double(const Run&)>& value) const {
  std::vector<double> values;
  for (const Run& run : runs) values.push_back(value(run));
  return meanOf(values);
}

std::vector<Curve> measure(const std::vector<Variant>& variants,
                           const std::vector<const Reference*>& references, const Plan& plan,
                           const std::function<void(const std::string&)>& said) {
  const bool timed = !plan.times.empty();
  const std::size_t levels = timed ? plan.times.size() : plan.samples.size();
  const std::size_t n = variants.size(), seeds = static_cast<std::size_t>(plan.seeds);
  std::vector<Curve> curves(n);
  std::vector<std::vector<std::vector<Blocks>>> blocks(n);  // by variant, level and seed
  for (std::size_t v = 0; v < n; ++v) {
    curves[v].snapshots.resize(levels);
    for (Snapshot& snapshot : curves[v].snapshots) snapshot.runs.resize(seeds);
    blocks[v].assign(levels, std::vector<Blocks>(seeds));
  }
  for (std::size_t seed = 0; seed < seeds; ++seed) {
    const Clock clock;
    std::vector<std::optional<Rendering>> renderings(n);
    for (std::size_t turn = 0; turn < levels * n; ++turn) {
      const std::size_t level = turn / n, v = (turn + seed + level) % n;
      const Scene& scene = *variants[v].scene;
      std::optional<Rendering>& rendering = renderings[v];
      if (!rendering || !plan.progressive) {
        const std::uint32_t whole =
            timed ? static_cast<std::uint32_t>(scene.sampler().samplesPerPixel())
                  : (plan.progressive ? plan.samples.back() : plan.samples[level]);
        rendering.emplace(variants[v], plan.firstSeed + seed, whole, plan.threads,
                          plan.textureSamples);
      }
      const double before = rendering->run.seconds;
      if (timed)
        rendering->advanceUntil(scene, plan.times[level]);
      else
        rendering->advance(scene, plan.samples[level]);

      Curve& curve = curves[v];
      Run run = rendering->run;
      const Clock taking;
      Image image = rendering->image();
      curve.pictureSeconds += taking.seconds();
      curve.renderSeconds += run.seconds - before;
      curve.badSamples += std::exchange(rendering->badSamples, 0);
      run.errors = measureErrors(references[v]->image, image);
      run.flip = flip(references[v]->image, image).mean;
      curve.snapshots[level].runs[seed] = run;
      blocks[v][level][seed] = Blocks(image);
      if (seed == 0) curve.snapshots[level].picture = std::move(image);
    }
    said(fmt::format("seed {}: {:.1f} s", plan.firstSeed + seed, clock.seconds()));
  }
  for (std::size_t v = 0; v < n; ++v)
    for (std::size_t level = 0; level < levels; ++level)
      setBias(curves[v].snapshots[level], blocks[v][level], *references[v]);
  for (std::size_t v = 0; v < n; ++v) setSlope(curves[v], plan, *references[v]);
  return curves;
}

Reference renderReference(const Variant& variant, std::uint32_t samples, int threads) {
  // Far from any seed that somebody counts up to.
  constexpr std::uint64_t kSeed = 0x7ef0000000000000;
  const std::uint32_t half = std::max(1U, samples / 2);
  Reference reference;
  std::array<Image, 2> images;
  for (std::size_t i = 0; i < 2; ++i) {
    Rendering rendering(variant, kSeed + i, half, threads, 2 * half);
    rendering.advance(*variant.scene, half);
    images[i] = rendering.image();
    reference.badSamples += rendering.badSamples;
  }
  reference.scene = variant.name;
  reference.samples = 2 * half;
  reference.image = images[0];
  for (std::size_t c = 0; c < reference.image.channels.size(); ++c) {
    const bool ofVariance = reference.image.names[c].starts_with("Variance.");
    for (std::size_t i = 0; i < reference.image.channels[c].size(); ++i) {
      const float b = images[1].channels[c][i];
      float& a = reference.image.channels[c][i];
      a = (a + b) / (ofVariance ? 4.F : 2.F);
    }
  }
  // (A + B) / 2 has a quarter of the variance of A - B.
  reference.mse = measureErrors(images[0], images[1]).mse / 4;
  reference.blocks = Blocks(reference.image);
  reference.description =
      fmt::format("{}{}{}, two seeds of its own", variant.name,
                  variant.statements.empty() ? "" : " with ", variant.statements);
  return reference;
}

Reference readReference(const std::filesystem::path& file) {
  Reference reference;
  reference.image = readExr(file);
  const Image& image = reference.image;
  reference.scene = file.stem().string();
  reference.description = file.filename().string();
  const double samples = image.number("samplesPerPixel", 0);
  if (samples >= 1 && samples <= std::numeric_limits<std::uint32_t>::max())
    reference.samples = static_cast<std::uint32_t>(samples);
  const auto checked = [&](const std::string& name) {
    const std::vector<float>* const values = image.channel(name);
    if (values &&
        !std::all_of(values->begin(), values->end(), [](float v) { return std::isfinite(v); }))
      throw Error(fmt::format("{}: channel {} holds values that are not a number or infinite",
                              file.string(), name),
                  Failure::io);
    return values;
  };
  double sum = 0;
  bool stated = samples >= 2;  // fewer state no noise
  for (const std::string name : kChannels) {
    if (!checked(name))
      throw Error(fmt::format("{} has no channel {}", file.string(), name), Failure::io);
    const std::vector<float>* const variances = checked("Variance." + name);
    stated = stated && variances != nullptr;
    if (variances)
      for (const float v : *variances) sum += v / (3.0 * static_cast<double>(variances->size()));
  }
  if (stated) reference.mse = sum;
  reference.blocks = Blocks(image);
  return reference;
}

}  // namespace pbrt
