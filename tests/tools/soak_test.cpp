// One render, killed at a hundred random moments.

#include <fmt/format.h>

#include <numeric>
#include <random>

#include "core/scene/film_file.h"
#include "tests/tools/foggy_scene.h"
#include "tests/tools/running.h"
#include "tests/tools/same_picture.h"

namespace pbrt::test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

// Of all tiles together. None if there is no such file.
std::uint64_t samplesIn(const fs::path& film) {
  if (!fs::exists(film)) return 0;
  constexpr std::size_t kTiles = 6;
  const FilmInfo info = FilmReader(film).info();
  if (!info.interrupted()) return kTiles * info.endSample;
  EXPECT_EQ(info.reached.size(), kTiles);
  return std::accumulate(info.reached.begin(), info.reached.end(), 0ULL);
}

TEST(Soak, AHundredTimesKilledItIsTheSamePicture) {
  constexpr int kKills = 100;
  const std::string line =
      "--quiet --spp 200 --aov variance,albedo,normal,depth,position,samples,uv,shape scene.pbrt ";
  const unsigned seed = std::random_device()();
  SCOPED_TRACE(fmt::format("seed {}", seed));
  fmt::print("seed {}\n", seed);
  std::mt19937 random(seed);
  const auto upTo = [&](double most) { return std::uniform_real_distribution(0.0, most)(random); };
  const auto oneOf = [&](int n) { return std::uniform_int_distribution(0, n - 1)(random); };

  Folder folder;
  folder.write("scene.pbrt", foggyScene());
  const auto begin = Clock::now();
  ASSERT_EQ(folder.pbrt(line + "--outfile once.exr").code, 0);
  const Seconds undisturbed = Clock::now() - begin;
  const Image once = readExr(folder.path() / "once.exr");

  // So that a render is ended about as often as it is to be.
  const double longest = undisturbed.count() * 2 / kKills;
  std::uint64_t saved = 0;  // samples in the checkpoint
  int kills = 0, killed = 0, stopped = 0, done = 0;
  while (kills < kKills || done == 0) {
    Running render(folder, line + fmt::format("--nthreads {} --checkpoint c.film --resume "
                                              "--checkpoint-every 100ms --outfile out.exr",
                                              1 + oneOf(4)));
    if (kills < kKills) {
      if (oneOf(5) > 0) render.untilItHandles(SIGTERM);
      const double timed = oneOf(10) == 0 ? 0.1 : 0;  // so that the time for a checkpoint comes
      std::this_thread::sleep_for(Seconds(timed + upTo(longest)));
      for (int i = oneOf(3); i > 0; --i) {
        render.untilItHandles(SIGUSR1).send(SIGUSR1);
        std::this_thread::sleep_for(Seconds(upTo(0.01)));
      }
      render.send(oneOf(2) ? SIGKILL : SIGTERM);
      ++kills;
    }
    const Outcome outcome = render.end();
    if (outcome.code == 0) {
      ++done;
      expectSamePicture(once, readExr(folder.path() / "out.exr"));
      fs::remove(folder.path() / "c.film");
      saved = 0;
    } else {
      ++(outcome.code == 75 ? stopped : killed);
      const bool asAsked = outcome.code == 75 || outcome.code == 128 + SIGKILL ||
                           outcome.code == 128 + SIGTERM;  // while the scene was read
      ASSERT_TRUE(asAsked) << outcome.code << outcome.err;
    }
    const std::uint64_t before = std::exchange(saved, samplesIn(folder.path() / "c.film"));
    EXPECT_GE(saved, before) << "samples were lost";
    for (const auto& entry : fs::directory_iterator(folder.path())) {
      const std::string name = entry.path().filename();
      EXPECT_TRUE(name == "scene.pbrt" || name == "once.exr" || name == "out.exr" ||
                  name == "c.film" || name == "out" || name == "err")
          << name << " was left behind";
    }
    if (testing::Test::HasFailure()) return;
  }
  fmt::print("{} killed, {} stopped, {} done; {:.1f} s\n", killed, stopped, done,
             Seconds(Clock::now() - begin).count());
  EXPECT_GT(killed, 0);
  EXPECT_GT(stopped, 0);
}

}  // namespace
}  // namespace pbrt::test
