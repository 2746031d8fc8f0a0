#include "tools/particles/motion/sequence.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>

#include "core/base/error.h"
#include "core/base/numbered_name.h"
#include "shapes/metaballs/atoms.h"
#include "shapes/metaballs/particles/particles.h"
#include "tools/particles/motion/match.h"

namespace pbrt::motion {
namespace {

namespace fs = std::filesystem;

// Numbered files of one folder.
struct Pattern {
  fs::path folder;
  std::string name;

  explicit Pattern(const fs::path& path)
      : folder(path.parent_path()), name(path.filename().string()) {
    if (numberRuns(name) != 1)
      throw Error(fmt::format("\"{}\" is no name of numbered files: it needs one run of # for the "
                              "digits, as in fluid####.ply",
                              shown(path.string())),
                  Failure::usage);
  }

  fs::path file(int number) const { return folder / numbered(name, number); }

  // The number in a name of this kind.
  std::optional<int> number(const std::string& file) const {
    const auto number = numberIn(name, file);
    return number && *number < kMostFrames ? number : std::nullopt;
  }
};

void check(const SequenceSettings& settings) {
  checkFrameRate(settings.fps);
  const auto positive = [](const char* name, float value) {
    if (!(std::isfinite(value) && value > 0))
      throw Error(fmt::format("{} is {}, but it must be finite and greater than 0", name, value),
                  Failure::usage);
  };
  positive("radiusscale", settings.radiusScale);
  if (settings.radius) positive("radius", *settings.radius);
  if (settings.threshold) positive("threshold", *settings.threshold);
}

class Sequence final : public Motion {
 public:
  Sequence(const std::string& pattern, const SequenceSettings& settings)
      : pattern_(pattern), settings_(settings) {
    list(pattern);
    survey();
  }

  int first() const override { return numbers_.front(); }
  int last() const override { return numbers_.back(); }
  void require(int first, int last) const override;
  std::vector<fs::path> files() const override {
    std::vector<fs::path> all;
    for (const int number : numbers_) all.push_back(pattern_.file(number));
    return all;
  }
  double dt() const override { return 1 / settings_.fps; }
  Bounds3 bounds() const override { return bounds_; }
  void frame(int number, Fluid& out) override;

 private:
  void list(const std::string& pattern);
  void survey();
  std::vector<float> radii(const Particles& particles) const;
  const Particles& particles(int number);
  std::vector<Vec3> velocities(int number);

  Pattern pattern_;
  SequenceSettings settings_;
  std::vector<int> numbers_;  // of the files that there are, rising
  // What holds for the whole sequence.
  Bounds3 bounds_;
  float particleRadius_ = 0;  // half the usual distance
  float largestRadius_ = 0;   // of the supports
  std::map<int, Particles> read_;
};

void Sequence::list(const std::string& pattern) {
  std::error_code failed;
  fs::directory_iterator entry(pattern_.folder.empty() ? "." : pattern_.folder, failed);
  for (; !failed && entry != fs::directory_iterator(); entry.increment(failed))
    if (const auto number = pattern_.number(entry->path().filename().string()))
      numbers_.push_back(*number);
  if (failed)
    throw Error(fmt::format("{}: {}", pattern_.folder.string(), failed.message()), Failure::io);
  if (numbers_.empty())
    throw Error(fmt::format("there is no file \"{}\" with a number for the #", pattern),
                Failure::io);
  std::ranges::sort(numbers_);
}

// Some frames tell where the fluid goes and how large its particles are: among them the first and
// the last, and for the distance of particles the one that has the most.
void Sequence::survey() {
  constexpr std::size_t most = 16;
  const std::size_t frames = std::min(most, numbers_.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < frames; ++i) {
    const std::size_t which = frames > 1 ? i * (numbers_.size() - 1) / (frames - 1) : 0;
    const Particles some = readParticles(pattern_.file(numbers_[which]));
    for (const Point3& p : some.positions) bounds_.add(p);
    if (some.positions.size() > count) {
      count = some.positions.size();
      particleRadius_ = metaballs::typicalParticleRadius(some.positions);
    }
    if (!settings_.radius)
      for (const float radius : some.radii)
        largestRadius_ = std::max(largestRadius_, settings_.radiusScale * radius);
  }
  if (largestRadius_ == 0) largestRadius_ = radii({})[0];
  // A lone atom ends before this.
  bounds_.lo -= 0.6F * largestRadius_;
  bounds_.hi += 0.6F * largestRadius_;
}

// Of the supports.
std::vector<float> Sequence::radii(const Particles& particles) const {
  if (settings_.radius) return {*settings_.radius};
  if (particles.radii.empty()) return {settings_.radiusScale * particleRadius_};
  std::vector<float> radii = particles.radii;
  for (float& radius : radii) radius *= settings_.radiusScale;
  return radii;
}

// A frame, with its neighbours read once.
const Particles& Sequence::particles(int number) {
  const auto known = read_.find(number);
  if (known != read_.end()) return known->second;
  return read_[number] = readParticles(pattern_.file(number));
}

// The mean of what the frames before and after tell.
std::vector<Vec3> Sequence::velocities(int number) {
  const Particles& now = particles(number);
  if (!now.velocities.empty()) return now.velocities;
  std::vector<Vec3> sums(now.positions.size(), Vec3(0));
  std::vector<int> counts(now.positions.size(), 0);
  const auto place = std::ranges::lower_bound(numbers_, number);
  const auto add = [&](int other) {
    const float frames = static_cast<float>(other - number);
    constexpr float kFurthest = 8;  // supports from frame to frame
    const auto moved = shifts(now.positions, particles(other).positions, other > number,
                              kFurthest * largestRadius_ * std::abs(frames), particleRadius_);
    for (std::size_t i = 0; i < moved.size(); ++i)
      if (moved[i]) {
        sums[i] += *moved[i] * (static_cast<float>(settings_.fps) / frames);
        ++counts[i];
      }
  };
  if (place != numbers_.begin()) add(*(place - 1));
  if (place + 1 != numbers_.end()) add(*(place + 1));
  for (std::size_t i = 0; i < sums.size(); ++i)
    if (counts[i] > 1) sums[i] /= static_cast<float>(counts[i]);
  return sums;
}

void Sequence::require(int first, int last) const {
  auto place = std::ranges::lower_bound(numbers_, first);
  for (int number = first; number <= last; ++number, ++place) {
    if (place != numbers_.end() && *place == number) continue;
    std::vector<std::string> nearest;
    if (place != numbers_.begin()) nearest.push_back(pattern_.file(*(place - 1)).string());
    if (place != numbers_.end()) nearest.push_back(pattern_.file(*place).string());
    throw Error(
        fmt::format("{} is missing; nearest to it there {} {}", pattern_.file(number).string(),
                    nearest.size() > 1 ? "are" : "is", fmt::join(nearest, " and ")),
        Failure::io);
  }
}

void Sequence::frame(int number, Fluid& out) {
  require(number, number);
  const auto place = std::ranges::lower_bound(numbers_, number);
  const std::vector<Vec3> velocities = this->velocities(number);
  const Particles& now = particles(number);
  const auto fail = [&](const char*, const std::string& message) {
    throw Error(fmt::format("{}: {}", pattern_.file(number).string(), message));
  };
  metaballs::AtomValues values;
  values.kernel = settings_.kernel;
  values.centres = now.positions;
  values.radii = radii(now);
  if (values.radii == std::vector<float>{0})
    fail("radius", "the particles have neither radii nor distances: give a radius");
  values.strengths = now.strengths.empty() ? std::vector<float>{1} : now.strengths;
  values.threshold = settings_.threshold
                         ? *settings_.threshold
                         : metaballs::defaultThreshold(values.kernel, largestRadius_);
  metaballs::Atoms made = makeAtoms(values, fail);

  out.kernel = values.kernel;
  out.atoms = std::move(made.atoms);
  out.velocities.clear();
  for (const std::uint32_t i : made.numbers) out.velocities.push_back(velocities[i]);
  // The next frame asks for this one and for those that follow.
  const int next = place + 1 == numbers_.end() ? number : *(place + 1);
  std::erase_if(read_,
                [&](const auto& entry) { return entry.first < number || entry.first > next; });
}

}  // namespace

std::unique_ptr<Motion> openSequence(const std::string& pattern, const SequenceSettings& settings) {
  check(settings);
  return std::make_unique<Sequence>(pattern, settings);
}

}  // namespace pbrt::motion
