// Laws for every medium that can be found.

#include "core/api/tracking.h"
#include "tests/mean.h"
#include "tests/volumes/lines.h"

namespace pbrt::test {
namespace {

constexpr double kSigmas = 4.5;

const Transform kPlace = Transform::translate({0.3, -0.2, 0.5}) * Transform::rotate(50, {1, 2, 3}) *
                         Transform::scale({2, 1, -1.5});

// From about the box through some point of it.
Way somewhere(Rng& rng) {
  const DPoint3 through = kPlace.point({rng.uniform(), rng.uniform(), rng.uniform()});
  const DVec3 w(uniformSphere({rng.uniform(), rng.uniform()}));
  return {through - 2.0 * rng.uniform() * w, glm::normalize(w), 3};
}

template <class Check>
void forEveryMedium(Check check) {
  const auto media = everyMedium({kPlace});
  EXPECT_GE(media.size(), 9U);
  for (const auto& [name, medium] : media) {
    SCOPED_TRACE(name);
    check(*medium);
  }
}

TEST(MediumLaws, IsWellFormedAndEndsWithItsBox) {
  forEveryMedium([](const Medium& medium) {
    Rng rng(1);
    int some = 0;
    for (int i = 0; i < 2000; ++i) {
      const DPoint3 q = 3.0 * DPoint3(rng.uniform(), rng.uniform(), rng.uniform()) - 1.0;
      const bool within = glm::all(glm::lessThan(q, DPoint3(1 - 1e-9))) &&
                          glm::all(glm::greaterThan(q, DPoint3(1e-9)));
      const MediumPoint m = medium.at(kPlace.point(q));
      for (const Spectrum& s : {m.absorption, m.scattering, m.emission})
        for (int c = 0; c < 3; ++c) ASSERT_TRUE(s[c] >= 0 && std::isfinite(s[c]));
      if (!within) {
        ASSERT_EQ(m.extinction(), Spectrum(0));
      }
      some += isBlack(m.scattering) ? 0 : 1;
    }
    EXPECT_GT(some, 20);
    EXPECT_TRUE(medium.bounded());
  });
}

TEST(MediumLaws, StretchesCoverTheBoxAndBoundTheMedium) {
  forEveryMedium([](const Medium& medium) {
    Rng rng(2);
    int stretches = 0;
    for (int i = 0; i < 500; ++i) {
      Way way = somewhere(rng);
      if (i % 3 == 0) way.w = glm::normalize(kPlace.vector(DVec3(i % 2, 1 - i % 2, 0)));
      const auto box = medium.clip(way.o, way.w, {0, way.length});
      MediumWalk walk(medium, way.o, way.w, {0, way.length});
      double end = box ? box->begin : 0;
      while (walk.next()) {
        ASSERT_TRUE(box);
        const Stretch& s = walk.stretch();
        ASSERT_EQ(s.begin, end);
        ASSERT_GE(s.end, s.begin);
        end = s.end;
        ++stretches;
        const MediumPoint middle = medium.inside(way.o + s.middle() * way.w);
        for (int k = 0; k < 5; ++k) {
          const MediumPoint m =
              medium.inside(way.o + (s.begin + rng.uniform() * s.length()) * way.w);
          const Spectrum e = m.extinction();
          for (int c = 0; c < 3; ++c) {
            ASSERT_LE(e[c], s.majorant[c] * (1 + 1e-5F));
            if (s.uniform) {
              ASSERT_NEAR(e[c], middle.extinction()[c], 1e-5F * e[c]);
              ASSERT_NEAR(m.emission[c], middle.emission[c], 1e-5F * m.emission[c]);
            }
          }
          if (isBlack(s.majorant)) {
            ASSERT_TRUE(isBlack(m.emission));
          }
        }
      }
      ASSERT_EQ(end, box ? box->end : 0);
    }
    EXPECT_GT(stretches, 200);
  });
}

void expectMean(const Mean& mean, double expected, const char* what) {
  EXPECT_NEAR(mean.mean(), expected, kSigmas * std::sqrt(mean.variance()) + 2e-4 * expected + 1e-6)
      << what;
}

TEST(MediumLaws, EstimatesAgreeWithQuadrature) {
  forEveryMedium([](const Medium& medium) {
    Rng rng(3);
    MediumWalk room;
    MediaWalk walk({&room, 1});
    for (int k = 0; k < 4; ++k) {
      const Way way = somewhere(rng);
      const Theory expected = theory(medium, way);
      std::array<Mean, 3> through, ratio, scattered, emitted;
      for (int i = 0; i < 5000; ++i) {
        walk.start(&medium, {}, way.o, way.w, {0, way.length});
        const Spectrum T = estimateTransmittance(walk, rng);
        walk.start(&medium, {}, way.o, way.w, {0, way.length});
        Spectrum throughput(1), L(0);
        const bool collided = collide(walk, rng.uniform(), rng, throughput, L).has_value();
        for (int c = 0; c < 3; ++c) {
          ASSERT_TRUE(T[c] >= 0 && T[c] <= 1);
          ASSERT_TRUE(throughput[c] >= 0 && std::isfinite(throughput[c]));
          ratio[c].add(T[c]);
          through[c].add(collided ? 0 : throughput[c]);
          scattered[c].add(collided ? throughput[c] : 0);
          emitted[c].add(L[c]);
        }
      }
      for (int c = 0; c < 3; ++c) {
        SCOPED_TRACE(c);
        expectMean(ratio[c], expected.transmittance[c], "transmittance");
        expectMean(through[c], expected.transmittance[c], "what comes through");
        expectMean(scattered[c], expected.scattered[c], "what is scattered");
        expectMean(emitted[c], expected.emitted[c], "what is emitted");
      }
    }
  });
}

// Of two media in one place, and of the parts of a way.
TEST(MediumLaws, TransmittanceMultiplies) {
  const auto others = everyMedium({Transform::translate({0.5, 0.2, 0.4})});
  std::size_t next = 0;
  forEveryMedium([&](const Medium& medium) {
    const Medium& other = *others[next++ % others.size()].medium;
    const std::array<const Medium*, 2> regions = {&medium, &other};
    Rng rng(4);
    std::array<MediumWalk, 3> room;
    MediaWalk walk(room);
    for (int k = 0; k < 3; ++k) {
      const Way way = somewhere(rng);
      const double cut = 3 * rng.uniform();
      const DVec3 expected = theory(medium, way).transmittance * theory(other, way).transmittance;
      std::array<Mean, 3> whole, parts, through;
      for (int i = 0; i < 5000; ++i) {
        const auto T = [&](double begin, double end) {
          walk.start(nullptr, regions, way.o, way.w, {begin, end});
          return estimateTransmittance(walk, rng);
        };
        const Spectrum a = T(0, way.length), b = T(0, cut) * T(cut, way.length);
        walk.start(nullptr, regions, way.o, way.w, {0, way.length});
        Spectrum throughput(1), L(0);
        const bool collided = collide(walk, rng.uniform(), rng, throughput, L).has_value();
        for (int c = 0; c < 3; ++c) {
          whole[c].add(a[c]);
          parts[c].add(b[c]);
          through[c].add(collided ? 0 : throughput[c]);
        }
      }
      for (int c = 0; c < 3; ++c) {
        SCOPED_TRACE(c);
        expectMean(whole[c], expected[c], "whole");
        expectMean(parts[c], expected[c], "parts");
        expectMean(through[c], expected[c], "through");
      }
    }
  });
}

}  // namespace
}  // namespace pbrt::test
