// Metaballs against the oracle: random rays over ordinary and extreme sets of atoms, one line each.
// The exit code is 1 if a crossing was missed or invented, or if occlusion disagrees.
//
//   metaballs_oracle [--rays N] [--threads N] [--seed N] [--set PART-OF-A-NAME]

#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>

#include "tests/shapes/metaballs/sets.h"

namespace pbrt::metaballs::test {
namespace {

constexpr std::uint64_t kChunk = 256;  // rays with random numbers of their own

struct Failure {
  std::uint64_t chunk = 0, index = 0;
  ObjectRay ray;
};

struct Run {
  int threads = 1;
  std::uint64_t seed = 1;

  Tally operator()(const Set& set, Kernel kernel, std::uint64_t rays) const;
};

// The answer does not depend on the number of threads: every chunk has its own random numbers, and
// a tally only adds.
Tally Run::operator()(const Set& set, Kernel kernel, std::uint64_t rays) const {
  const Subject subject(set.field(kernel));
  const std::uint64_t chunks = (rays + kChunk - 1) / kChunk;
  std::atomic<std::uint64_t> next{0};
  std::mutex mutex;
  Tally total;
  std::vector<Failure> failures;
  const auto work = [&] {
    Tally mine;
    std::vector<Failure> failed;
    for (std::uint64_t chunk; (chunk = next++) < chunks;) {
      Random random(hash(seed, kernel, std::hash<std::string>()(set.name), chunk));
      for (std::uint64_t i = 0; i < std::min(kChunk, rays - chunk * kChunk); ++i) {
        const ObjectRay ray = set.ray(subject, random);
        if (!subject.judge(ray, mine)) failed.push_back({chunk, i, ray});
      }
    }
    const std::lock_guard lock(mutex);
    total.add(mine);
    failures.insert(failures.end(), failed.begin(), failed.end());
  };
  std::vector<std::thread> pool;
  for (int i = 0; i < threads; ++i) pool.emplace_back(work);
  for (std::thread& thread : pool) thread.join();

  std::ranges::sort(failures, {}, [](const Failure& f) { return std::pair(f.chunk, f.index); });
  for (const Failure& f : std::span(failures).first(std::min<std::size_t>(failures.size(), 4)))
    std::printf("  failed: %s, %s, seed %ju, ray %ju: %s\n", set.name.c_str(),
                std::string(kKernels[static_cast<std::size_t>(kernel)]).c_str(),
                std::uintmax_t{seed}, std::uintmax_t{f.chunk * kChunk + f.index},
                digits(f.ray).c_str());
  return total;
}

int run(int argc, char** argv) {
  std::uint64_t rays = 10'000'000;
  Run judged{static_cast<int>(std::max(1U, std::thread::hardware_concurrency()))};
  std::string part;
  CLI::App app("Holds the first crossings of rays and metaballs against a proven oracle.");
  app.add_option("--rays", rays, "rays in all")->capture_default_str();
  app.add_option("--threads", judged.threads, "threads")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app.add_option("--seed", judged.seed, "of the random rays")->capture_default_str();
  app.add_option("--set", part, "only sets whose name holds this");
  CLI11_PARSE(app, argc, argv);

  std::vector<Set> sets = ordinarySets();
  for (Set& set : extremeSets()) sets.push_back(std::move(set));
  std::erase_if(sets, [&](const Set& set) { return set.name.find(part) == std::string::npos; });
  double shares = 0;
  for (const Set& set : sets) shares += set.share;

  const auto start = std::chrono::steady_clock::now();
  Tally::printHeader();
  Tally all;
  for (const Set& set : sets) {
    Tally tally;
    for (const Kernel kernel : kAllKernels)
      tally.add(judged(set, kernel,
                       static_cast<std::uint64_t>(
                           std::ceil(static_cast<double>(rays) * set.share / shares / 4))));
    tally.print(set.name);
    all.add(tally);
  }
  all.print("all");
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  std::printf("%.1f s\n", time.count());
  return all.good() ? 0 : 1;
}

}  // namespace
}  // namespace pbrt::metaballs::test

int main(int argc, char** argv) {
  return pbrt::metaballs::test::run(argc, argv);
}
