// Keys tell renders apart that give different pictures, whatever the difference comes from.

#include "core/scene/render_key.h"

#include "core/base/file.h"
#include "tests/command.h"
#include "tests/gzip.h"
#include "tests/scenes.h"

namespace pbrt::test {
namespace {

namespace fs = std::filesystem;

// A grey picture of 2 x 2 pixels.
std::string pfm(float value) {
  std::string bytes = "Pf\n2 2\n-1\n";
  for (int i = 0; i < 4; ++i) bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  return bytes;
}

std::string triangle(const std::string& x) {
  return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
         "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n" +
         x + " 0 0\n0 1 0\n0 0 1\n3 0 1 2\n";
}

const char* const kScene = R"(
Camera "realistic" "string lensfile" "lens.dat" "float focusdistance" 5 "string aperture" "stop.pfm"
Film "image" "integer xresolution" 6 "integer yresolution" 4
Sampler "random" "integer pixelsamples" 3
WorldBegin
Include "lamps.pbrt"
LightSource "infinite" "string mapname" "sky.pfm"
LightSource "point" "spectrum I" "lamp.spd"
LightSource "projection" "string mapname" "slide.pfm"
LightSource "goniometric" "string mapname" "gonio.pfm"
Texture "t" "color" "imagemap" "string filename" "wood.pfm"
Material "matte" "texture Kd" "t"
Shape "plymesh" "string filename" "mesh.ply"
Shape "metaballs" "string filename" "balls.xyz" "float radius" 1
WorldEnd
)";

// Every kind of file that a scene may name, and another text of about the same meaning.
struct Named {
  std::string name, before, after;
};
std::vector<Named> files() {
  const std::string lens = contents(PBRT_SOURCE_DIR "/scenes/lenses/double-gauss.dat");
  const std::string lamp = "LightSource \"distant\"\n";
  return {{"scene.pbrt", kScene, kScene + std::string(" ")},
          {"lens.dat", lens, lens + "#"},
          {"stop.pfm", pfm(1), pfm(0.5F)},
          {"lamps.pbrt", lamp + "Include \"more.pbrt.gz\"", lamp + "Include  \"more.pbrt.gz\""},
          {"more.pbrt.gz", packed("# a"), packed("# b")},
          {"sky.pfm", pfm(1), pfm(2)},
          {"lamp.spd", "400 1 700 2", "400 1 700 3"},
          {"slide.pfm", pfm(1), pfm(2)},
          {"gonio.pfm", pfm(1), pfm(2)},
          {"wood.pfm", pfm(0.5F), pfm(0.25F)},
          {"mesh.ply", triangle("1"), triangle("2")},
          {"balls.xyz", "0 0 1\n0 0 2\n", "0 0 1\n0 0 3\n"}};
}

RenderKey keyOf(const fs::path& file, const BuildOptions& options = {}) {
  const FileDigest digest;
  PluginLoader plugins({PBRT_BUILD_DIR "/lib/pbrt"});
  SceneReader reader(plugins, options);
  Parser parser([&](Directive&& d) { reader.read(std::move(d)); });
  parser.file(file);
  const auto scene = reader.finish();
  return renderKey(*scene, reader.dialect().dialect, options.permissive, plugins, digest.value());
}

class RenderKeys : public testing::Test {
 protected:
  RenderKeys() {
    for (const Named& f : files()) folder_.write(f.name, f.before);
  }
  RenderKey key(const BuildOptions& options = {}) const {
    return keyOf(folder_.path() / "scene.pbrt", options);
  }
  const Folder folder_;
};

TEST_F(RenderKeys, KnowEveryFile) {
  const RenderKey before = key();
  std::vector<std::uint64_t> seen{before.scene};
  for (const Named& f : files()) {
    folder_.write(f.name, f.after);
    const RenderKey changed = key();
    EXPECT_EQ(std::ranges::count(seen, changed.scene), 0) << f.name;
    seen.push_back(changed.scene);
    EXPECT_EQ(difference(before, changed),
              "it is of another scene, or a file that the scene names has changed")
        << f.name;
    folder_.write(f.name, f.before);
    EXPECT_EQ(key(), before) << f.name;
  }
}

// Two files that trade places hold the same bytes together.
TEST_F(RenderKeys, KnowWhichFileIsWhich) {
  const RenderKey before = key();
  folder_.write("slide.pfm", pfm(3));
  const RenderKey one = key();
  fs::rename(folder_.path() / "slide.pfm", folder_.path() / "t");
  fs::rename(folder_.path() / "gonio.pfm", folder_.path() / "slide.pfm");
  fs::rename(folder_.path() / "t", folder_.path() / "gonio.pfm");
  EXPECT_NE(key(), one);
  EXPECT_NE(key(), before);
}

TEST_F(RenderKeys, DoNotKnowFoldersAndTimes) {
  const RenderKey before = key();
  const Folder other;
  fs::copy(folder_.path(), other.path() / "moved");
  for (const auto& entry : fs::directory_iterator(other.path() / "moved"))
    fs::last_write_time(entry, fs::file_time_type::clock::now() - std::chrono::hours(1000));
  EXPECT_EQ(keyOf(other.path() / "moved" / "scene.pbrt"), before);
  fs::rename(other.path() / "moved" / "scene.pbrt", other.path() / "moved" / "other.pbrt");
  EXPECT_EQ(keyOf(other.path() / "moved" / "other.pbrt"), before);
}

TEST_F(RenderKeys, DoNotKnowWhichPartIsRendered) {
  const RenderKey before = key();
  BuildOptions part;
  part.pixelBounds = {1, 3, 0, 2};
  part.threads = 1;
  EXPECT_EQ(key(part), before);
}

TEST_F(RenderKeys, TellWhatDiffersInWords) {
  const RenderKey before = key();
  const auto differs = [&](const auto& change) {
    BuildOptions options;
    change(options);
    return difference(before, key(options));
  };
  EXPECT_EQ(before.settings, "pbrt-v3, 6 x 4 pixels");
  EXPECT_EQ(differs([](BuildOptions&) {}), "");
  EXPECT_EQ(differs([](BuildOptions& o) { o.seed = 7; }), "it has another seed: 7, not 0");
  EXPECT_EQ(differs([](BuildOptions& o) { o.samplesPerPixel = 5; }),
            "its sampler spreads 5 samples over a pixel, not 3");
  EXPECT_EQ(differs([](BuildOptions& o) { o.width = 12; }),
            "it is pbrt-v3, 12 x 8 pixels, not pbrt-v3, 6 x 4 pixels");
  EXPECT_EQ(differs([](BuildOptions& o) { o.aovs = kVariance | kNormal; }),
            "it is pbrt-v3, 6 x 4 pixels, stored: variance normal, not pbrt-v3, 6 x 4 pixels");
  EXPECT_EQ(differs([](BuildOptions& o) { o.permissive = true; }),
            "it is pbrt-v3, 6 x 4 pixels, permissive, not pbrt-v3, 6 x 4 pixels");
  EXPECT_EQ(differs([](BuildOptions& o) {
              o.width = 12;
              o.seed = 7;
            }),
            "it has another seed: 7, not 0; it is pbrt-v3, 12 x 8 pixels, not pbrt-v3, 6 x 4 "
            "pixels");
}

TEST_F(RenderKeys, KnowTheProgramsThatWereOpened) {
  const fs::path built = PBRT_BUILD_DIR "/lib/pbrt";
  const Folder copies;
  fs::copy(built / "filters", copies.path() / "filters");
  PluginLoader none({copies.path()}), one({copies.path()}), same({built}), two({copies.path()});
  one.open(PluginKind::filter, "box");
  same.open(PluginKind::filter, "box");
  two.open(PluginKind::filter, "box");
  two.open(PluginKind::filter, "gaussian");
  const std::uint64_t programs = one.programs();
  EXPECT_NE(programs, none.programs());
  EXPECT_NE(programs, two.programs());
  EXPECT_EQ(programs, same.programs()) << "the folder does not count";
  const RenderKey a{1, programs, 3, 4, "b"}, b{1, two.programs(), 3, 4, "b"};
  EXPECT_EQ(difference(a, b), "it was made by another build of pbrt or of its plug-ins");

  fs::path file = copies.path() / "filters" / "box.so";
  const std::string bytes = contents(file);
  fs::remove(file);  // the open one lives on
  copies.write("filters/box.so", bytes + '\0');
  EXPECT_NE(programs, one.programs());
  fs::remove(file);
  EXPECT_THROW(one.programs(), Error);
}

}  // namespace
}  // namespace pbrt::test
