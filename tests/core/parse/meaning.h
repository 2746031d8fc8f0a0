#pragma once
// What a statement says, wherever it stands.

#include <algorithm>
#include <bit>

#include "core/parse/directive.h"

namespace pbrt::test {

// A directive without its places; numbers as their bits, so that -0 is not 0.
struct Meaning {
  explicit Meaning(const Directive& d) : kind(d.kind), words(d.words), params(d.params) {
    for (std::size_t i = 0; i < bits.size(); ++i)
      bits[i] = std::bit_cast<std::uint64_t>(d.numbers[i]);
  }
  bool operator==(const Meaning& other) const {
    return kind == other.kind && words == other.words && bits == other.bits &&
           std::ranges::equal(params, other.params, same);
  }
  static bool same(const Param& a, const Param& b) {
    if (a.type != b.type || a.name != b.name || a.values.index() != b.values.index()) return false;
    const auto* floats = std::get_if<std::vector<float>>(&a.values);
    if (!floats) return a.values == b.values;
    return std::ranges::equal(*floats, std::get<std::vector<float>>(b.values), {},
                              std::bit_cast<std::uint32_t, float>,
                              std::bit_cast<std::uint32_t, float>);
  }

  DirectiveKind kind;
  std::vector<std::string> words;
  std::array<std::uint64_t, 16> bits{};
  ParamList params;
};

}  // namespace pbrt::test
