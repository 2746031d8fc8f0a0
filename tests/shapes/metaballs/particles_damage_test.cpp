// Damaged files, thousands of them: each is an Error that names the file, or particles as good as
// any. Nothing else may happen, and no more memory be taken than a file of that length can fill.

#include "tests/shapes/metaballs/particle_files.h"

namespace pbrt {
namespace {

// One to four faults: bytes changed, cut out, doubled or put in; numbers made large; the end lost.
std::string damaged(std::string bytes, Rng& rng) {
  const auto below = [&](std::size_t n) {
    return std::min(n - 1, static_cast<std::size_t>(rng.uniform() * static_cast<float>(n)));
  };
  for (std::size_t faults = 1 + below(4); faults > 0 && !bytes.empty(); --faults) {
    // Headers are short, but most there is to go wrong is in them.
    const std::size_t at =
        below(rng.uniform() < 0.5F ? bytes.size() : std::min<std::size_t>(bytes.size(), 600));
    const std::size_t length = std::min(bytes.size() - at, 1 + below(12));
    static constexpr std::string_view kInserts[] = {"-1",
                                                    "0",
                                                    "4294967295",
                                                    "18446744073709551615",
                                                    "1e300",
                                                    "nan",
                                                    "\n",
                                                    " ",
                                                    "\"",
                                                    "#",
                                                    ",",
                                                    "\xFF\xFF\xFF\xFF",
                                                    "\x7F\xFF\xFF\xFF",
                                                    "list uchar ",
                                                    "property float x\n",
                                                    "METADATA\n"};
    switch (below(6)) {
      case 0:
        bytes[at] = static_cast<char>(below(256));
        break;
      case 1:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
        break;
      case 2:
        bytes.erase(at, length);
        break;
      case 3:
        bytes.insert(at, bytes.substr(at, length));
        break;
      case 4:
        bytes.insert(at, kInserts[below(std::size(kInserts))]);
        break;
      default:
        if (rng.uniform() < 0.3F)
          bytes.resize(at);
        else
          for (std::size_t i = at; i < at + length; ++i)
            if (bytes[i] >= '0' && bytes[i] <= '9') bytes[i] = '9';
    }
  }
  return bytes;
}

void expectWhole(const Particles& p, std::size_t bytes) {
  const std::size_t n = p.positions.size();
  ASSERT_GT(n, 0U);
  ASSERT_LE(6 * n, bytes + 6);  // three digits, each with a separator
  for (const std::size_t size :
       {p.radii.size(), p.colors.size(), p.velocities.size(), p.strengths.size()})
    ASSERT_TRUE(size == 0 || size == n);
  for (const Point3& x : p.positions) ASSERT_TRUE(isFinite(x));
}

struct Sample {
  const char* name;
  std::string bytes;
};

class Damage : public ::testing::TestWithParam<Sample> {};

TEST_P(Damage, IsAnErrorOrHarmless) {
  const auto& [name, bytes] = GetParam();
  Rng rng(std::hash<std::string_view>{}(bytes));
  int refused = 0;
  constexpr int kFiles = 3000;
  for (int i = 0; i < kFiles; ++i) {
    const std::string file = damaged(bytes, rng);
    try {
      ASSERT_NO_FATAL_FAILURE(expectWhole(readParticles(name, file), file.size()));
    } catch (const Error& error) {
      ++refused;
      const std::string what = error.what();
      ASSERT_TRUE(what.starts_with("error: a.") || what.starts_with("a.")) << what;
    }
  }
  EXPECT_GT(refused, kFiles / 10);
  EXPECT_LT(refused, kFiles);
}

std::vector<Sample> samples() {
  const Particles p = test::someParticles(12);
  return {{"a.ply", test::plyText(p, false)},
          {"a.ply", test::plyText(p)},
          {"a.ply", test::plyBinary(p, std::endian::little)},
          {"a.ply", test::plyBinary(p, std::endian::big, false)},
          {"a.vtk", test::vtk(p, false)},
          {"a.vtk", test::vtk(p, true)},
          {"a.vtk", test::vtk(p, true, 5)},
          {"a.csv", test::csv(p)},
          {"a.txt", "1 2 3 4 0.5 0.25 0\n5 6 7 8 0 1 0.5\n"},
          {"a.xyz", test::raw(p)},
          {"a.bgeo", test::bgeo(p)}};
}

INSTANTIATE_TEST_SUITE_P(ParticleFiles, Damage, ::testing::ValuesIn(samples()),
                         [](const auto& sample) {
                           return fmt::format("{}{}", sample.param.name + 2, sample.index);
                         });

}  // namespace
}  // namespace pbrt
