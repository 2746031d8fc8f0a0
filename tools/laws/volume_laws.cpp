// The laws of every volume: what it says of itself.

#include "volume_laws.h"

#include "awry.h"
#include "core/api/medium_walk.h"
#include "laws.h"
#include "show.h"
#include "steady.h"
#include "tally.h"

namespace pbrt::laws {
namespace {

struct VolumeQuestions {
  static constexpr int count = 500;

  explicit VolumeQuestions(const Subject& subject) : placed(subject) {}

  DPoint3 place(int i) const {
    Rng rng(static_cast<std::uint64_t>(i));
    return placed.point(1.4 * DPoint3(rng.uniform(), rng.uniform(), rng.uniform()) - 0.2);
  }
  std::string about(int i) const { return "the medium at " + show(Vec3(place(i))); }
  std::array<float, 9> ask(int i) const {
    const MediumPoint m = placed.medium->at(place(i));
    std::array<float, 9> answer{};
    for (int c = 0; c < 3; ++c) {
      answer[c] = m.absorption[c];
      answer[3 + c] = m.scattering[c];
      answer[6 + c] = m.emission[c];
    }
    return answer;
  }

  PlacedMedium placed;
};

void isWellFormedInItsBox(const Subject& subject, Judge& judge) {
  const PlacedMedium placed(subject);
  const Medium& medium = *placed.medium;
  judge.expect(std::abs(medium.g()) < 1, "g() is {}: a mean cosine is between -1 and 1",
               medium.g());
  Rng rng(1);
  int some = 0;
  for (int i = 0; i < 4000; ++i) {
    const double reach = i % 2 ? 1 : 3;
    const DPoint3 q = reach * (DPoint3(rng.uniform(), rng.uniform(), rng.uniform()) - 0.5) + 0.5;
    const bool within = glm::all(glm::lessThan(q, DPoint3(1 - 1e-9))) &&
                        glm::all(glm::greaterThan(q, DPoint3(1e-9)));
    const MediumPoint m = medium.at(placed.point(q));
    for (const auto& [what, s] :
         {std::pair("absorption", m.absorption), std::pair("scattering", m.scattering),
          std::pair("emission", m.emission)})
      judge.expect(isFinite(s) && s.x >= 0 && s.y >= 0 && s.z >= 0, "at {} its {} is {}",
                   show(Vec3(placed.point(q))), what, show(s));
    if (!within && medium.bounded())
      judge.expect(isBlack(m.extinction()) && isBlack(m.emission),
                   "at {}, outside of its box, its extinction is {}, its emission {}",
                   show(Vec3(placed.point(q))), show(m.extinction()), show(m.emission));
    some += isBlack(m.extinction()) && isBlack(m.emission) ? 0 : 1;
  }
  judge.expect(some > 40, "of 4000 points in and about its box there is something at only {}",
               some);
}

// A medium that forgets Setup::toRender, or puts it where it does not belong. Edges may fall on
// either side by rounding.
void movesWithItsSpace(const Subject& subject, Judge& judge) {
  const PlacedMedium at(subject, {}), moved(subject, awry());
  Rng rng(3);
  Tally tally;
  const auto near = [](const Spectrum& a, const Spectrum& b) {
    return glm::length(a - b) <= 1e-3F * std::max(glm::length(a), glm::length(b));
  };
  for (int i = 0; i < 2000; ++i) {
    const DPoint3 p = at.point(1.2 * DPoint3(rng.uniform(), rng.uniform(), rng.uniform()) - 0.1);
    const DPoint3 there = moved.place.point(p);
    const MediumPoint m = at.medium->at(p), real = moved.medium->at(there);
    tally.expect(near(m.absorption, real.absorption) && near(m.scattering, real.scattering) &&
                     near(m.emission, real.emission),
                 "at {} the extinction is {} and the emission {}, but where toRender takes this to "
                 "{} they are {} and {}",
                 show(Vec3(p)), show(m.extinction()), show(m.emission), show(Vec3(there)),
                 show(real.extinction()), show(real.emission));
  }
  tally.judge(judge, tally.tried() / 100);
}

// The steps of a walk along one way.
void stretchesHold(const PlacedMedium& placed, const Way& way, Rng& rng, Judge& judge,
                   int& stretches) {
  const Medium& medium = *placed.medium;
  const auto box = medium.clip(way.o, way.w, {0, way.length});
  MediumWalk walk(medium, way.o, way.w, {0, way.length});
  double end = box ? box->begin : 0;
  while (walk.next()) {
    const Stretch& s = walk.stretch();
    if (!judge.expect(box && s.begin == end && s.end >= s.begin,
                      "{}: a stretch goes from {} to {}, the one before ended at {}", show(way),
                      s.begin, s.end, end))
      return;
    end = s.end;
    ++stretches;
    const MediumPoint middle = medium.inside(way.at(s.middle()));
    for (int k = 0; k < 5; ++k) {
      const DPoint3 p = way.at(s.begin + rng.uniform() * s.length());
      const MediumPoint m = medium.inside(p);
      const Spectrum e = m.extinction(), is = middle.extinction();
      for (int c = 0; c < 3; ++c) {
        judge.expect(e[c] <= s.majorant[c] * (1 + 1e-5F),
                     "at {} the extinction is {}, more than the majorant {} of its cell",
                     show(Vec3(p)), show(e), show(s.majorant));
        judge.expect(
            !s.uniform || (std::abs(e[c] - is[c]) <= 1e-5F * e[c] &&
                           std::abs(m.emission[c] - middle.emission[c]) <= 1e-5F * m.emission[c]),
            "at {} the extinction is {} and the emission {}, at {} they are {} and {}, in "
            "one cell that says it is uniform",
            show(Vec3(p)), show(e), show(m.emission), show(Vec3(way.at(s.middle()))), show(is),
            show(middle.emission));
      }
      judge.expect(!isBlack(s.majorant) || isBlack(m.emission),
                   "at {} it glows ({}) in a cell whose majorant says that it is empty",
                   show(Vec3(p)), show(m.emission));
    }
  }
  const double last = box ? box->end : 0;
  judge.expect(end == last, "{}: the stretches end at {}, the box at {}", show(way), end, last);
}

void cellsBoundTheMedium(const Subject& subject, Judge& judge) {
  const PlacedMedium placed(subject);
  Rng rng(2);
  int stretches = 0;
  for (int i = 0; i < 500; ++i) {
    Way way = somewhere(placed, rng);
    if (i % 3 == 0) way.w = glm::normalize(placed.place.vector(DVec3(i % 2, 1 - i % 2, 0)));
    stretchesHold(placed, way, rng, judge, stretches);
  }
  judge.expect(stretches > 200, "500 ways through its box meet only {} stretches", stretches);
}

constexpr std::array<Law, 5> kLaws = {{
    {"well-formed", "coefficients are finite and not negative, and nothing is outside of the box",
     isWellFormedInItsBox},
    {"moves-with-its-space", "toRender takes what is in it wherever the volume is put",
     movesWithItsSpace},
    {"cells-bound-the-medium", "nowhere is the extinction above the majorant of the cell",
     cellsBoundTheMedium},
    {"estimates-agree-with-quadrature",
     "random walks find the transmittance, scattering and emission that quadrature finds",
     estimatesAgreeWithQuadrature},
    {"transmittance-multiplies", "that of two media, or of two parts of a way, is the product",
     transmittanceMultiplies},
}};

}  // namespace

std::span<const Law> volumeLaws() {
  static const auto laws = withSteady<VolumeQuestions>(kLaws);
  return laws;
}

}  // namespace pbrt::laws
