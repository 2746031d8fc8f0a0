#pragma once
// What a film file says of itself, as text.

#include <string>
#include <string_view>

#include "core/scene/film_file.h"

namespace pbrt {

// As JSON on one line. Numbers come back with the same bits, strings with the same bytes.
std::string filmHeader(const FilmInfo& info);

// The other way. Throws std::exception: it is no such text, or makes no sense.
FilmInfo readFilmHeader(std::string_view text);

}  // namespace pbrt
