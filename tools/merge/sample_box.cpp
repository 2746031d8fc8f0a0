#include "sample_box.h"

#include <fmt/format.h>

namespace pbrt {

namespace {

// Adds to `rest` what `box` holds beside `part`: slabs before and behind it, axis by axis.
void cut(SampleBox box, const SampleBox& part, std::vector<SampleBox>& rest) {
  if (!overlap(box, part)) return rest.push_back(box);
  for (const int axis : {2, 1, 0}) {
    SampleBox before = box, behind = box;
    before.hi[axis] = part.lo[axis];
    behind.lo[axis] = part.hi[axis];
    if (box.lo[axis] < part.lo[axis]) rest.push_back(before);
    if (part.hi[axis] < box.hi[axis]) rest.push_back(behind);
    box.lo[axis] = std::max(box.lo[axis], part.lo[axis]);
    box.hi[axis] = std::min(box.hi[axis], part.hi[axis]);
  }
}

// Whether two boxes that do not overlap are one together: they are if they differ along one axis
// alone and touch there.
bool areOne(const SampleBox& a, const SampleBox& b) {
  int different = 0;
  bool touch = false;
  for (int axis = 0; axis < 3; ++axis) {
    if (a.lo[axis] == b.lo[axis] && a.hi[axis] == b.hi[axis]) continue;
    ++different;
    touch = a.hi[axis] == b.lo[axis] || b.hi[axis] == a.lo[axis];
  }
  return different == 1 && touch;
}

void join(std::vector<SampleBox>& boxes) {
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = 0; j < boxes.size();) {
      if (i != j && areOne(boxes[i], boxes[j])) {
        boxes[i] = hull(std::vector{boxes[i], boxes[j]});
        boxes.erase(boxes.begin() + static_cast<std::ptrdiff_t>(j));
        i -= j < i;
        j = 0;
      } else {
        ++j;
      }
    }
}

}  // namespace

std::string describe(const SampleBox& box, Point2i resolution) {
  std::string text = fmt::format("--samples {}..{}", box.lo.z, box.hi.z);
  if (box.pixels() != Bounds2i{Point2i(0), resolution})
    text += fmt::format(" --pixelbounds {},{},{},{}", box.lo.x, box.hi.x, box.lo.y, box.hi.y);
  return text;
}

SampleBox common(const SampleBox& a, const SampleBox& b) {
  SampleBox both;
  both.lo = glm::max(a.lo, b.lo);
  both.hi = glm::min(a.hi, b.hi);
  return both;
}

bool overlap(const SampleBox& a, const SampleBox& b) {
  const SampleBox both = common(a, b);
  return glm::all(glm::lessThan(both.lo, both.hi));
}

std::optional<std::pair<std::size_t, std::size_t>> overlapping(std::span<const SampleBox> boxes) {
  for (std::size_t j = 1; j < boxes.size(); ++j)
    for (std::size_t i = 0; i < j; ++i)
      if (overlap(boxes[i], boxes[j])) return std::pair(i, j);
  return {};
}

SampleBox hull(std::span<const SampleBox> boxes) {
  SampleBox all = boxes.front();
  for (const SampleBox& box : boxes) {
    all.lo = glm::min(all.lo, box.lo);
    all.hi = glm::max(all.hi, box.hi);
  }
  return all;
}

std::vector<SampleBox> missing(const SampleBox& whole, std::span<const SampleBox> boxes) {
  std::vector<SampleBox> rest{whole};
  for (const SampleBox& box : boxes) {
    std::vector<SampleBox> less;
    for (const SampleBox& piece : rest) cut(piece, box, less);
    rest = std::move(less);
  }
  join(rest);
  return rest;
}

}  // namespace pbrt
