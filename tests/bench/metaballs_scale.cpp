// How building and tracing metaballs grow with the number of atoms: SPH-like sets, a jittered grid
// with h = 2 spacings and the threshold at half the interior density. 512 x 512 camera rays and one
// shadow ray for each hit, through the plug-in's cells and the ray tree; median of 3.
// Usage: metaballs_scale [THREADS [ATOMS...]]

#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "core/base/parallel.h"
#include "core/base/rng.h"
#include "core/scene/accel.h"
#include "tests/bench/cell_shape.h"
#include "tests/bench/measure.h"

namespace pbrt::metaballs {
namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// n^3 atoms about (0, 0, 0), spacing 1.
Field jitteredGrid(int n) {
  Rng rng(1);
  std::vector<Atom> atoms;
  atoms.reserve(static_cast<std::size_t>(n) * n * n);
  // The interior density of poly6 weights 1 is 1; the threshold is half of it.
  const double weight = scale(Kernel::poly6, 2) / 0.5;
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        const Vec3 jitter = 0.25F * (2.F * Vec3(rng.uniform(), rng.uniform(), rng.uniform()) - 1.F);
        atoms.emplace_back(Point3(x, y, z) - 0.5F * static_cast<float>(n - 1) + jitter, 2.F,
                           weight);
      }
  return {Kernel::poly6, std::move(atoms)};
}

struct Traced {
  double seconds = 0;
  std::size_t rays = 0, hits = 0, lit = 0;
};

Traced trace(const Accel& tree, const Field& field, const bench::CellShape& shape, float extent) {
  constexpr int size = 512;
  const Point3 eye(0.9F * extent, 1.3F * extent, 2.6F * extent),
      light(3 * extent, 4 * extent, extent);
  const Vec3 z = glm::normalize(-eye), x = glm::normalize(glm::cross(z, Vec3(0, 1, 0))),
             y = glm::cross(x, z);
  std::vector<Traced> rows(size / 4);
  const double start = now();
  parallelFor(size / 4, [&](std::size_t block) {
    Traced& row = rows[block];
    for (int column = 0; column < size; column += 4) {
      std::array<Ray, 16> rays;
      std::array<const Ray*, 16> pointers;
      std::array<Hit, 16> hits;
      for (int i = 0; i < 16; ++i) {
        const float px = (static_cast<float>(column + i % 4) + 0.5F) / size - 0.5F,
                    py = (static_cast<float>(4 * block + i / 4) + 0.5F) / size - 0.5F;
        rays[i] = {eye, 0, glm::normalize(z + 0.8F * (px * x + py * y))};
        pointers[i] = &rays[i];
      }
      tree.intersect(pointers, hits);
      std::array<Ray, 16> shadows;
      std::size_t n = 0;
      for (int i = 0; i < 16; ++i) {
        if (!hits[i].found()) continue;
        const Cell& cell = shape.cells().cells()[hits[i].primitive];
        const DPoint3 p = ObjectRay{rays[i].o, rays[i].d}.at(hits[i].t);
        const FieldSample s = field.sample(p, shape.cells().atoms(cell));
        const Vec3 normal(-s.gradient / glm::length(s.gradient));
        const Point3 o = Point3(p) + 1e-4F * normal;
        shadows[n++] = {o, 0, light - o, 1};
      }
      row.hits += n;
      row.rays += 16 + n;
      if (n > 0) row.lit += n - std::popcount(tree.occluded(std::span(shadows).first(n)));
    }
  });
  Traced all{now() - start};
  for (const Traced& row : rows) all.rays += row.rays, all.hits += row.hits, all.lit += row.lit;
  return all;
}

void run(std::size_t atoms, int threads) {
  const int n = static_cast<int>(std::lround(std::cbrt(static_cast<double>(atoms))));
  const Field field = jitteredGrid(n);
  const double before = pbrt::bench::residentBytes() / 1e6, start = now();
  const bench::CellShape shape(field);
  const double cells = now();
  const AccelDevice device(threads);
  Accel tree(device);
  tree.add(shape, Transform());
  tree.build();
  const double built = now(), after = pbrt::bench::residentBytes() / 1e6;
  std::vector<Traced> runs;
  for (int i = 0; i < 3; ++i) runs.push_back(trace(tree, field, shape, static_cast<float>(n)));
  std::ranges::sort(runs, {}, &Traced::seconds);
  const Traced& t = runs[1];
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("| %zu | %zu | %.1f | %.3f | %.3f | %.0f | %.0f | %.3f | %.2f | %zu | %zu |\n",
              field.atoms().size(), shape.cells().cells().size(), shape.atomsPerCell(),
              cells - start, built - cells, after - before,
              static_cast<double>(usage.ru_maxrss) / 1e3, t.seconds,
              static_cast<double>(t.rays) / t.seconds / 1e6, t.hits, t.lit);
  std::fflush(stdout);
}

}  // namespace
}  // namespace pbrt::metaballs

int main(int argc, char** argv) {
  const int threads = argc > 1 ? std::atoi(argv[1]) : 2;
  const pbrt::ThreadLimit limit(threads);
  std::printf(
      "| atoms | cells | atoms a cell | cells s | tree s | MB | peak MB | trace s | Mrays/s | hits "
      "| lit |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  if (argc > 2)
    for (int i = 2; i < argc; ++i)
      pbrt::metaballs::run(static_cast<std::size_t>(std::atof(argv[i])), threads);
  else
    for (const double atoms : {1e2, 1e3, 1e4, 1e5, 1e6})
      pbrt::metaballs::run(static_cast<std::size_t>(atoms), threads);
}
