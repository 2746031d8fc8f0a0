// Surface particles show what rays show: pictures against those of whitted, which differs in
// nothing but what camera rays see.

#include <cmath>

#include "tests/scenes.h"

namespace pbrt::test {
namespace {

struct Difference {
  double mean = 0, rms = 0;  // of R, G and B together
};

Difference difference(const Image& a, const Image& b) {
  double sum = 0, sum2 = 0, n = 0;
  for (const char* channel : {"R", "G", "B"})
    for (std::size_t i = 0; i < a.channel(channel)->size(); ++i) {
      const double d = double{(*a.channel(channel))[i]} - (*b.channel(channel))[i];
      sum += d, sum2 += d * d, n += 1;
    }
  return {sum / n, std::sqrt(sum2 / n)};
}

const std::string kSampler = "Sampler \"lowdiscrepancy\" \"integer pixelsamples\" 4 ";
const std::string kFilm = "Film \"image\" \"integer xresolution\" 72 \"integer yresolution\" 60 ";
const std::string kCamera =
    "LookAt 0 1.5 -5  0 0.6 0  0 1 0 Camera \"perspective\" \"float fov\" 40 ";
const std::string kLamp = "LightSource \"point\" \"rgb I\" [120 110 100] \"point3 from\" [3 5 -4] ";
const std::string kBall =
    "Material \"matte\" \"rgb Kd\" [0.8 0.5 0.2] "
    "Shape \"metaballs\" \"point3 P\" [0 0.7 0] \"float radius\" 1.2 ";
const std::string kBlob =
    "Material \"plastic\" \"rgb Kd\" [0.2 0.5 0.8] "
    "Shape \"metaballs\" \"string kernel\" \"wyvill\" "
    "\"point3 P\" [-0.5 0.7 0  0.4 0.6 -0.2  0.1 1.2 0.3] \"float radius\" [1.1 0.9 0.8] ";
const std::string kFloor =
    "Material \"matte\" \"rgb Kd\" [0.6 0.6 0.6] Shape \"trianglemesh\" \"integer indices\" "
    "[0 1 2 0 2 3] \"point3 P\" [-4 0 -4  -4 0 4  4 0 4  4 0 -4] ";

std::string particles(int count, const std::string& more = "") {
  return "Integrator \"surfaceparticles\" \"integer particles\" " + std::to_string(count) + " " +
         more;
}
const std::string kWhitted = "Integrator \"whitted\" \"integer maxdepth\" 1 ";

Image picture(const std::string& integrator, const std::string& world,
              const std::string& camera = kCamera, const std::string& film = kFilm) {
  return renderText(integrator + film + kSampler + camera + " WorldBegin " + world + " WorldEnd");
}

void expectAlike(const std::string& world, const std::string& camera = kCamera,
                 double most = 0.005) {
  const Image rays = picture(kWhitted, world, camera);
  const Image discs = picture(particles(4096), world, camera);
  const double level = (mean(rays, "R") + mean(rays, "G") + mean(rays, "B")) / 3;
  EXPECT_GT(level, 0.01) << camera << world;
  const Difference d = difference(rays, discs);
  EXPECT_LT(std::abs(d.mean), 0.1 * most * level) << camera << world;
  EXPECT_LT(d.rms, most * level) << camera << world;
}

TEST(SurfaceParticles, ComeNearerTheMoreTheyAre) {
  const std::string world = kLamp + kBlob + kFloor;
  const Image rays = picture(kWhitted, world);
  double last = 1;
  for (const int count : {100, 1000, 10000}) {
    const Difference d = difference(rays, picture(particles(count), world));
    EXPECT_LT(d.rms, 0.6 * last) << count;
    last = d.rms;
  }
  EXPECT_LT(last, 0.02);
}

TEST(SurfaceParticles, StandBeforeAndBehindOtherShapes) {
  expectAlike(kLamp + kBlob + kFloor +
              "Material \"matte\" \"rgb Kd\" [0.7 0.1 0.1] "
              "AttributeBegin Translate -0.6 0.5 -1.2 Shape \"sphere\" \"float radius\" 0.4 "
              "AttributeEnd AttributeBegin Translate 0.9 1 1 Shape \"sphere\" \"float radius\" 0.8 "
              "AttributeEnd ");
}

TEST(SurfaceParticles, AreSeenThroughEveryCamera) {
  const std::string look = "LookAt 0 1.5 -5  0 0.6 0  0 1 0 ";
  for (const char* camera :
       {"Camera \"orthographic\" \"float screenwindow\" [-2 2 -1.7 1.7] ",
        "Camera \"environment\" ",
        "Camera \"perspective\" \"float fov\" 40 \"float lensradius\" 0.1 \"float focaldistance\" "
        "5"})
    expectAlike(kLamp + kBlob + kFloor, look + camera);
  expectAlike(kLamp + kBlob + kFloor,
              "LookAt 0 1.5 -9  0 0.6 0  0 1 0 Camera \"realistic\" \"string lensfile\" "
              "\"" PBRT_SOURCE_DIR
              "/scenes/lenses/double-gauss.dat\" \"float focusdistance\" 9 "
              "\"float aperturediameter\" 10 ");
}

TEST(SurfaceParticles, InstancesMayBeStretchedAndMirrored) {
  expectAlike(kLamp + kFloor + "ObjectBegin \"blob\" " + kBlob + "ObjectEnd " +
              "AttributeBegin Translate -0.8 0 0 Scale 0.5 1.2 0.7 ObjectInstance \"blob\" "
              "AttributeEnd AttributeBegin Translate 0.9 0 0.5 Rotate 30 0 1 0 Scale -0.8 0.8 0.8 "
              "ObjectInstance \"blob\" AttributeEnd ");
}

TEST(SurfaceParticles, InstancesMayBeTurnedMirroredAndScaled) {
  const auto at = [](const char* where) {
    return "AttributeBegin " + std::string(where) + " ObjectInstance \"blob\" AttributeEnd ";
  };
  expectAlike(kLamp + kFloor + "ObjectBegin \"blob\" " + kBlob + "ObjectEnd " +
                  at("Translate -1 0 0 Rotate 70 0.2 1 0.1 Scale 0.9 0.9 0.9") +
                  at("Translate 0.4 0 0.5 Scale -1 1 1") +
                  at("Translate 1.2 0 -1 Rotate 200 0 1 0 Scale 0.5 -0.5 0.5 Translate 0 -1.5 0"),
              kCamera, 0.01);
}

// Copies share their particles: each looks as the next.
TEST(SurfaceParticles, CopiesAreAlike) {
  const std::string world =
      "LightSource \"distant\" \"point3 from\" [1 2 -3] \"point3 to\" [0 0 0] ObjectBegin "
      "\"blob\" " +
      kBlob + "ObjectEnd AttributeBegin Translate -2 0 0 ObjectInstance \"blob\" AttributeEnd " +
      "AttributeBegin Translate 2 0 0 ObjectInstance \"blob\" AttributeEnd ";
  const Image both =
      picture(particles(200), world,
              "LookAt 0 0.7 -5  0 0.7 0  0 1 0 Camera \"orthographic\" \"float screenwindow\" [-4 "
              "4 -2 2] Sampler \"stratified\" \"bool jitter\" \"false\" ",
              "Film \"image\" \"integer xresolution\" 128 \"integer yresolution\" 64 ");
  const auto& red = *both.channel("R");
  double off = 0, level = 0;
  for (std::size_t y = 0; y < 64; ++y)
    for (std::size_t x = 0; x < 64; ++x) {
      off += std::abs(double{red[128 * y + x]} - red[128 * y + x + 64]);
      level += red[128 * y + x];
    }
  EXPECT_GT(level, 10);
  EXPECT_LT(off, 1e-3 * level);
}

// Where two surfaces cross each keeps its own colour.
TEST(SurfaceParticles, KeepTheColourOfTheirSurface) {
  expectAlike(kLamp +
              "Material \"matte\" \"rgb Kd\" [1 0 0] Shape \"metaballs\" \"point3 P\" [-0.3 0.7 0] "
              "\"float radius\" 1.2 Material \"matte\" \"rgb Kd\" [0 1 0] Shape \"metaballs\" "
              "\"point3 P\" [0.3 0.7 0] \"float radius\" 1.2 ");
}

TEST(SurfaceParticles, KnowColoursOfAtomsAndTextures) {
  expectAlike(kLamp +
              "Texture \"own\" \"color\" \"shapecolor\" Material \"matte\" \"texture Kd\" \"own\" "
              "Shape \"metaballs\" \"point3 P\" [-0.5 0.7 0  0.5 0.7 0] \"float radius\" 1.2 "
              "\"rgb color\" [1 0 0  0 0 1] ");
  expectAlike(
      kLamp +
          "Texture \"checks\" \"color\" \"checkerboard\" \"float uscale\" 8 \"float vscale\" 4 "
          "\"rgb tex1\" [1 1 1] \"rgb tex2\" [0.2 0.2 0.2] "
          "Material \"matte\" \"texture Kd\" \"checks\" "
          "Shape \"metaballs\" \"point3 P\" [0 0.7 0] \"float radius\" 1.5 ",
      kCamera, 0.05);
}

TEST(SurfaceParticles, AreLitByEveryKindOfLight) {
  for (const char* light :
       {"LightSource \"infinite\" \"rgb L\" [0.5 0.7 1] ",
        "LightSource \"distant\" \"rgb L\" [2 2 2] \"point3 from\" [1 2 -1] \"point3 to\" [0 0 0] ",
        "LightSource \"spot\" \"rgb I\" [40 40 40] \"point3 from\" [2 4 -3] \"point3 to\" [0 0.6 "
        "0] ",
        "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [12 11 9] Translate 0 4 -2 "
        "Rotate 90 1 0 0 Shape \"disk\" \"float radius\" 0.7 AttributeEnd "})
    expectAlike(light + kBlob + kFloor);
}

// As rays do, each disc is where its surface is at the time of the ray: a ball that crosses the
// picture, and a blob that turns in it, with their shadows.
TEST(SurfaceParticles, MoveWithTheirSurface) {
  const auto moving = [](const std::string& motion, const std::string& shape) {
    return "AttributeBegin ActiveTransform EndTime " + motion + " ActiveTransform All " + shape +
           "AttributeEnd ";
  };
  for (const char* shutter : {"\"float shutteropen\" 0 \"float shutterclose\" 1 ",
                              "\"float shutteropen\" 0.7 \"float shutterclose\" 0.7 "}) {
    expectAlike(kLamp + moving("Translate 1.2 0.4 0 ", kBall) + kFloor, kCamera + shutter);
    expectAlike(kLamp + moving("Rotate 90 0 1 0 Scale 0.7 1 1.2 ", kBlob) + kFloor,
                kCamera + shutter);
  }
}

// Where a texture says that there is a hole, no disc lies: of the upper half of a ball there is
// none, but for the discs along the edge. Whoever looks level sees neither half from within.
TEST(SurfaceParticles, LeaveHolesOfAlphaOpen) {
  const std::string camera = "LookAt 0 0.7 -5  0 0.7 0  0 1 0 Camera \"perspective\" ";
  const std::string lamp = "LightSource \"point\" \"rgb I\" [90 90 90] \"point3 from\" [0 0.7 -5] ";
  const std::string half =
      "Texture \"half\" \"float\" \"checkerboard\" \"string mapping\" \"planar\" "
      "\"vector3 v1\" [0 0.5 0] \"vector3 v2\" [0 0 0] \"float udelta\" 0.65 "
      "\"float tex1\" 1 \"float tex2\" 0 " +
      kBall + "\"texture alpha\" \"half\" ";
  const Image whole = picture(kWhitted, lamp + kBall, camera),
              rays = picture(kWhitted, lamp + half, camera);
  EXPECT_NEAR(mean(rays, "R") / mean(whole, "R"), 0.5, 0.02);
  const Difference d = difference(rays, picture(particles(10000), lamp + half, camera));
  // A disc is some 0.03 of the ball's radius wide.
  EXPECT_LT(std::abs(d.mean), 0.05 * mean(rays, "R"));
  // Nothing of a ball that is a hole altogether.
  const Image none = picture(particles(1000), lamp + kBall + "\"float alpha\" 0 ", camera);
  EXPECT_EQ(mean(none, "A"), 0);
}

TEST(SurfaceParticles, MayThemselvesBeALight) {
  expectAlike(kFloor + "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [3 2 1] " + kBall +
                  "AttributeEnd ",
              kCamera);
}

// The camera within a lamp whose normals are turned is lit; from outside the lamp is black.
TEST(SurfaceParticles, TurnWithTheirSurface) {
  expectAlike(kLamp + "ReverseOrientation " + kBall);
  const Image black = picture(
      particles(2000), "ReverseOrientation AreaLightSource \"diffuse\" \"rgb L\" [3 2 1] " + kBall);
  EXPECT_LT(mean(black, "R"), 1e-3);
}

TEST(SurfaceParticles, AreDimmedByRegions) {
  const std::string fog =
      "Volume \"homogeneous\" \"rgb sigma_a\" [0.1 0.2 0.3] \"rgb sigma_s\" [0 0 0] \"rgb Le\" "
      "[0.02 0.03 0.05] "
      "\"point3 p0\" [-3 0 -3] \"point3 p1\" [3 3 3] ";
  expectAlike(kLamp + kBlob + kFloor + fog);
}

TEST(SurfaceParticles, CastNoShadowsUnlessAsked) {
  const std::string lamp = "LightSource \"point\" \"rgb I\" [120 110 100] \"point3 from\" [0 5 0] ";
  const double with = mean(picture(particles(4096), lamp + kBlob + kFloor), "R"),
               without = mean(
                   picture(particles(4096, "\"bool shadows\" \"false\" "), lamp + kBlob + kFloor),
                   "R");
  EXPECT_GT(without, 1.05 * with);
}

// Light from the eye: where the true surface bulges over a disc, it is not in the way.
TEST(SurfaceParticles, DoNotShadeThemselves) {
  const std::string lamp = "LightSource \"point\" \"rgb I\" [25 25 25] \"point3 from\" [0 1.5 -5] ";
  for (const std::string& shape : {kBall, kBlob})
    for (const int count : {300, 3000}) {
      const Image with = picture(particles(count), lamp + shape),
                  without = picture(particles(count, "\"bool shadows\" \"false\" "), lamp + shape);
      EXPECT_LT(difference(with, without).rms, 2e-3 * mean(with, "R")) << count << shape;
    }
}

TEST(SurfaceParticles, StoreWhatWasSeen) {
  const std::string film =
      kFilm + "\"string aov\" [\"normal\" \"depth\" \"albedo\" \"shape\" \"uv\"] ";
  const std::string world = kLamp + kFloor + kBall;
  const Image rays = picture(kWhitted, world, kCamera, film),
              discs = picture(particles(10000), world, kCamera, film);
  for (const char* channel : {"N.X", "N.Y", "N.Z", "Z", "Albedo.R", "shape"}) {
    double off = 0;
    const auto &a = *rays.channel(channel), &b = *discs.channel(channel);
    for (std::size_t i = 0; i < a.size(); ++i) off += std::abs(double{a[i]} - b[i]);
    EXPECT_LT(off / static_cast<double>(a.size()), 0.02) << channel;
  }
}

TEST(SurfaceParticles, LeaveTheRestOfTheSceneAsItIs) {
  const std::string world =
      kLamp + kFloor + "Translate 0 0.7 0 Shape \"sphere\" \"float radius\" 0.7";
  EXPECT_LT(difference(picture(kWhitted, world), picture(particles(1000), world)).rms, 1e-4);
  EXPECT_EQ(mean(picture(particles(1000), kLamp), "A"), 0);
}

TEST(SurfaceParticles, LieAsDenseAsQualityAsks) {
  const std::string world = kLamp + kBlob;
  const Image rays = picture(kWhitted, world);
  const auto rms = [&](const char* quality) {
    return difference(rays, picture("Integrator \"surfaceparticles\" \"float quality\" " +
                                        std::string(quality) + " ",
                                    world))
        .rms;
  };
  EXPECT_LT(rms("4"), 0.4 * rms("0.5"));
}

TEST(SurfaceParticles, DoNotDependOnThreads) {
  const std::string text = particles(2000) + kFilm + kSampler + kCamera + "WorldBegin " + kLamp +
                           kFloor + kBlob + kBall + "WorldEnd";
  const Image one = renderText(text, 1);
  for (const int threads : {2, 5}) EXPECT_EQ(renderText(text, threads).channels, one.channels);
}

}  // namespace
}  // namespace pbrt::test
