#pragma once
// The laws of cameras come from two files.

#include "core/base/rng.h"
#include "parameters.h"

namespace pbrt::laws {

// Where a law puts a camera.
struct Place {
  Point2i resolution;
  Transform toRender;
};

// A turned, moved, mirrored and stretched camera space.
inline Transform awkward() {
  return Transform::translate({3, -2, 7}) * Transform::rotate(50, {1, 2, -1}) *
         Transform::scale({-2, 2, 2});
}
inline std::array<Place, 4> places() {
  return {{{{640, 480}, {}}, {{640, 480}, awkward()}, {{1, 1}, awkward()}, {{300, 700}, {}}}};
}

inline std::unique_ptr<Camera> makeCamera(const Subject& subject, const Place& place,
                                          const ParamList& more = {}) {
  return with(subject, more).make<Camera>({place.toRender, place.resolution});
}
// Whether it can be made with these parameters before its own.
inline bool acceptsCamera(const Subject& subject, const ParamList& more) {
  return accepts<Camera>(subject, more, {{}, {640, 480}});
}

inline CameraSample randomSample(Rng& rng, Point2i resolution) {
  CameraSample s;
  s.film = Point2(rng.uniform(), rng.uniform()) * Point2(resolution);
  s.lens = {rng.uniform(), rng.uniform()};
  s.time = rng.uniform();
  return s;
}
inline std::string show(const CameraSample& s, const Place& place) {
  return fmt::format("film ({}, {}) of {} x {}, lens ({}, {}), time {}", s.film.x, s.film.y,
                     place.resolution.x, place.resolution.y, s.lens.x, s.lens.y, s.time);
}

// Of those of which a matrix can say what they show, in camera_film_laws.cpp.
void showsWhatTheMatrixSays(const Subject& subject, Judge& judge);
void lensFocuses(const Subject& subject, Judge& judge);
void extremeLensesFocus(const Subject& subject, Judge& judge);
void clipsByDepth(const Subject& subject, Judge& judge);
void screenWindowIsShown(const Subject& subject, Judge& judge);

}  // namespace pbrt::laws
