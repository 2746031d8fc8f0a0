#include "tools/compare/flip_viewer.h"

#include <fmt/format.h>

#include "core/base/error.h"

namespace pbrt {

namespace {

constexpr double kPi2 = std::numbers::pi * std::numbers::pi;

// A primary or the white of chromaticity (x, y) and luminance 1 is p = (x/y, 1, (1-x-y)/y); the
// luminances s of the three primaries make white, P s = w (ITU-R BT.709-6, item 1.3; the last
// digits of D65 are those in the authors' matrix).
glm::dmat3 relativeXyz() {
  const auto xyz = [](double x, double y) { return DVec3(x / y, 1, (1 - x - y) / y); };
  const glm::dmat3 primaries(xyz(0.64, 0.33), xyz(0.30, 0.60), xyz(0.15, 0.06));
  const DVec3 white = xyz(0.31271, 0.32902);
  const DVec3 s = glm::inverse(primaries) * white;
  return {primaries[0] * s[0] / white, primaries[1] * s[1] / white, primaries[2] * s[2] / white};
}

// Samples f at -r ... r, scaled: the positive values then sum to `sum`, any negative ones to -sum.
template <class F>
Kernel makeKernel(int r, double sum, F f) {
  double positive = 0, negative = 0;
  for (int i = -r; i <= r; ++i) (f(i) > 0 ? positive : negative) += std::abs(f(i));
  Kernel k;
  for (int i = -r; i <= r; ++i)
    k.push_back(f(i) == 0 ? 0 : sum * f(i) / (f(i) > 0 ? positive : negative));
  return k;
}

// Pixels that hold three standard deviations.
int threeSigma(double sigma) {
  return static_cast<int>(std::ceil(3 * sigma));
}

}  // namespace

DVec3 huntLab(const DVec3& xyz) {
  // CIE 15:2004, section 8.2.1.
  const auto f = [](double t) {
    constexpr double d = 6. / 29;
    return t > d * d * d ? std::cbrt(t) : t / (3 * d * d) + 4. / 29;
  };
  const double x = f(xyz.x), y = f(xyz.y), z = f(xyz.z);
  const double lightness = 116 * y - 16;
  return {lightness, 0.01 * lightness * 500 * (x - y), 0.01 * lightness * 200 * (y - z)};
}

double colourDistance(const DVec3& a, const DVec3& b) {
  const double hyAb = std::abs(a.x - b.x) + std::sqrt(sqr(a.y - b.y) + sqr(a.z - b.z));
  return std::pow(hyAb, 0.7);
}

Viewer::Viewer(double pixelsPerDegree)
    : toXyz(relativeXyz()),
      toRgb(glm::inverse(relativeXyz())),
      largestDistance(colourDistance(huntLab(toXyz[1]), huntLab(toXyz[2]))) {
  if (!(pixelsPerDegree >= 1 && pixelsPerDegree <= 1000))
    throw Error(fmt::format("{} pixels per degree; FLIP takes 1 to 1000", pixelsPerDegree),
                Failure::usage);

  const double a[] = {34.1, 13.5}, b[] = {0.04, 0.025};
  const int r = threeSigma(std::sqrt(b[0] / (2 * kPi2)) * pixelsPerDegree);  // of the widest
  const auto response = [&](double bandwidth) {
    return [=](int i) { return std::exp(-kPi2 * sqr(i / pixelsPerDegree) / bandwidth); };
  };
  lightness = makeKernel(r, 1, response(0.0047));
  redGreen = makeKernel(r, 1, response(0.0053));
  double weight[2] = {};
  for (int j = 0; j < 2; ++j) {
    double sum = 0;
    for (int i = -r; i <= r; ++i) sum += response(b[j])(i);
    weight[j] = a[j] * std::sqrt(std::numbers::pi / b[j]) * sqr(sum);
  }
  for (int j = 0; j < 2; ++j)
    blueYellow[j] = {makeKernel(r, 1, response(b[j])),
                     makeKernel(r, weight[j] / (weight[0] + weight[1]), response(b[j]))};

  const double sigma = 0.5 * 0.082 * pixelsPerDegree;  // a feature is 0.082 degrees wide
  const auto gauss = [=](int i) { return std::exp(-sqr(i / sigma) / 2); };
  blur = makeKernel(threeSigma(sigma), 1, gauss);
  edge = makeKernel(threeSigma(sigma), 1, [=](int i) { return i * gauss(i); });
  point = makeKernel(threeSigma(sigma), 1, [=](int i) { return (sqr(i / sigma) - 1) * gauss(i); });
}

}  // namespace pbrt
