#include "core/scene/names.h"

#include <gtest/gtest.h>

#include "core/base/rng.h"

namespace pbrt {
namespace {

using Node = Named<int>;

// Random blocks within blocks, against a search from the last definition to the first.
TEST(Names, AreFoundAsByWalkingBack) {
  Rng rng(1);
  NamedList<int> names;
  std::vector<Node*> open = {nullptr};  // the last definition in each block
  for (int i = 0; i < 20000; ++i) {
    const double chance = rng.uniform();
    if (chance < 0.2) {
      open.push_back(open.back());
    } else if (chance < 0.4 && open.size() > 1) {
      open.pop_back();
    } else {
      names.add(open.back(), "n" + std::to_string(rng.uniform(30)), i);
    }
    const std::string wanted = "n" + std::to_string(rng.uniform(30));
    Node* walked = open.back();
    while (walked && walked->name != wanted) walked = walked->before;
    ASSERT_EQ(names.find(open.back(), wanted), walked) << i;
  }
}

TEST(Names, AnyEarlierOneIsReached) {
  NamedList<int> names;
  Node* last = nullptr;
  std::vector<Node*> all;
  for (int i = 0; i < 3000; ++i) {
    names.add(last, "x", i);
    all.push_back(last);
  }
  for (std::size_t depth = 0; depth < all.size(); depth += 7)
    for (std::size_t from = depth; from < all.size(); from += 101)
      ASSERT_EQ(all[from]->at(depth), all[depth]);
}

}  // namespace
}  // namespace pbrt
