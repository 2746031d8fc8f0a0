#include "core/scene/dialect.h"

#include <gtest/gtest.h>

#include "core/parse/parse.h"

namespace pbrt {
namespace {

Dialect detected(const std::string& text) {
  std::vector<Directive> directives;
  Parser parser([&](Directive&& d) { directives.push_back(std::move(d)); });
  parser.text("test", text);
  return detectDialect(directives).dialect;
}

TEST(Dialect, TheFirstTellTaleDecides) {
  EXPECT_EQ(detected("SearchPath \"x\""), Dialect::v1);
  EXPECT_EQ(detected("WorldBegin Material \"shinymetal\" WorldEnd"), Dialect::v1);
  EXPECT_EQ(detected("Renderer \"sampler\" Integrator \"path\""), Dialect::v2);
  EXPECT_EQ(detected("Integrator \"path\" WorldBegin ActiveTransform All WorldEnd"), Dialect::v3);
  EXPECT_EQ(detected("MakeNamedMedium \"fog\" \"string type\" \"homogeneous\""), Dialect::v3);
}

TEST(Dialect, AmbiguousFilesCountAsV2) {
  EXPECT_EQ(detected("SurfaceIntegrator \"whitted\" WorldBegin Material \"matte\" WorldEnd"),
            Dialect::v2);
  EXPECT_EQ(detected(""), Dialect::v2);
}

TEST(Dialect, EveryGenerationsMaxdepthBecomesOurs) {
  const auto translated = [](Dialect dialect, const std::string& integrator) {
    ParamList params = {{ParamType::integer, "maxdepth", {}, {}, std::vector<int>{5}}};
    translateParameters(dialect, PluginKind::integrator, integrator, params);
    return std::get<std::vector<int>>(params[0].values).at(0);
  };
  EXPECT_EQ(translated(Dialect::v1, "whitted"), 6);
  EXPECT_EQ(translated(Dialect::v2, "whitted"), 5);
  EXPECT_EQ(translated(Dialect::v3, "whitted"), 5);
  EXPECT_EQ(translated(Dialect::v1, "path"), 6);
  EXPECT_EQ(translated(Dialect::v2, "path"), 6);
  EXPECT_EQ(translated(Dialect::v3, "path"), 5);
}

TEST(Dialect, NamesRoundTrip) {
  for (const Dialect d : {Dialect::v1, Dialect::v2, Dialect::v3})
    EXPECT_EQ(dialectByName(dialectName(d)), d);
  EXPECT_FALSE(dialectByName("v9"));
}

}  // namespace
}  // namespace pbrt
