#pragma once
// What is unlike about two pictures beside their errors: pixels, channels, values, metadata.

#include <span>
#include <string>
#include <vector>

#include "core/base/image.h"

namespace pbrt {

// Sentences for people. A failure means that the pictures are not comparable or not sound.
struct Findings {
  std::vector<std::string> failures, notes;
};

// How the values of a channel that both pictures have differ, bit for bit.
struct ChannelDifference {
  std::string name;
  std::size_t differing = 0;  // values
  double largest = 0;         // of |test - reference|
  Point2i first{0};           // the first differing pixel in scanline order
};

// The picture without these channels; a name stands for its layer too: "Variance" for "Variance.R".
Image withoutChannels(Image image, std::span<const std::string> names);

// Fails for unlike data or display windows, and for channels that only one of them has, but if
// `varianceIsOptional` for those named "Variance.*".
void compareLayout(const Image& reference, const Image& test, bool varianceIsOptional, Findings&);

// Fails for each channel that holds a value that is not a number or infinite.
void findNonFinite(const Image& image, std::string_view whose, Findings&);

// Tells unlike attributes; they are failures if `strict`, but for those that tell about the run and
// not about the picture, which are notes always: see isOfTheRun.
void compareMetadata(const Image& reference, const Image& test, bool strict, Findings&);
// "renderTimeSeconds", "seed", "scene", "software", "capDate", "utcOffset", "owner", "comments".
bool isOfTheRun(std::string_view attribute);

// The channels that both have, as in the reference. Their windows must be equal.
std::vector<ChannelDifference> compareChannels(const Image& reference, const Image& test);

// test - reference, of every channel that both have. Their windows must be equal.
Image signedDifference(const Image& reference, const Image& test);

}  // namespace pbrt
