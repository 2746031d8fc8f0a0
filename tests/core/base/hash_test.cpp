#include "core/base/hash.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "core/base/rng.h"

namespace pbrt {
namespace {

// Films of every build are to agree: known answers, which many implementations quote.
TEST(HashBytes, IsXxh64) {
  EXPECT_EQ(hashBytes(""), 0xef46db3751d8e999ULL);
  EXPECT_EQ(hashBytes("a"), 0xd24ec4f1a98c6e5bULL);
  EXPECT_EQ(hashBytes("abc"), 0x44bc2cf5ad770999ULL);
  EXPECT_EQ(hashBytes("Nobody inspects the spammish repetition"), 0xfbcea83c8a378bf1ULL);
}

// Every length about the stripes of 32 bytes, each with the hash before as its seed: what libxxhash
// 0.8.1 says at the end.
TEST(HashBytes, IsXxh64ForAllLengthsAndSeeds) {
  std::string bytes;
  std::uint64_t hash = 0;
  for (int n = 0; n <= 200; ++n) {
    hash = hashBytes(bytes, hash);
    bytes += static_cast<char>(7 * n + 3);
  }
  EXPECT_EQ(hash, 0x03bb42792f3a3af9ULL);
}

TEST(HashBytes, SeesEveryBitAndEveryLength) {
  Rng rng(1);
  std::string bytes(100, '\0');
  for (char& c : bytes) c = static_cast<char>(rng.bits());
  std::set<std::uint64_t> seen{hashBytes(bytes)};
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    std::string other = bytes;
    other[bit / 8] = static_cast<char>(other[bit / 8] ^ 1 << bit % 8);
    EXPECT_TRUE(seen.insert(hashBytes(other)).second) << "bit " << bit;
  }
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_TRUE(seen.insert(hashBytes(bytes.substr(0, length))).second) << "length " << length;
  for (std::size_t zeros = 1; zeros < 100; ++zeros)
    EXPECT_TRUE(seen.insert(hashBytes(std::string(zeros, '\0'))).second) << zeros << " zeros";
}

TEST(HashBytes, OfSeveralTextsSeesWhereOneEnds) {
  EXPECT_NE(hashBytes("bc", hashBytes("a")), hashBytes("c", hashBytes("ab")));
  EXPECT_NE(hashBytes("a", hashBytes("b")), hashBytes("b", hashBytes("a")));
  EXPECT_NE(hashBytes("", hashBytes("a")), hashBytes("a"));
}

}  // namespace
}  // namespace pbrt
