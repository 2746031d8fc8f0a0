// The laws of every camera.

#include "camera_laws.h"

#include "awry.h"
#include "laws.h"
#include "show.h"
#include "steady.h"

namespace pbrt::laws {
namespace {

struct CameraQuestions {
  static constexpr int count = 300;

  explicit CameraQuestions(const Subject& subject) : camera(makeCamera(subject, place)) {}

  CameraSample sample(int i) const {
    Rng rng(static_cast<std::uint64_t>(i));
    return randomSample(rng, place.resolution);
  }
  std::string about(int i) const { return "the ray of " + show(sample(i), place); }
  std::array<float, 22> ask(int i) const {
    const auto [r, weight] = camera->generate(sample(i), true);
    std::array<float, 22> answer = {weight, r.tMin, r.tMax, r.time};
    auto next = answer.begin() + 4;
    for (const Vec3& v : {r.o, r.d, r.rxOrigin, r.ryOrigin, r.rxDirection, r.ryDirection})
      for (int c = 0; c < 3; ++c) *next++ = v[c];
    return answer;
  }

  Place place = places()[1];
  std::unique_ptr<Camera> camera;
};

void raysAreWellFormed(const Subject& subject, Judge& judge) {
  for (const Place& place : places()) {
    const auto camera = makeCamera(subject, place);
    Rng rng(6);
    for (int i = 0; i < 500; ++i) {
      CameraSample s = randomSample(rng, place.resolution);
      if (i % 3 == 0) s.film += Point2(2.5F, -2.5F);  // a filter reaches beyond the picture
      const auto [ray, weight] = camera->generate(s, true);
      const std::string at = show(s, place);
      judge.expect(weight >= 0 && std::isfinite(weight), "{}: the weight is {}", at, weight);
      if (weight == 0) continue;
      judge.expect(isFinite(ray.o), "{}: the ray begins at {}", at, show(ray.o));
      const double length = glm::length(DVec3(ray.d));
      judge.expect(std::abs(length - 1) <= 3e-7, "{}: the direction {} has length {}, not 1", at,
                   show(ray.d), length);
      judge.expect(ray.tMin >= 0 && ray.tMin < ray.tMax, "{}: the ray goes from t = {} to {}", at,
                   ray.tMin, ray.tMax);
      const auto [plain, plainWeight] = camera->generate(s, false);
      judge.expect(plain.o == ray.o && plain.d == ray.d && plainWeight == weight,
                   "{}: without differentials the ray is o {} d {} weight {}, with them o {} d {} "
                   "weight {}",
                   at, show(plain.o), show(plain.d), plainWeight, show(ray.o), show(ray.d), weight);
      judge.expect(!plain.hasDifferentials, "{}: the ray has differentials that nobody asked for",
                   at);
      judge.expect(ray.hasDifferentials, "{}: the ray has no differentials (hasDifferentials)", at);
      for (const Vec3& v : {ray.rxOrigin, ray.ryOrigin, ray.rxDirection, ray.ryDirection})
        judge.expect(isFinite(v), "{}: a neighbour of the ray begins or goes at {}", at, show(v));
    }
  }
}

// A camera that forgets Setup::toRender, or puts it where it does not belong.
void movesWithItsSpace(const Subject& subject, Judge& judge) {
  const Place here = places()[0], there{here.resolution, awry()};
  const auto at = makeCamera(subject, here), moved = makeCamera(subject, there);
  Rng rng(9);
  for (int i = 0; i < 500; ++i) {
    const CameraSample s = randomSample(rng, here.resolution);
    const auto [ray, weight] = at->generate(s, false);
    const auto [real, realWeight] = moved->generate(s, false);
    judge.expect(std::abs(weight - realWeight) <= 1e-4F * weight,
                 "{}: the weight is {}, but {} where toRender turns and moves the camera",
                 show(s, here), weight, realWeight);
    if (weight == 0 || realWeight == 0) continue;
    const DPoint3 o = there.toRender.point(DPoint3(ray.o));
    const DVec3 d = there.toRender.vector(DVec3(ray.d));
    judge.expect(glm::distance(o, DPoint3(real.o)) <= 1e-5 * (1 + glm::length(o)) &&
                     glm::distance(d, DVec3(real.d)) <= 1e-5,
                 "{}: toRender takes the ray of the camera in its own space to o {} d {}, but the "
                 "ray made with it is o {} d {}",
                 show(s, here), show(Vec3(o)), show(Vec3(d)), show(real.o), show(real.d));
  }
}

// A neighbour may go through another place of a system of lenses, so that it is not the ray of the
// same sample one pixel further. For textures to filter by, it is enough then that it comes past
// there.
void differentialsAreTheNeighbours(const Subject& subject, Judge& judge) {
  std::vector<ParamList> lenses = {{}};
  const ParamList wide = {number("lensradius", 0.5F), number("focaldistance", 9)};
  if (Declared(subject).has(wide)) lenses.push_back(wide);
  for (const ParamList& lens : lenses)
    for (const Place& place : places()) {
      const auto camera = makeCamera(subject, place, lens);
      const bool exact = !camera->usesLens() || camera->screenFromCamera();
      Rng rng(3);
      for (int i = 0; i < 300; ++i) {
        const CameraSample s = randomSample(rng, place.resolution);
        const auto [ray, weight] = camera->generate(s, true);
        const auto compare = [&, &own = ray](Vec2 step, const Point3& o, const Vec3& d,
                                             const char* which) {
          const auto [real, realWeight] = camera->generate({s.film + step, s.lens, s.time}, false);
          if (realWeight == 0) return;
          const bool near =
              exact ? glm::distance(o, real.o) <= 4e-6F && glm::distance(d, real.d) <= 4e-7F
                    : glm::distance(o + d, real.o + real.d) <=
                          0.25F * glm::distance(own.o + own.d, real.o + real.d);
          judge.expect(
              near,
              "{}: the neighbour in {} is told to be o {} d {}, but the ray there is o {} d {}",
              show(s, place), which, show(o), show(d), show(real.o), show(real.d));
        };
        if (!ray.hasDifferentials || weight == 0) continue;
        compare({1, 0}, ray.rxOrigin, ray.rxDirection, "x");
        compare({0, 1}, ray.ryOrigin, ray.ryDirection, "y");
      }
    }
}

void lensIsUsed(const Subject& subject, Judge& judge) {
  const Place place = places()[1];
  const auto camera = makeCamera(subject, place);
  if (camera->usesLens()) return judge.skip("its rays may depend on the lens");
  Rng rng(8);
  for (int i = 0; i < 300; ++i) {
    const CameraSample s = randomSample(rng, place.resolution);
    const Ray ray = camera->generate(s, false).ray, middle = camera->generate({s.film}, false).ray;
    judge.expect(ray.o == middle.o && ray.d == middle.d,
                 "{}: usesLens() is false, but without a place on the lens the ray is o {} d {}, "
                 "else o {} d {}",
                 show(s, place), show(middle.o), show(middle.d), show(ray.o), show(ray.d));
  }
}

void shutterGivesTheTime(const Subject& subject, Judge& judge) {
  const auto shutter = [](float open, float close) {
    return ParamList{number("shutteropen", open), number("shutterclose", close)};
  };
  if (!Declared(subject).has(shutter(0, 1)))
    return judge.skip("it declares no shutteropen and shutterclose");
  const auto camera = makeCamera(subject, places()[0], shutter(2, 6));
  for (const auto& [u, expected] : {std::pair(0.F, 2.F), std::pair(0.25F, 3.F)}) {
    const float time = camera->generate({{1, 1}, {}, u}, false).ray.time;
    judge.expect(time == expected,
                 "shutteropen 2, shutterclose 6: the time {} of the sample gives a ray of time {}, "
                 "not {}",
                 u, time, expected);
  }
  const float last = camera->generate({{1, 1}, {}, kOneMinusEpsilon}, false).ray.time;
  judge.expect(last <= 6, "shutterclose 6: a ray has the time {}", last);
  judge.expect(acceptsCamera(subject, shutter(0, 0)), "shutteropen 0, shutterclose 0 is refused");
  judge.expect(!acceptsCamera(subject, shutter(1, 0)),
               "shutteropen 1, shutterclose 0 is not refused by an Error");
}

void nonsenseIsAnError(const Subject& subject, Judge& judge) {
  const Declared declared(subject);
  const auto window = [](std::vector<float> v) { return numbers("screenwindow", std::move(v)); };
  const std::vector<ParamList> all = {
      {window({1, -1, -1, 1})},
      {window({-1, 1, 1, 1})},
      {window({-1, 1, 1})},
      {window({-1e30F, 1, -1, 1})},
      {number("lensradius", -1)},
      {number("lensradius", 1e30F)},
      {number("lensradius", 1), number("focaldistance", 1e-30F)},
      {number("focaldistance", 0)},
      {number("frameaspectratio", 0)},
      {number("frameaspectratio", 1e-30F)},
      {number("hither", 2), number("yon", 1)},
      {number("hither", -1)},
  };
  // A camera without lens may read its parameters and not use them.
  const bool flat = makeCamera(subject, places()[0])->screenFromCamera().has_value();
  for (const ParamList& bad : all) {
    const bool ofLens = bad[0].name == "lensradius" || bad[0].name == "screenwindow" ||
                        bad[0].name == "frameaspectratio";
    if (!declared.has(bad) || (ofLens && !flat)) continue;
    std::vector<std::string> words;
    for (const Param& p : bad)
      words.push_back(fmt::format("{} {}", p.name, fmt::join(numbersOf(p), " ")));
    judge.expect(!acceptsCamera(subject, bad), "{} is not refused by an Error",
                 fmt::join(words, ", "));
  }
  judge.expect(!acceptsCamera(subject, {number("nosuchparameter", 1)}),
               "a parameter that it does not read is not refused");
}

constexpr std::array<Law, 11> kLaws = {{
    {"well-formed-rays", "rays are finite, go in directions of length 1 and weigh nothing negative",
     raysAreWellFormed},
    {"moves-with-its-space", "toRender takes its rays wherever the camera is put",
     movesWithItsSpace},
    {"differentials-are-neighbours", "differentials are the rays one pixel to the right and down",
     differentialsAreTheNeighbours},
    {"lens-is-used", "rays depend on the place on the lens only if usesLens() says so", lensIsUsed},
    {"shutter-gives-the-time", "a ray's time goes from shutteropen to shutterclose",
     shutterGivesTheTime},
    {"matrix", "rays show what screenFromCamera() says, and go ahead", showsWhatTheMatrixSays},
    {"lens-focuses", "all of the lens sees one point of the plane at focaldistance", lensFocuses},
    {"extreme-lenses-focus", "lenses and distances of any size do so", extremeLensesFocus},
    {"clips-by-depth", "hither and yon are depths ahead of the camera", clipsByDepth},
    {"screen-window", "screenwindow and frameaspectratio are what the film shows",
     screenWindowIsShown},
    {"refuses-nonsense", "nonsense is an Error", nonsenseIsAnError},
}};

}  // namespace

std::span<const Law> cameraLaws() {
  static const auto laws = withSteady<CameraQuestions>(kLaws);
  return laws;
}

}  // namespace pbrt::laws
