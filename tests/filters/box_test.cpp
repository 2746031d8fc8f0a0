#include "tests/support.h"

namespace pbrt {
namespace {

TEST(BoxFilter, IsOneInsideAndOnTheEdge) {
  const auto f = test::make<Filter>("box");
  EXPECT_EQ(f->radius(), Vec2(0.5F));
  for (const Vec2& p : {Vec2(0, 0), Vec2(0.5F, 0.5F), Vec2(-0.5F, 0.2F), Vec2(0.499F, -0.5F)})
    EXPECT_EQ(f->evaluate(p), 1);
  EXPECT_EQ(f->evaluate({0.5001F, 0}), 0);
}

}  // namespace
}  // namespace pbrt
