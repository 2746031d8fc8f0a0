#pragma once
// What a picture says of how it was made.

#include "core/scene/film_file.h"

namespace pbrt {

// The attributes of the picture of a film: its own, and firstSample, samplesPerPixel and
// renderTimeSeconds. If pixels have more samples than others, as they have in a render that was
// interrupted, samplesPerPixel is the least and mostSamplesPerPixel the most.
std::map<std::string, ImageAttribute> pictureAttributes(const FilmInfo& info);

}  // namespace pbrt
