// What the camera with a lens of glass does with lenses that are strange or wrong.

#include "tests/cameras/lenses.h"
#include "tests/scenes.h"

namespace pbrt {
namespace {

using test::LensRows;
using test::number;
using test::text;

TEST(RealisticCamera, AllRaysAreFiniteAlsoBeyondThePicture) {
  const auto c = test::lensCamera(test::kDoubleGauss, {number("aperturediameter", 10)});
  Rng rng(11);
  int blocked = 0;
  for (int i = 0; i < 20000; ++i) {
    const Point2 film(1000 * rng.uniform() - 500, 1000 * rng.uniform() - 500);
    const CameraRay r = c->generate({film, {rng.uniform(), rng.uniform()}, 0}, true);
    EXPECT_GE(r.weight, 0);
    EXPECT_LT(r.weight, 10);
    EXPECT_NEAR(glm::length(r.ray.d), 1, 1e-6);
    EXPECT_TRUE(std::isfinite(r.ray.o.x + r.ray.o.y + r.ray.o.z));
    EXPECT_TRUE(std::isfinite(glm::dot(r.ray.rxDirection, r.ray.ryDirection)));
    blocked += r.weight == 0;
  }
  EXPECT_GT(blocked, 1000);
}

// A scene in metres, with the lens's default unit, and film sizes from the Film statement.
TEST(RealisticCamera, TheFilmsDiagonalDecidesWhatIsSeen) {
  const auto slope = [](const std::string& diagonal) {
    const auto scene =
        test::buildText("Camera \"realistic\" \"string lensfile\" \"" + test::kDoubleGauss +
                        "\" \"float aperturediameter\" 0.01 \"float focusdistance\" 100\n"
                        "Film \"image\" \"integer xresolution\" 30 \"integer yresolution\" 20 " +
                        diagonal + " Integrator \"whitted\" WorldBegin WorldEnd");
    const Ray ray = scene->camera().generate({{28.5F, 19}, {0.5F, 0.5F}, 0}, false).ray;
    EXPECT_LT(glm::length(ray.o), 0.2F);  // 11 cm of lens and film
    EXPECT_GT(ray.d.x, 0);
    EXPECT_LT(ray.d.y, 0);
    return std::hypot(ray.d.x, ray.d.y) / ray.d.z;
  };
  EXPECT_NEAR(slope("\"float diagonal\" 10"), 0.9 * 5 / 50.36, 1e-3);
  EXPECT_NEAR(slope(""), 0.9 * 17.5 / 50.36, 0.01);
}

TEST(RealisticCamera, SaysWhatIsWrongWithALens) {
  const test::Folder folder;
  const auto message = [&](const std::string& lens, const ParamList& more = {}) {
    folder.write("bad.dat", lens);
    try {
      test::lensCamera((folder.path() / "bad.dat").string(), more);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  const std::string good = test::textOf(test::thinLens(50, 1));
  EXPECT_EQ(message(good), "no error");
  EXPECT_EQ(message("\xEF\xBB\xBF# a comment\r\n" + good), "no error");
  for (const auto& [lens, says] : std::vector<std::pair<std::string, std::string>>{
           {"", "no lens"},
           {"# nothing\n", "no lens"},
           {good + "1 2 3", "rows of 4 numbers; 3 are left"},
           {good + "1 2 3 x", "expected a number"},
           {good + "nan 2 3 4", "expected a number"},
           {good + "1e300 2 3 4", "expected a number"},
           {"50 -1 1.5 4 0 0 1 1", "thickness"},
           {"50 1 0.5 4 0 0 1 1", "index"},
           {"50 1 1.5 0 0 0 1 1", "diameter"},
           {"0 1 1 1 50 1 1.5 4", "must end in air"},
           {"50 1 1.5 4 -50 1 1 4", "no stop"},
           {good + "0 0 1 1", "more than one stop"},
           {test::textOf(test::thinLens(-50, 1)), "gathers no light"},
           {"0 1 1 1", "gathers no light"},
       })
    EXPECT_NE(message(lens).find(says), std::string::npos) << says << ": " << message(lens);
  EXPECT_NE(message(good, {number("focusdistance", 150)}).find("too near"), std::string::npos);
  EXPECT_NE(message(good, {number("filmdistance", -1)}).find("filmdistance"), std::string::npos);
  // The rim of a hollow reaches farther than the film.
  EXPECT_NE(message("0 20 1 1  15 10 1.5 30  20 0 1 30", {number("filmdistance", 5)})
                .find("puts the film into the lens"),
            std::string::npos);
  for (const ParamList& bad : std::vector<ParamList>{
           {number("aperturediameter", 0)},
           {number("focusdistance", -1)},
           {number("filmdiag", 0)},
           {text("aperture", "nosuchshape")},
           {number("shutteropen", 2)},
           {number("nosuch", 1)},
       })
    EXPECT_NE(message(good, bad), "no error") << bad.front().name;
  // White where the disc of the stop does not reach: in its corners.
  const std::string black(4 * 8, '\0'), white("\0\0\x80\x3f", 4);
  const std::string row = white + std::string(4 * 14, '\0') + white;
  std::string rows;
  for (int y = 0; y < 16; ++y) rows += y % 15 == 0 ? row : black + black;
  folder.write("corners.pfm", "Pf\n16 16\n-1\n" + rows);
  EXPECT_NE(message(good, {text("aperture", (folder.path() / "corners.pfm").string())})
                .find("no light goes through"),
            std::string::npos);
  EXPECT_THROW(test::make<Camera>("realistic", {}, {{}, {9, 9}}), Error);
  EXPECT_THROW(test::lensCamera("no-such-file.dat"), Error);
  EXPECT_THROW(test::make<Camera>("realistic",
                                  {text("lensfile", test::kDoubleGauss), number("unit", 0)}, {}),
               Error);
}

// A picture that would be black for a reason that is not to be seen in it.
TEST(RealisticCamera, WarnsOfAShutterThatGathersNoLight) {
  const auto warnings = [](const ParamList& more) {
    ParamList list = more;
    list.push_back(text("lensfile", test::kDoubleGauss));
    std::vector<std::string> said;
    Params params("realistic", {}, {&list}, nullptr,
                  [&](const Diagnostic& d) { said.push_back(d.message); });
    create<Camera>(test::loader().open(kindOf<Camera>, "realistic"), params,
                   Camera::Setup{{}, {90, 60}, 43.27F});
    return said;
  };
  const Param shut = number("shutterclose", 0), full = test::flag("simpleweighting", false);
  ASSERT_EQ(warnings({shut, full}).size(), 1U);
  EXPECT_NE(warnings({shut, full})[0].find("no light"), std::string::npos);
  for (const ParamList& fine :
       std::vector<ParamList>{{full}, {shut}, {shut, full, test::flag("timeweighting", false)}})
    EXPECT_TRUE(warnings(fine).empty());
}

// Lenses of which nothing can be seen, or of which all must be searched for: an answer, and soon.
TEST(RealisticCamera, StrangeLensesEndInAPictureOrAnError) {
  Rng rng(12);
  int made = 0;
  for (int i = 0; i < 100; ++i) {
    LensRows rows;
    const int n = 1 + static_cast<int>(4 * rng.uniform());
    for (int k = 0; k < n; ++k) {
      const auto size = static_cast<long double>(std::exp(6 * rng.uniform() - 2));
      rows.push_back({rng.uniform() < 0.5F ? size : -size, 5.0L * rng.uniform(),
                      1 + 0.9L * rng.uniform(), size * (0.1L + 2 * rng.uniform())});
    }
    rows.push_back({rows[0].radius, 1, 1, 10});
    rows.push_back({0, 0, 1, 1 + 10.0L * rng.uniform()});
    try {
      const auto c =
          test::lensCamera(rows, {number("aperturediameter", 0.5F), number("filmdistance", 30)});
      ++made;
      for (int k = 0; k < 100; ++k) {
        const CameraRay r = c->generate(test::randomSample(rng), true);
        EXPECT_TRUE(r.weight >= 0 && std::isfinite(r.weight));
        EXPECT_NEAR(glm::length(r.ray.d), 1, 1e-6);
      }
    } catch (const Error&) {
    }
  }
  EXPECT_GT(made, 10);
}

}  // namespace
}  // namespace pbrt
