// What an implicit surface costs: a ball by its formula against the analytic sphere, for several
// numbers of boxes, and metaballs by the general search against their own. Through the ray tree,
// one ray at a time, most rays hit. Counters: rays per second, boxes.

#include <benchmark/benchmark.h>

#include "core/base/rng.h"
#include "core/base/warp.h"
#include "core/plugin/implicit_shape.h"
#include "core/plugin/loader.h"
#include "core/scene/accel.h"
#include "tests/core/plugin/formulas.h"

namespace pbrt {
namespace {

std::vector<Ray> someRays() {
  Rng rng(11);
  std::vector<Ray> rays;
  const auto onSphere = [&](float r) { return r * uniformSphere({rng.uniform(), rng.uniform()}); };
  for (int i = 0; i < 1 << 14; ++i) {
    const Point3 from = onSphere(4), to = onSphere(1.22F * std::sqrt(rng.uniform()));
    rays.push_back({from, 0, glm::normalize(to - from)});
  }
  return rays;
}

void trace(benchmark::State& state, Shape& shape) {
  const AccelDevice device(1);
  Accel tree(device);
  tree.add(shape, Transform());
  tree.build();
  const std::vector<Ray> rays = someRays();
  std::size_t i = 0, hits = 0;
  for (auto _ : state) hits += tree.intersect(rays[i++ % rays.size()]).found();
  state.counters["rays"] = benchmark::Counter(static_cast<double>(i), benchmark::Counter::kIsRate);
  state.counters["hits"] =
      benchmark::Counter(static_cast<double>(hits), benchmark::Counter::kAvgIterations);
  state.counters["boxes"] = shape.primitives();
}

std::unique_ptr<Shape> plugin(const std::string& name, const ParamList& list = {}) {
  static PluginLoader loader({PBRT_BUILD_DIR "/lib/pbrt"});
  Params params(name, {}, {&list});
  return create<Shape>(loader.open(PluginKind::shape, name), params, {});
}

// Lends the field of another shape.
class Lent final : public ImplicitField {
 public:
  explicit Lent(const ImplicitField& field) : field_(field) {}
  Bounds3 bounds() const override { return field_.bounds(); }
  FieldPoint at(const DPoint3& p) const override { return field_.at(p); }
  FieldRange over(const DPoint3& lo, const DPoint3& hi) const override {
    return field_.over(lo, hi);
  }
  LineRange along(const DPoint3& o, const DVec3& u, const Range& s, double error) const override {
    return field_.along(o, u, s, error);
  }
  glm::dmat3 hessian(const DPoint3& p) const override { return field_.hessian(p); }

 private:
  const ImplicitField& field_;
};

// Atoms in a ball of radius one, drawn at random, about 8 supports over every point.
std::unique_ptr<Shape> metaballs(int count) {
  Rng rng(7);
  std::vector<float> points;
  for (int i = 0; i < count; ++i) {
    const Point3 p = std::cbrt(rng.uniform()) * uniformSphere({rng.uniform(), rng.uniform()});
    points.insert(points.end(), {p.x, p.y, p.z});
  }
  ParamList list;
  list.push_back({ParamType::point3, "P", {}, {}, points});
  list.push_back({ParamType::number,
                  "radius",
                  {},
                  {},
                  std::vector<float>{2 / std::cbrt(static_cast<float>(count))}});
  return plugin("metaballs", list);
}

void analytic(benchmark::State& state) {
  trace(state, *plugin("sphere"));
}
void specialised(benchmark::State& state) {
  trace(state, *metaballs(300));
}
void general(benchmark::State& state) {
  const auto shape = metaballs(300);
  ImplicitShape implicit(std::make_unique<Lent>(*shape->implicit()),
                         static_cast<std::size_t>(state.range(0)));
  trace(state, implicit);
}
// The field near its surface, as particles on it would ask for it.
void lookUp(benchmark::State& state) {
  const auto shape = metaballs(static_cast<int>(state.range(0)));
  const ImplicitField& field = *shape->implicit();
  Rng rng(3);
  for (auto _ : state)
    benchmark::DoNotOptimize(field.at(DPoint3(uniformSphere({rng.uniform(), rng.uniform()}))));
}
template <class F>
void formula(benchmark::State& state) {
  ImplicitShape shape(std::make_unique<Formula<F>>(F{}), static_cast<std::size_t>(state.range(0)));
  trace(state, shape);
}
template <class F>
void build(benchmark::State& state) {
  for (auto _ : state)
    benchmark::DoNotOptimize(
        ImplicitShape(std::make_unique<Formula<F>>(F{}), static_cast<std::size_t>(state.range(0)))
            .primitives());
}

#define BOXES RangeMultiplier(4)->Range(1 << 9, 1 << 17)
BENCHMARK(analytic)->Name("sphere");
BENCHMARK(formula<test::Ball>)->Name("ball")->BOXES;
BENCHMARK(formula<test::Torus>)->Name("torus")->BOXES;
BENCHMARK(formula<test::Gyroid>)->Name("gyroid")->BOXES;
BENCHMARK(build<test::Ball>)->Name("build ball")->BOXES->Unit(benchmark::kMillisecond);
BENCHMARK(build<test::Gyroid>)->Name("build gyroid")->BOXES->Unit(benchmark::kMillisecond);
BENCHMARK(specialised)->Name("metaballs");
BENCHMARK(general)->Name("metaballs, general search")->BOXES;
BENCHMARK(lookUp)->Name("metaballs, field at a point")->RangeMultiplier(10)->Range(100, 100'000);

}  // namespace
}  // namespace pbrt
