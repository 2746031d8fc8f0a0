// The three ways to show a moving fluid side by side: ray traced, as triangles of marching cubes,
// and as points that follow the surface (the comparison of van Kooten, van den Bergen and Telea
// 2007), from the same camera rays over the same frames. Prints a table for each motion, and
// writes it to three_ways.csv, and a picture of the three to three-ways.png, in the build folder.
//
// Times are means over all frames but the first, in which points settle, of all threads (wall) and
// of the processor (CPU: all threads together; triangles are made by one thread). Every kJudged-th
// frame is held against the ray traced hits, and some of these against the oracle: distances along
// the ray over h, the atoms' usual radius, and angles of the normals. The silhouette's error is the
// area that only one of two pictures covers over the silhouette's length, in pixels; holes are
// among pixels well inside.
//
//   three_ways [frames (60)] [pixels along each side (512)] [motion...]

#include <fmt/ostream.h>

#include <algorithm>
#include <chrono>
#include <functional>

#include "tests/bench/measure.h"
#include "tests/bench/ways.h"
#include "tests/bench/ways_picture.h"
#include "tests/shapes/metaballs/oracle.h"
#include "tests/shapes/metaballs/surfels/uniform_places.h"

namespace pbrt::bench {
namespace {

constexpr int kJudged = 5;
constexpr std::size_t kChecked = 400, kPlaces = 2000;

struct Seconds {
  double wall = 0, cpu = 0;

  void add(const std::function<void()>& run) {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    const double cpuStart = cpuSeconds();
    run();
    cpu += cpuSeconds() - cpuStart;
    wall += std::chrono::duration<double>(Clock::now() - start).count();
  }
};

struct Row {
  std::unique_ptr<Way> way;
  Seconds set, draw;
  Errors errors;
  double covered = 0, leastCovered = 1;  // of points
};

// Some of the ray traced hits against the proven ones.
void judgeRayTraced(const metaballs::Field& field, const View& view, const Picture& picture,
                    double h, Errors& errors) {
  const metaballs::test::Blocks blocks(field);
  constexpr std::size_t perBlock = sqr(View::kBlock);
  const std::size_t all = view.blocks() * perBlock;
  for (std::size_t k = 0; k < kChecked; ++k) {
    const std::size_t i = (2 * k + 1) * all / (2 * kChecked), block = i / perBlock;
    const auto inBlock = static_cast<int>(i % perBlock);
    const ObjectRay ray = metaballs::bench::inDouble(view.rays(block)[inBlock]);
    metaballs::test::Oracle oracle(blocks, ray);
    Seen exact;
    if (const auto root = oracle.first()) {
      exact.t = static_cast<double>(root->t);
      exact.n = -glm::normalize(oracle.gradient(exact.t));
    }
    const Point2i p = view.pixel(block, inBlock);
    errors.add(exact, picture.at(p.x, p.y), h);
  }
}

double usualRadius(const Fluid& fluid) {
  std::vector<double> radii;
  for (const metaballs::Atom& atom : fluid.atoms) radii.push_back(atom.radius);
  std::ranges::sort(radii);
  return quantile(radii, 0.5);
}

class Report {
 public:
  Report() : csv_(PBRT_BUILD_DIR "/three_ways.csv") {
    fmt::print(csv_,
               "motion,way,primitives,build_wall_ms,build_cpu_ms,draw_wall_ms,draw_cpu_ms,"
               "distance_mean,distance_99,distance_max,degrees_mean,degrees_99,degrees_max,"
               "silhouette_pixels,edge_share,holes,inner,covered_mean,covered_least\n");
  }
  void motion(const std::string& name, int frames, const Fluid& fluid, int size) {
    name_ = name;
    frames_ = frames;
    fmt::print(
        "\n{}: {} atoms, {} frames, {} x {} pixels\n\n"
        "| way | primitives | build ms wall | CPU | draw ms wall | CPU | frames/s | distance/h "
        "mean | 99 % | max | normal deg mean | 99 % | max | silhouette px | of its pixels | holes "
        "| covered mean | least |\n"
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | "
        "--- | --- | --- | --- |\n",
        name, fluid.atoms.size(), frames, size, size);
  }
  void row(Row& r) {
    Errors& e = r.errors;
    std::ranges::sort(e.distance);
    std::ranges::sort(e.degrees);
    const double ms = 1e3 / frames_, judged = (frames_ + kJudged - 1) / kJudged;
    const double apart = static_cast<double>(e.oneOnly) / std::max(1.0, e.silhouette);
    const double share =
        static_cast<double>(e.oneOnly) / static_cast<double>(std::max<std::size_t>(1, e.edge));
    const bool points = !r.way->surfels().empty();
    fmt::print(
        "| {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.1f} | {:.2g} | {:.2g} | {:.2g} "
        "| {:.2g} | {:.2g} | {:.2g} | {:.3f} | {:.1f} % | {} of {} | {} | {} |\n",
        r.way->name(), r.way->primitives(), ms * r.set.wall, ms * r.set.cpu, ms * r.draw.wall,
        ms * r.draw.cpu, frames_ / (r.set.wall + r.draw.wall), mean(e.distance),
        quantile(e.distance, 0.99), quantile(e.distance, 1), mean(e.degrees),
        quantile(e.degrees, 0.99), quantile(e.degrees, 1), apart, 100 * share, e.holes, e.inner,
        points ? fmt::format("{:.2f} %", 100 * r.covered / judged) : "",
        points ? fmt::format("{:.2f} %", 100 * r.leastCovered) : "");
    fmt::print(csv_, "{},\"{}\",{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", name_,
               r.way->name(), r.way->primitives(), ms * r.set.wall, ms * r.set.cpu,
               ms * r.draw.wall, ms * r.draw.cpu, mean(e.distance), quantile(e.distance, 0.99),
               quantile(e.distance, 1), mean(e.degrees), quantile(e.degrees, 0.99),
               quantile(e.degrees, 1), apart, share, e.holes, e.inner, r.covered / judged,
               r.leastCovered);
    std::fflush(stdout);
    csv_.flush();
  }

 private:
  std::ofstream csv_;
  std::string name_;
  int frames_ = 1;
};

// The ray traced, the triangles that take about as long as the points, and the points.
void writePicture(std::span<Row> rows, const Bounds3& box) {
  const View view(box, 384);
  std::vector<Picture> pictures;
  for (const char* name : {"ray traced", "triangles, h/4", "16384 points"}) {
    const auto row = std::ranges::find(rows, name, [](const Row& r) { return r.way->name(); });
    row->way->draw(view, pictures.emplace_back(Picture{view.size()}));
  }
  writeSideBySide(PBRT_BUILD_DIR "/three-ways.png", pictures[0], pictures, 10);
}

void run(const std::string& name, int frames, int size, Report& report) {
  const auto motion = motion::makeMotion(name);
  Fluid fluid;
  motion->frame(motion->first(), fluid);
  const double h = usualRadius(fluid);
  const View view(motion->bounds(), size);
  std::vector<Row> rows;
  const auto add = [&](auto way) { rows.push_back({std::move(way), {}, {}, {}}); };
  add(std::make_unique<RayTraced>());
  for (const int divisions : {2, 4, 8, 16}) add(std::make_unique<Triangles>(h, divisions));
  for (const std::size_t count : {4096, 16384, 65536}) add(std::make_unique<Points>(count));
  for (const int steps : {1, 20}) add(std::make_unique<Points>(16384, steps));
  const auto& traced = static_cast<const RayTraced&>(*rows[0].way);

  report.motion(name, frames, fluid, size);
  Picture exact{size}, picture{size};
  for (Row& row : rows) row.way->set(fluid, 0);
  for (int i = 0; i < frames; ++i) {
    motion->frame(motion->first() + 1 + i, fluid);
    std::vector<surfels::Place> places;
    for (Row& row : rows) {
      row.set.add([&] { row.way->set(fluid, motion->dt()); });
      Picture& drawn = row.way.get() == &traced ? exact : picture;
      row.draw.add([&] { row.way->draw(view, drawn); });
      if (i % kJudged != 0) continue;
      if (row.way.get() == &traced) {
        judgeRayTraced(traced.field(), view, exact, h, row.errors);
        places = surfels::test::uniformPlaces(traced.field(), kPlaces);
        continue;
      }
      row.errors.add(exact, picture, h);
      const double covered = coverage(row.way->surfels(), places, 0).covered;
      row.covered += covered;
      row.leastCovered = std::min(row.leastCovered, covered);
    }
    if (name == "dam" && i == frames / 2) writePicture(rows, motion->bounds());
  }
  for (Row& row : rows) report.row(row);
}

}  // namespace
}  // namespace pbrt::bench

int main(int count, char** arguments) {
  using namespace pbrt;
  const int frames = count > 1 ? std::atoi(arguments[1]) : 60;
  const int size = count > 2 ? std::atoi(arguments[2]) : 512;
  std::vector<std::string> motions(arguments + std::min(count, 3), arguments + count);
  if (motions.empty()) motions = motion::motionNames();
  bench::Report report;
  for (const std::string& name : motions) bench::run(name, frames, size, report);
}
