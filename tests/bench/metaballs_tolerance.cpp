// What accuracy costs the root finder: its tolerance swept, its distance from the oracle's root and
// its time. Prints a table, and writes it to metaballs_tolerance.csv in the build folder for
// plot.py.
//
// The calls that the ray tree makes for the camera rays of a picture are recorded once and made
// again for every tolerance: the time is the root finder's alone, in seconds of the processor, over
// the rays that meet a cell at all.

#include <fmt/ostream.h>

#include "tests/bench/measure.h"
#include "tests/bench/metaballs_view.h"
#include "tests/shapes/metaballs/oracle.h"

namespace pbrt::metaballs::bench {
namespace {

using namespace pbrt::bench;

constexpr int kResolution = 256;
constexpr std::size_t kChecked = 1000;

struct Call {
  ObjectRay ray;
  std::uint32_t cell = 0, number = 0;  // number: of the ray
};

// Passes on what the tree asks, and writes it down.
class Recorder final : public Shape {
 public:
  explicit Recorder(const CellShape& shape) : shape_(shape) {}
  std::uint32_t primitives() const override { return shape_.primitives(); }
  Bounds3 bounds(std::uint32_t i) const override { return shape_.bounds(i); }
  std::optional<ShapeHit> intersect(const ObjectRay& ray, std::uint32_t i) const override {
    calls.push_back({ray, i, number});
    return shape_.intersect(ray, i);
  }
  SurfacePoint surface(const ObjectRay&, const ShapeHit&) const override { return {}; }

  std::uint32_t number = 0;
  mutable std::vector<Call> calls;

 private:
  const CellShape& shape_;
};

std::vector<Call> record(const CellShape& shape, const std::vector<Ray>& rays) {
  Recorder recorder(shape);
  const AccelDevice device(1);
  Accel tree(device);
  tree.add(recorder, Transform());
  tree.build();
  for (; recorder.number < rays.size(); ++recorder.number) tree.intersect(rays[recorder.number]);
  return std::move(recorder.calls);
}

// The nearest crossing of every ray; infinity: none.
std::vector<double> replay(const CellShape& shape, const std::vector<Call>& calls, std::size_t rays,
                           double tolerance) {
  std::vector<double> nearest(rays, kInfinity);
  for (const Call& call : calls)
    if (const auto t = shape.crossing(call.ray, call.cell, tolerance))
      nearest[call.number] = std::min(nearest[call.number], *t);
  return nearest;
}

void sweep(const Set& set, std::ostream& csv) {
  const CellShape shape(set.field);
  const std::vector<Ray> rays = cameraRays(set.field, kResolution);
  const std::vector<Call> calls = record(shape, rays);
  std::size_t meeting = 0;
  for (std::size_t i = 0; i < calls.size(); ++i)
    meeting += i == 0 || calls[i].number != calls[i - 1].number;

  // Hits spread over the picture, and the oracle's roots.
  const std::vector<double> exact = replay(shape, calls, rays.size(), 0);
  std::vector<std::uint32_t> hits;
  for (std::uint32_t i = 0; i < rays.size(); ++i)
    if (exact[i] < kInfinity) hits.push_back(i);
  const test::Blocks blocks(set.field);
  std::vector<std::pair<std::uint32_t, test::Quad>> truth;
  for (std::size_t k = 0; k < kChecked; ++k) {
    const std::uint32_t i = hits[k * hits.size() / kChecked];
    if (const auto root = test::Oracle(blocks, inDouble(rays[i])).first())
      truth.emplace_back(i, root->t);
  }

  fmt::print(
      "\n{} atoms: {} rays meet {:.1f} cells each, {} hit, {} of {} by the oracle too\n\n"
      "| tolerance/h | ns a ray | error/h mean | 99 % | max | rays that hit by this "
      "tolerance or by 0 alone |\n| --- | --- | --- | --- | --- | --- |\n",
      set.name, meeting, static_cast<double>(calls.size()) / static_cast<double>(meeting),
      hits.size(), truth.size(), kChecked);
  for (const double tolerance :
       {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 0.0}) {
    std::vector<double> found;
    const double nanoseconds = 1e9 / static_cast<double>(meeting) * fastest([&] {
                                 found = replay(shape, calls, rays.size(), tolerance);
                               });
    std::vector<double> errors;
    for (const auto& [i, t] : truth)
      if (found[i] < kInfinity)
        errors.push_back(static_cast<double>(test::abs(found[i] - t)) / set.h);
    std::ranges::sort(errors);
    std::size_t oneOnly = 0;
    for (std::size_t i = 0; i < rays.size(); ++i)
      oneOnly += (found[i] < kInfinity) != (exact[i] < kInfinity);
    fmt::print("| {:.0e} | {:.0f} | {:.2g} | {:.2g} | {:.2g} | {} |\n", tolerance, nanoseconds,
               mean(errors), quantile(errors, 0.99), quantile(errors, 1), oneOnly);
    fmt::print(csv, "{},{},{},{},{},{},{}\n", set.name, tolerance, nanoseconds, mean(errors),
               quantile(errors, 0.99), quantile(errors, 1), oneOnly);
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace pbrt::metaballs::bench

int main() {
  using namespace pbrt::metaballs::bench;
  std::ofstream csv(PBRT_BUILD_DIR "/metaballs_tolerance.csv");
  fmt::print(csv, "atoms,tolerance,nanoseconds,error_mean,error_99,error_max,one_only\n");
  for (const Set& set : {ball(12), ball(300), fluid(10000), fluid(100000)}) sweep(set, csv);
}
