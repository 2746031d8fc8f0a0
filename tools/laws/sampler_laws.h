#pragma once
// The laws of samplers come from two files.

#include "law.h"

namespace pbrt::laws {

// Throws Error, also if it cannot be cloned: then no thread could have it.
inline std::unique_ptr<Sampler> makeSampler(const Subject& subject, int samplesPerPixel,
                                            std::uint64_t seed = 0, Point2i resolution = {64, 64}) {
  auto sampler = subject.make<Sampler>({seed, samplesPerPixel, resolution});
  if (!sampler->clone()) throw Error("its clone() gives no sampler", Failure::plugin);
  return sampler;
}

inline bool inUnit(float u) {
  return u >= 0 && u < 1;
}
inline bool inUnit(Point2 p) {
  return inUnit(p.x) && inUnit(p.y);
}

// What the numbers are as chance variables, in sampler_spread_laws.cpp.
void samplesAreUniform(const Subject& subject, Judge& judge);
void setsAreUniform(const Subject& subject, Judge& judge);
void dimensionsAndPixelsAreIndependent(const Subject& subject, Judge& judge);
void dimensionsAreNotAligned(const Subject& subject, Judge& judge);
void samplesAreWellSpread(const Subject& subject, Judge& judge);
void setsAreWellSpread(const Subject& subject, Judge& judge);

}  // namespace pbrt::laws
