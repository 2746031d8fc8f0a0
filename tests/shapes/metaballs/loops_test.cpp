// The loops for every instruction set give the same bits, and the linker cannot mix them up.

#include "shapes/metaballs/loops.h"

#include <bit>
#include <sstream>

#include "tests/command.h"
#include "tests/shapes/metaballs/clouds.h"

namespace pbrt::metaballs::test {
namespace {

// An answer as the bits of its numbers.
using Bits = std::vector<std::uint64_t>;

template <class... T>
Bits bitsOf(T... values) {
  return {std::bit_cast<std::uint64_t>(static_cast<double>(values))...};
}
void add(Bits& bits, const Floats& lanes) {
  for (int k = 0; k < kLanes; ++k) bits.push_back(std::bit_cast<std::uint32_t>(lanes[k]));
}

// Every set's answer is that of the portable one, which comes back.
template <class Answer>
Bits sameOnAll(const Answer& answer) {
  Bits first = answer(*allLoops()[0]);
  for (std::size_t i = 1; i < allLoops().size(); ++i)
    EXPECT_EQ(answer(*allLoops()[i]), first) << "instruction set " << i;
  return first;
}

Bits sample(const Loops& loops, const Field& field, const DPoint3& p, AtomList list) {
  const FieldSample s = loops.sample(field.kernel(), field.atoms(), p, list);
  Bits bits = bitsOf(s.value, s.error, s.bend, s.jump, s.strongest);
  for (int i = 0; i < 3; ++i) {
    const Bits column = bitsOf(s.gradient[i], s.hessian[i][0], s.hessian[i][1], s.hessian[i][2]);
    bits.insert(bits.end(), column.begin(), column.end());
  }
  return bits;
}

Bits bounds(const Loops& loops, const Field& field, const Eight& boxes, AtomList list, bool tight) {
  EightBounds b;
  std::vector<std::uint8_t> masks(list.size());
  loops.bounds(field.kernel(), field.atoms(), list, boxes, tight, masks.data(), b);
  Bits bits(masks.begin(), masks.end());
  bits.push_back(b.undecided);
  for (const Paraboloid* p : {&b.below, &b.above})
    for (const Floats& lanes : {p->a, p->b[0], p->b[1], p->b[2], p->g}) add(bits, lanes);
  add(bits, b.slack);
  return bits;
}

Bits find(const Loops& loops, const Field& field, AtomList list, RayQuery query) {
  Effort effort;
  query.effort = &effort;
  const auto t = loops.find(field.kernel(), field.atoms(), list, query);
  return bitsOf(t.has_value(), t.value_or(0), effort.floats, effort.doubles);
}

// Boxes of about `size` around one place in or near the box.
Eight randomBoxes(Random& random, const Bounds3& about, double size) {
  Eight boxes;
  for (int axis = 0; axis < 3; ++axis) {
    const double edge = about.diagonal()[axis], place = about.lo[axis] + edge * random.in(-1, 2);
    for (int lane = 0; lane < kLanes; ++lane) {
      boxes.centre[axis][lane] = static_cast<float>(place + size * edge * random.in(-0.5, 0.5));
      boxes.half[axis][lane] = static_cast<float>(size * edge * random.in(0, 0.5));
    }
  }
  return boxes;
}

class MetaballLoops : public testing::TestWithParam<Kernel> {
 protected:
  // Calls visit(field, cell, list, random) for many cells of fields of several sizes and scales.
  template <class Visit>
  static void forCells(const Visit& visit) {
    for (const int count : {1, 2, 40, 400})
      for (const double carving : {0.0, 0.2})
        for (const double unit : {1.0, 1e-4}) {
          const Field field = cloud(count, GetParam(), carving, unit, 7);
          const Cells cells(field);
          Random random(3);
          for (std::size_t i = 0; i < cells.cells().size(); i += 1 + cells.cells().size() / 50)
            visit(field, cells.cells()[i], cells.atoms(cells.cells()[i]), random);
        }
  }
};

TEST_P(MetaballLoops, SampleTheSameBits) {
  forCells([](const Field& field, const Cell& cell, AtomList list, Random& random) {
    const DVec3 size(cell.box.diagonal());
    for (int i = 0; i < 20; ++i) {
      const DPoint3 p = DPoint3(cell.box.centre()) + size * random.cube();
      sameOnAll([&](const Loops& loops) { return sample(loops, field, p, list); });
    }
  });
}

TEST_P(MetaballLoops, BoundTheSameBits) {
  std::size_t inside = 0;
  forCells([&](const Field& field, const Cell& cell, AtomList list, Random& random) {
    for (int i = 0; i < 10; ++i) {
      const Eight boxes = randomBoxes(random, cell.box, std::pow(0.6, i));
      for (const bool tight : {false, true})
        sameOnAll([&](const Loops& loops) { return bounds(loops, field, boxes, list, tight); });
      if (field.carves()) continue;
      inside += sameOnAll([&](const Loops& loops) {
                  return bitsOf(loops.allInside(field.kernel(), field.atoms(), list, boxes));
                }) != bitsOf(0);
    }
  });
  EXPECT_GT(inside, 100U);
}

TEST_P(MetaballLoops, FindTheSameBits) {
  std::size_t hits = 0, rays = 0;
  forCells([&](const Field& field, const Cell& cell, AtomList list, Random& random) {
    const DPoint3 c(cell.box.centre());
    const double size = glm::length(DVec3(cell.box.diagonal()));
    for (int i = 0; i < 40; ++i, ++rays) {
      const DPoint3 to = c + 0.3 * size * random.cube();
      const DVec3 d = random.in(0.5, 3) * random.direction();
      const ObjectRay ray{to - random.in(0, 20) * size * d, d};
      RayQuery query;
      query.ray = &ray;
      query.lo = DPoint3(cell.box.lo), query.hi = DPoint3(cell.box.hi);
      query.near = cell.box.centre();
      query.any = i % 4 == 0;
      query.acceptable = i % 4 == 1 ? 1e-3 * size : 0;
      hits += sameOnAll([&](const Loops& loops) { return find(loops, field, list, query); })[0] !=
              bitsOf(0)[0];
    }
  });
  EXPECT_GT(hits, rays / 10);
  EXPECT_LT(hits, rays);
}

INSTANTIATE_TEST_SUITE_P(Kernels, MetaballLoops,
                         testing::Values(Kernel::poly6, Kernel::wyvill, Kernel::blob,
                                         Kernel::gaussian),
                         [](const auto& test) {
                           return std::string(kKernels[static_cast<std::size_t>(test.param)]);
                         });

// A function that two object files define is linked once. Were it not in the namespace of its
// instruction set, what runs everywhere might be code for the best machine.
TEST(MetaballLoopsObjects, DefineFunctionsOfTheirOwnNamespaceAlone) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__OPTIMIZE__)
  GTEST_SKIP() << "small functions are inlined in optimised builds alone";
#endif
  const pbrt::test::Folder folder;
  for (const std::string set : {"avx2", "avx512"}) {
    const std::string object =
        PBRT_BUILD_DIR "/shapes/metaballs/CMakeFiles/metaballs_" + set + ".dir/loops.cpp.o";
    if (!std::filesystem::exists(object)) continue;  // another kind of processor
    const auto nm =
        folder.command("nm --defined-only --extern-only --format=posix '" + object + "'");
    ASSERT_EQ(nm.code, 0) << nm.err;
    // In a mangled name a namespace stands with the length of its own.
    const std::string ours = std::to_string(set.size()) + set;
    std::istringstream lines(nm.out);
    std::size_t functions = 0;
    for (std::string name, type, rest; lines >> name >> type && std::getline(lines, rest);) {
      if (type != "T" && type != "W") continue;
      EXPECT_NE(name.find(ours), name.npos) << name;
      ++functions;
    }
    EXPECT_GT(functions, 10U);
  }
}

}  // namespace
}  // namespace pbrt::metaballs::test
