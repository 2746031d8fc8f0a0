#include "tools/compare/flip.h"

#include <array>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/base/spectrum.h"
#include "tools/compare/flip_viewer.h"

// "2020" is Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astrom, Fairchild 2020, "FLIP: A
// Difference Evaluator for Alternating Images"; "2021" is Andersson, Nilsson, Shirley,
// Akenine-Moeller 2021, "Visualizing Errors in Rendered High Dynamic Range Images". The constants
// are theirs.

namespace pbrt {

namespace {

// What is compared, without the pixels that are not finite: those are black in both.
struct Pair {
  int width = 0, height = 0;
  std::vector<Spectrum> reference, test;  // linear, not negative
  std::vector<std::size_t> notFinite;     // their indices
};

Pair readPair(const Image& reference, const Image& test) {
  if (reference.window != test.window || reference.window.empty())
    throw Error("the pictures do not have the same pixels", Failure::usage);
  const auto rgb = [](const Image& image) {
    const std::array channels{image.channel("R"), image.channel("G"), image.channel("B")};
    if (std::count(channels.begin(), channels.end(), nullptr) > 0)
      throw Error("FLIP needs pictures with channels R, G and B", Failure::usage);
    return channels;
  };
  const auto r = rgb(reference), t = rgb(test);
  Pair pair{reference.window.width(), reference.window.height(), {}, {}, {}};
  for (std::size_t i = 0; i < r[0]->size(); ++i) {
    Spectrum a((*r[0])[i], (*r[1])[i], (*r[2])[i]), b((*t[0])[i], (*t[1])[i], (*t[2])[i]);
    if (!isFinite(a) || !isFinite(b)) {
      pair.notFinite.push_back(i);
      a = b = Spectrum(0);
    }
    pair.reference.push_back(glm::max(a, Spectrum(0)));
    pair.test.push_back(glm::max(b, Spectrum(0)));
  }
  return pair;
}

// One channel of a picture.
struct Plane {
  int width, height;
  std::vector<double> values;
};

// Adds to `out` the row y of the plane, convolved along y and x. A picture goes on beyond its
// border with the border's colour.
void convolve(const Plane& in, int y, const Kernel& alongY, const Kernel& alongX,
              std::vector<double>& out) {
  const int r = radius(alongX), n = in.width;
  std::vector<double> padded(static_cast<std::size_t>(n + 2 * r));
  double* row = padded.data() + r;
  for (int j = 0; const double weight : alongY) {
    const int source = std::clamp(y + j++ - radius(alongY), 0, in.height - 1);
    const double* values = in.values.data() + static_cast<std::ptrdiff_t>(source) * n;
    for (int x = 0; x < n; ++x) row[x] += weight * values[x];
  }
  std::fill_n(padded.data(), r, row[0]);
  std::fill_n(row + n, r, row[n - 1]);
  const double* shifted = padded.data();
  for (const double weight : alongX) {
    for (int x = 0; x < n; ++x) out[x] += weight * shifted[x];
    ++shifted;
  }
}

// A picture in opponent channels: lightness Y, red-green X - Y and blue-yellow Y - Z, each of X, Y
// and Z over that of white (YCxCz of 2020 without the constants that drop out).
struct Opponent {
  Plane y, x, z;
};

// `display` turns linear light into what the screen shows, in [0, 1].
template <class Display>
Opponent onScreen(const std::vector<Spectrum>& pixels, const Pair& pair, const Viewer& viewer,
                  const Display& display) {
  const Plane plane{pair.width, pair.height, std::vector<double>(pixels.size())};
  Opponent out{plane, plane, plane};
  const auto width = static_cast<std::size_t>(pair.width);
  parallelFor(static_cast<std::size_t>(pair.height), [&](std::size_t y) {
    for (std::size_t i = y * width; i < (y + 1) * width; ++i) {
      const DVec3 xyz = viewer.toXyz * display(DVec3(pixels[i]));
      out.y.values[i] = xyz.y;
      out.x.values[i] = xyz.x - xyz.y;
      out.z.values[i] = xyz.y - xyz.z;
    }
  });
  return out;
}

// What the eye makes of a row of pixels.
struct Row {
  std::vector<DVec3> lab;
  std::vector<double> edges, points;  // their strength
};

Row look(const Opponent& picture, int y, const Viewer& viewer) {
  const std::vector<double> zero(static_cast<std::size_t>(picture.y.width));
  Row row{std::vector<DVec3>(zero.size()), zero, zero};

  std::vector<double> lightness = zero, redGreen = zero, blueYellow = zero;
  convolve(picture.y, y, viewer.lightness, viewer.lightness, lightness);
  convolve(picture.x, y, viewer.redGreen, viewer.redGreen, redGreen);
  for (const auto& [alongY, alongX] : viewer.blueYellow)
    convolve(picture.z, y, alongY, alongX, blueYellow);
  for (std::size_t i = 0; i < zero.size(); ++i) {
    const DVec3 xyz(lightness[i] + redGreen[i], lightness[i], lightness[i] - blueYellow[i]);
    row.lab[i] = huntLab(viewer.toXyz * glm::clamp(viewer.toRgb * xyz, 0., 1.));
  }

  const auto strength = [&](const Kernel& derivative) {
    std::vector<double> alongX = zero, alongY = zero;
    convolve(picture.y, y, viewer.blur, derivative, alongX);
    convolve(picture.y, y, derivative, viewer.blur, alongY);
    for (std::size_t i = 0; i < zero.size(); ++i)
      alongX[i] = std::sqrt(sqr(alongX[i]) + sqr(alongY[i]));
    return alongX;
  };
  row.edges = strength(viewer.edge);
  row.points = strength(viewer.point);
  return row;
}

// Raises each value of `errors` to the LDR-FLIP of the two pictures on screen.
template <class Display>
void raiseErrors(std::vector<float>& errors, const Pair& pair, const Viewer& viewer,
                 const Display& display) {
  const Opponent reference = onScreen(pair.reference, pair, viewer, display);
  const Opponent test = onScreen(pair.test, pair, viewer, display);
  parallelFor(static_cast<std::size_t>(pair.height), [&](std::size_t y) {
    const Row a = look(reference, static_cast<int>(y), viewer);
    const Row b = look(test, static_cast<int>(y), viewer);
    float* out = errors.data() + y * a.lab.size();
    for (std::size_t i = 0; i < a.lab.size(); ++i) {
      // Most of [0, 1] goes to the smaller differences (2020, section 4.1).
      constexpr double knee = 0.4, kneeTo = 0.95;
      const double distance = colourDistance(a.lab[i], b.lab[i]) / viewer.largestDistance;
      const double colour = distance < knee
                                ? kneeTo * distance / knee
                                : kneeTo + (1 - kneeTo) * (distance - knee) / (1 - knee);
      // Sections 4.2 and 4.3: a feature that is in one picture only makes the difference plainer.
      const double feature = std::sqrt(
          std::max(std::abs(a.edges[i] - b.edges[i]), std::abs(a.points[i] - b.points[i])) /
          std::numbers::sqrt2);
      out[i] = std::max(out[i], static_cast<float>(std::min(std::pow(colour, 1 - feature), 1.)));
    }
  });
}

FlipMap finish(std::vector<float> values, const Pair& pair) {
  for (const std::size_t i : pair.notFinite) values[i] = 1;
  double sum = 0;
  for (const float v : values) sum += v;
  const double mean = sum / static_cast<double>(values.size());
  return {std::move(values), mean};
}

// The filmic curve (a x^2 + b x) / (c x^2 + d x + e) that Narkowicz fitted to ACES ("ACES Filmic
// Tone Mapping Curve", 2016). The fit brightens by 1 / 0.6, as ACES does; 2021 undoes that.
constexpr double kA = 2.51, kB = 0.03, kC = 2.43, kD = 0.59, kE = 0.14, kExposure = 0.6;

// Exposures, in stops, from the shortest to the longest (2021).
std::vector<double> exposuresFor(const std::vector<Spectrum>& reference) {
  std::vector<float> light;
  for (const Spectrum& s : reference) light.push_back(luminance(s));
  const float brightest = *std::max_element(light.begin(), light.end());
  if (!(brightest > 0)) return {0};
  const auto median = [&] {
    const auto middle = light.begin() + static_cast<std::ptrdiff_t>(light.size() / 2);
    std::nth_element(light.begin(), middle, light.end());
    return *middle;
  };
  if (median() == 0) light.erase(std::remove(light.begin(), light.end(), 0.F), light.end());

  // The x that the curve maps to y = 0.85: (a - c y) x^2 + (b - d y) x - e y = 0.
  constexpr double y = 0.85, p = (kB - kD * y) / (kA - kC * y), q = -kE * y / (kA - kC * y);
  const double x = (-p / 2 + std::sqrt(sqr(p / 2) - q)) / kExposure;
  const double start = std::log2(x / brightest), stop = std::log2(x / median());
  const int n = std::max(2, static_cast<int>(std::ceil(stop - start)));
  std::vector<double> exposures;
  for (int i = 0; i < n; ++i) exposures.push_back(start + i * (stop - start) / (n - 1));
  return exposures;
}

}  // namespace

FlipMap flip(const Image& reference, const Image& test, double pixelsPerDegree) {
  const Viewer viewer(pixelsPerDegree);
  const Pair pair = readPair(reference, test);
  std::vector<float> errors(pair.reference.size());
  raiseErrors(errors, pair, viewer, [](const DVec3& light) { return glm::min(light, 1.0); });
  return finish(std::move(errors), pair);
}

FlipMap flipHdr(const Image& reference, const Image& test, double pixelsPerDegree) {
  const Viewer viewer(pixelsPerDegree);
  const Pair pair = readPair(reference, test);
  std::vector<float> errors(pair.reference.size());
  for (const double exposure : exposuresFor(pair.reference))
    raiseErrors(errors, pair, viewer,
                [scale = kExposure * std::exp2(exposure)](const DVec3& light) {
                  const DVec3 x = scale * light;
                  return glm::min(x * (kA * x + kB) / (x * (kC * x + kD) + kE), 1.0);
                });
  return finish(std::move(errors), pair);
}

}  // namespace pbrt
