#pragma once
// Which samples a part of a render holds, and whether parts make a whole.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/base/bounds.h"

namespace pbrt {

// The same samples of each pixel of a window: those from lo.z up to, not including, hi.z of the
// pixels from (lo.x, lo.y) up to (hi.x, hi.y). Not empty.
struct SampleBox {
  using Corner = glm::vec<3, std::int64_t>;
  Corner lo{0}, hi{0};

  SampleBox() = default;
  SampleBox(const Bounds2i& pixels, std::uint32_t firstSample, std::uint32_t endSample)
      : lo(pixels.lo, firstSample), hi(pixels.hi, endSample) {}

  Bounds2i pixels() const { return {Point2i(lo), Point2i(hi)}; }
  bool operator==(const SampleBox&) const = default;
};

// As the options of pbrt that render it: "--samples 16..32 --pixelbounds 0,64,32,64", the latter
// only if it is not the whole picture.
std::string describe(const SampleBox& box, Point2i resolution);

bool overlap(const SampleBox& a, const SampleBox& b);
// What two that overlap have in common.
SampleBox common(const SampleBox& a, const SampleBox& b);
// The first two that overlap; none if no sample is held twice.
std::optional<std::pair<std::size_t, std::size_t>> overlapping(std::span<const SampleBox> boxes);

// The least box about one or more.
SampleBox hull(std::span<const SampleBox> boxes);
// What none of the boxes holds of `whole`, in few boxes that do not overlap.
std::vector<SampleBox> missing(const SampleBox& whole, std::span<const SampleBox> boxes);

}  // namespace pbrt
