// Metaballs traced as they are beside triangles of the same field: what a picture of 512 x 512 rays
// costs and how far off it is. Prints a table, and writes it to metaballs_triangles.csv in the
// build folder for plot.py.
//
// Both sides use the same ray tree and the same rays; seconds are of the processor, all threads
// together. Errors of triangles are differences from the metaballs' own hits on every ray; those of
// the metaballs from the oracle's on kChecked rays. A distance is along the ray, over h. A picture
// is taken by single rays and by packets; the total counts the cheaper.
//
//   metaballs_triangles [most triangles, in millions (8)] [most atoms (100000)]

#include <fmt/ostream.h>

#include "tests/bench/marching_cubes.h"
#include "tests/bench/measure.h"
#include "tests/bench/metaballs_view.h"
#include "tests/shapes/metaballs/oracle.h"

namespace pbrt::metaballs::bench {
namespace {

using namespace pbrt::bench;

constexpr int kResolution = 512;
constexpr std::size_t kChecked = 5000;

// Where a ray meets a surface, for comparison.
struct Seen {
  double t = 0;
  DVec3 n{};
};
using Picture = std::vector<std::optional<Seen>>;

struct Errors {
  std::vector<double> distance, degrees;  // sorted
  std::size_t oneOnly = 0;                // rays that meet one of the surfaces alone

  void compare(const std::optional<Seen>& seen, double tError, const std::optional<DVec3>& n) {
    if (seen.has_value() != n.has_value()) ++oneOnly;
    if (!seen || !n) return;
    distance.push_back(tError);
    // The arc cosine of a product near one would lose half the digits.
    const double angle = std::atan2(glm::length(glm::cross(seen->n, *n)), glm::dot(seen->n, *n));
    degrees.push_back(angle * 180 / std::numbers::pi);
  }
  void sort() {
    std::ranges::sort(distance);
    std::ranges::sort(degrees);
  }
};

struct Cost {
  double make = 0, tree = 0;      // s
  double single = 0, packet = 0;  // s a picture
  double bytes = 0;
  double total() const { return make + tree + std::min(single, packet); }
};

std::vector<Hit> trace(const Accel& tree, const std::vector<Ray>& rays, Cost& cost) {
  std::vector<Hit> hits(rays.size());
  std::vector<const Ray*> pointers;
  for (const Ray& ray : rays) pointers.push_back(&ray);
  cost.packet = fastest([&] {
    for (std::size_t i = 0; i < rays.size(); i += World::kBatch)
      tree.intersect(std::span(pointers).subspan(i, World::kBatch),
                     std::span(hits).subspan(i, World::kBatch));
  });
  cost.single = fastest([&] {
    for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = tree.intersect(rays[i]);
  });
  return hits;
}

class Report {
 public:
  Report() : csv_(PBRT_BUILD_DIR "/metaballs_triangles.csv") {
    fmt::print(csv_,
               "atoms,surface,primitives,bytes,make,tree,single,packet,total,distance_mean,"
               "distance_99,distance_max,degrees_mean,degrees_99,one_only,rays\n");
  }
  void set(const Set& set, std::size_t hits) {
    name_ = set.name;
    fmt::print("\n{} atoms; {} of {} rays hit\n\n", name_, hits, sqr(kResolution));
    fmt::print(
        "| surface | primitives | MB | make s | tree s | ns a ray, single | packets | total s "
        "| distance/h mean | 99 % | max | normal deg mean | 99 % | in one only |\n"
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- "
        "|\n");
  }
  void row(const std::string& surface, std::size_t primitives, const Cost& c, Errors& e,
           std::size_t rays) {
    e.sort();
    const double nanoseconds = 1e9 / sqr(kResolution);
    fmt::print(
        "| {} | {} | {:.1f} | {:.3g} | {:.3g} | {:.0f} | {:.0f} | {:.3g} | {:.2g} | {:.2g} | "
        "{:.2g} | {:.2g} | {:.2g} | {} of {} |\n",
        surface, primitives, c.bytes / 1e6, c.make, c.tree, nanoseconds * c.single,
        nanoseconds * c.packet, c.total(), mean(e.distance), quantile(e.distance, 0.99),
        quantile(e.distance, 1), mean(e.degrees), quantile(e.degrees, 0.99), e.oneOnly, rays);
    fmt::print(csv_, "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", name_, surface,
               primitives, c.bytes, c.make, c.tree, c.single, c.packet, c.total(), mean(e.distance),
               quantile(e.distance, 0.99), quantile(e.distance, 1), mean(e.degrees),
               quantile(e.degrees, 0.99), e.oneOnly, rays);
    std::fflush(stdout);
    csv_.flush();
  }

 private:
  std::ofstream csv_;
  std::string name_;
};

Picture metaballs(const Set& set, const std::vector<Ray>& rays, Report& report) {
  Cost cost;
  const double before = residentBytes();
  double start = cpuSeconds();
  const CellShape shape(set.field);
  cost.make = cpuSeconds() - start;
  const AccelDevice device(1);
  Accel tree(device);
  start = cpuSeconds();
  tree.add(shape, Transform());
  tree.build();
  cost.tree = cpuSeconds() - start;
  cost.bytes = residentBytes() - before;

  const std::vector<Hit> hits = trace(tree, rays, cost);
  Picture picture(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!hits[i].found()) continue;
    // The hit rounds t to a float.
    const ObjectRay ray = inDouble(rays[i]);
    const auto t = shape.crossing(ray, hits[i].primitive);
    const AtomList list = shape.cells().atoms(shape.cells().cells()[hits[i].primitive]);
    picture[i] = {*t, -glm::normalize(set.field.sample(ray.at(*t), list).gradient)};
  }

  Errors errors;
  const test::Blocks blocks(set.field);
  for (std::size_t k = 0; k < kChecked; ++k) {
    const std::size_t i = (2 * k + 1) * rays.size() / (2 * kChecked);
    test::Oracle oracle(blocks, inDouble(rays[i]));
    std::optional<DVec3> n;
    double apart = 0;
    if (const auto root = oracle.first()) {
      n = -glm::normalize(oracle.gradient(static_cast<double>(root->t)));
      if (picture[i]) apart = static_cast<double>(test::abs(picture[i]->t - root->t));
    }
    errors.compare(picture[i], apart / set.h, n);
  }
  report.set(set, static_cast<std::size_t>(std::ranges::count_if(
                      picture, [](const auto& seen) { return seen.has_value(); })));
  report.row("metaballs", shape.primitives(), cost, errors, kChecked);
  return picture;
}

// Returns the number of triangles.
std::size_t triangles(const Set& set, int voxels, const std::vector<Ray>& rays,
                      const Picture& exact, Report& report) {
  Cost cost;
  const double before = residentBytes();
  double start = cpuSeconds();
  TriangleMesh mesh = Mesher(set.field, set.h / voxels).mesh();
  cost.make = cpuSeconds() - start;
  const AccelDevice device(1);
  Accel tree(device);
  start = cpuSeconds();
  tree.add(mesh);
  tree.build();
  cost.tree = cpuSeconds() - start;
  cost.bytes = residentBytes() - before;

  Errors errors;
  const std::vector<Hit> hits = trace(tree, rays, cost);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    std::optional<DVec3> n;
    if (const Hit& hit = hits[i]; hit.found()) {
      const auto normal = [&](int k) {
        return DVec3(mesh.normals[mesh.indices[3 * hit.primitive + k]]);
      };
      const double u = hit.u, v = hit.v;
      n = glm::normalize((1 - u - v) * normal(0) + u * normal(1) + v * normal(2));
    }
    errors.compare(exact[i], n && exact[i] ? std::abs(hits[i].t - exact[i]->t) / set.h : 0, n);
  }
  report.row(fmt::format("triangles h/{}", voxels), mesh.triangles(), cost, errors, rays.size());
  return mesh.triangles();
}

void run(double mostTriangles, int mostAtoms) {
  Report report;
  for (const int atoms : {12, 300, 10000, 100000}) {
    if (atoms > mostAtoms) break;
    const Set set = atoms < 1000 ? ball(atoms) : fluid(atoms);
    const std::vector<Ray> rays = cameraRays(set.field, kResolution);
    const Picture exact = metaballs(set, rays, report);
    // Halving the voxel makes four times as many triangles.
    double expected = 0;
    for (int voxels = 2; expected < mostTriangles; voxels *= 2)
      expected = 4.0 * static_cast<double>(triangles(set, voxels, rays, exact, report));
  }
}

}  // namespace
}  // namespace pbrt::metaballs::bench

int main(int count, char** arguments) {
  pbrt::metaballs::bench::run(1e6 * (count > 1 ? std::atof(arguments[1]) : 8),
                              count > 2 ? std::atoi(arguments[2]) : 100000);
}
