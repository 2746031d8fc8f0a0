#include "core/plugin/roughness_params.h"

#include "tests/support.h"

namespace pbrt::test {
namespace {

Vec2 read(const ParamList& list, const std::string& prefix = "") {
  Params p("test", {}, {&list});
  const Vec2 roughness = Roughness(p, 0.5F, prefix)({});
  p.refuseUnread();
  return roughness;
}

TEST(RoughnessParams, AnAxisGoesBeforeTheCommonOne) {
  EXPECT_EQ(read({}), Vec2(0.5F));
  EXPECT_EQ(read({number("roughness", 0.1F)}), Vec2(0.1F));
  EXPECT_EQ(read({number("roughness", 0.1F), number("vroughness", 0.2F)}), Vec2(0.1F, 0.2F));
  EXPECT_EQ(read({number("uroughness", 0.3F)}), Vec2(0.3F, 0.5F));
  EXPECT_EQ(read({number("a.uroughness", 0.3F)}, "a."), Vec2(0.3F, 0.5F));
  EXPECT_THROW(read({number("uroughness", 0.3F)}, "a."), Error);
}

TEST(RoughnessParams, PerAxisKnowsNoCommonOne) {
  const ParamList list = {number("roughness", 0.1F), number("uroughness", 0.2F)};
  Params p("test", {}, {&list});
  EXPECT_EQ(Roughness::perAxis(p, 0.7F)({}), Vec2(0.2F, 0.7F));
  EXPECT_EQ(p.unread().size(), 1U);
}

FacetWidths widths(const ParamList& list, Vec2 roughness) {
  Params p("test", {}, {&list});
  return RoughnessMap(p)(roughness);
}

TEST(RoughnessParams, NoneIsSmoothInEveryGeneration) {
  for (const ParamList& list : {ParamList{}, ParamList{text("remapping", "v4")},
                                ParamList{flag("remaproughness", false)}}) {
    EXPECT_TRUE(widths(list, Vec2(0)).smooth);
    EXPECT_TRUE(widths(list, Vec2(-1)).smooth);
    EXPECT_FALSE(widths(list, Vec2(0.1F, 0)).smooth);
  }
}

TEST(RoughnessParams, Maps) {
  EXPECT_EQ(widths({text("remapping", "v4")}, {0.25F, 0.04F}).x, 0.5F);
  EXPECT_FLOAT_EQ(widths({text("remapping", "v4")}, {0.25F, 0.04F}).y, 0.2F);
  EXPECT_EQ(widths({flag("remaproughness", false)}, {0.25F, 0.04F}).y, 0.04F);
  EXPECT_EQ(widths({}, {0.25F, 1}).x, TrowbridgeReitz::alpha(0.25F));
  EXPECT_NEAR(widths({}, {0.25F, 1}).y, 1.62142, 1e-5);
}

}  // namespace
}  // namespace pbrt::test
