// What a scene does not use is not opened, not built and not held.

#include <fmt/format.h>

#include <regex>
#include <set>

#include "core/scene/translation.h"
#include "tests/command.h"
#include "tests/scenes.h"

namespace pbrt::test {
namespace {

namespace fs = std::filesystem;

using Names = std::set<std::string>;  // folder/name

Names opened(const PluginLoader& plugins) {
  Names names;
  for (const LoadedPlugin& plugin : plugins.opened())
    names.insert(fmt::format("{}/{}", kindFolder(plugin.info->kind), plugin.info->name));
  return names;
}

Names openedBy(const std::string& text) {
  PluginLoader plugins({PBRT_BUILD_DIR "/lib/pbrt"});
  buildText(text, {}, plugins);
  return opened(plugins);
}

// The plug-ins that the statements of a text name, which a search for them finds, and what the
// generation takes where there is no statement.
Names namedBy(std::string text, const DialectDefaults& defaults) {
  const std::vector<std::pair<PluginKind, std::string>> statements = {
      {PluginKind::shape, R"rx(\bShape\s*"(\w+)")rx"},
      {PluginKind::material, R"rx(\bMaterial\s*"(\w+)")rx"},
      {PluginKind::material, R"rx(\bMakeNamedMaterial\s*"[^"]+"\s*"string type"\s*"(\w+)")rx"},
      {PluginKind::texture, R"rx(\bTexture\s*"[^"]+"\s*"\w+"\s*"(\w+)")rx"},
      {PluginKind::light, R"rx(\b(?:Area)?LightSource\s*"(\w+)")rx"},
      {PluginKind::camera, R"rx(\bCamera\s*"(\w+)")rx"},
      {PluginKind::sampler, R"rx(\bSampler\s*"(\w+)")rx"},
      {PluginKind::filter, R"rx(\bPixelFilter\s*"(\w+)")rx"},
      {PluginKind::integrator, R"rx(\b(?:Surface)?Integrator\s*"(\w+)")rx"},
      {PluginKind::volume, R"rx(\bMakeNamedMedium\s*"[^"]+"\s*"string type"\s*"(\w+)")rx"}};
  text = std::regex_replace(text, std::regex("#[^\n]*"), "");
  std::map<PluginKind, std::string> missing = {{PluginKind::camera, defaults.camera},
                                               {PluginKind::sampler, defaults.sampler},
                                               {PluginKind::filter, defaults.filter},
                                               {PluginKind::integrator, defaults.integrator}};
  Names names;
  const auto add = [&](PluginKind kind, const std::string& name) {
    const Translation* t = findTranslation(kind, name);
    names.insert(fmt::format("{}/{}", kindFolder(kind), t ? t->target : name));
  };
  for (const auto& [kind, pattern] : statements) {
    const std::regex statement(pattern);
    for (std::sregex_iterator i(text.begin(), text.end(), statement), end; i != end; ++i) {
      missing.erase(kind);
      add(kind, (*i)[1]);
    }
  }
  for (const auto& [kind, name] : missing) add(kind, name);
  names.erase("materials/none");  // the word for no surface
  return names;
}

class EveryScene : public testing::TestWithParam<fs::path> {};

TEST_P(EveryScene, OpensExactlyThePluginsThatItNames) {
  PluginLoader plugins({PBRT_BUILD_DIR "/lib/pbrt"});
  SceneReader reader(plugins, {.width = 8});
  Parser parser([&](Directive&& d) { reader.read(std::move(d)); });
  parser.file(GetParam());
  reader.finish();
  const DialectDefaults& defaults = dialectDefaults(reader.dialect().dialect);
  const Names named = namedBy(contents(GetParam()), defaults);
  Names open = opened(plugins);
  // That of shapes before the first Material, which a search does not find.
  if (const std::string matte = "materials/" + defaults.material; !named.contains(matte))
    open.erase(matte);
  EXPECT_EQ(open, named);
}

std::vector<fs::path> scenes() {
  std::vector<fs::path> files;
  for (const auto& file : fs::directory_iterator(PBRT_SOURCE_DIR "/scenes"))
    if (file.path().extension() == ".pbrt") files.push_back(file.path());
  std::ranges::sort(files);
  return files;
}

INSTANTIATE_TEST_SUITE_P(Scenes, EveryScene, testing::ValuesIn(scenes()), [](const auto& test) {
  return std::regex_replace(test.param.stem().string(), std::regex("\\W"), "_");
});

// What every scene below opens.
const std::string kOptions = "Camera \"orthographic\" Sampler \"random\" PixelFilter \"triangle\" ";
const Names kOpened = {"cameras/orthographic", "samplers/random", "filters/triangle",
                       "integrators/whitted"};

Names with(Names more) {
  more.insert(kOpened.begin(), kOpened.end());
  return more;
}

TEST(Lean, WhatIsNamedAndNotUsedIsNotOpened) {
  const std::string sphere = "LightSource \"point\" Material \"mirror\" Shape \"sphere\"\n";
  const Names plain = with({"lights/point", "materials/mirror", "shapes/sphere"});
  for (const std::string unused :
       {"Texture \"t\" \"float\" \"wrinkled\"\n", "Texture \"t\" \"color\" \"imagemap\"\n",
        "MakeNamedMaterial \"m\" \"string type\" \"glass\"\n", "Material \"plastic\"\n",
        "MakeNamedMedium \"m\" \"string type\" \"homogeneous\"\n",
        "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" MediumInterface \"m\" \"\"\n",
        "ObjectBegin \"o\" Material \"glass\" Shape \"disk\" ObjectEnd\n",
        "AttributeBegin AreaLightSource \"diffuse\" AttributeEnd\n",
        "AttributeBegin Material \"\" Shape \"disk\" AttributeEnd\n",
        "Texture \"a\" \"color\" \"marble\" MakeNamedMaterial \"m\" \"string type\" \"matte\" "
        "\"texture Kd\" \"a\"\n"})
    EXPECT_EQ(openedBy(kOptions +
                       "SurfaceIntegrator \"whitted\" VolumeIntegrator \"single\"\n"
                       "WorldBegin\n" +
                       unused + sphere + "WorldEnd\n"),
              plain)
        << unused;
}

TEST(Lean, OfSeveralStatementsOfAnOptionTheLastIsOpened) {
  EXPECT_EQ(openedBy("Sampler \"halton\" Camera \"environment\" PixelFilter \"sinc\"\n"
                     "SurfaceIntegrator \"path\"\n" +
                     kOptions +
                     "SurfaceIntegrator \"whitted\"\n"
                     "WorldBegin LightSource \"point\" Shape \"disk\" WorldEnd\n"),
            with({"lights/point", "materials/matte", "shapes/disk"}));
}

TEST(Lean, WhatIsUsedInTheEndIsOpened) {
  EXPECT_EQ(
      openedBy(kOptions +
               "SurfaceIntegrator \"whitted\" VolumeIntegrator \"single\"\nWorldBegin\n"
               "Texture \"inner\" \"color\" \"checkerboard\"\n"
               "Texture \"outer\" \"color\" \"scale\" \"texture tex1\" \"inner\"\n"
               "MakeNamedMaterial \"m\" \"string type\" \"plastic\" \"texture Kd\" \"outer\"\n"
               "ObjectBegin \"o\" NamedMaterial \"m\" Shape \"disk\" ObjectEnd\n"
               "Volume \"homogeneous\" \"point p0\" [0 0 0] \"point p1\" [1 1 1]\n"
               "LightSource \"point\" ObjectInstance \"o\" WorldEnd\n"),
      with({"lights/point", "shapes/disk", "materials/plastic", "textures/scale",
            "textures/checkerboard", "volumes/homogeneous", "integrators/single"}));
}

// Building the tree of many lights takes longer than reading them.
TEST(Lean, WhatChoosesLightsIsPreparedForThoseWhoChooseSo) {
  const auto prepared = [](const std::string& integrator) {
    const auto scene =
        buildText("Integrator " + integrator +
                  "\nWorldBegin LightSource \"point\" LightSource \"point\" WorldEnd\n");
    return std::pair(!scene->lightTree().empty(), scene->lightPowers().total() > 0);
  };
  const std::pair none(false, false), tree(true, false), powers(false, true);
  EXPECT_EQ(prepared("\"directlighting\""), none);
  EXPECT_EQ(prepared("\"directlighting\" \"string strategy\" \"one\""), none);
  EXPECT_EQ(prepared("\"directlighting\" \"string strategy\" \"weighted\""), tree);
  EXPECT_EQ(prepared("\"whitted\""), none);
  EXPECT_EQ(prepared("\"ambientocclusion\""), none);
  for (const std::string path : {"\"path\"", "\"volpath\""}) {
    EXPECT_EQ(prepared(path + "\"string lightsamplestrategy\" \"uniform\""), none);
    EXPECT_EQ(prepared(path + "\"string lightsamplestrategy\" \"power\""), powers);
    EXPECT_EQ(prepared(path + "\"string lightsamplestrategy\" \"spatial\""), tree);
  }
}

}  // namespace
}  // namespace pbrt::test
