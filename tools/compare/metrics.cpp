#include "tools/compare/metrics.h"

#include <functional>

#include "core/base/error.h"

namespace pbrt {

double trimmedMean(std::vector<double> terms) {
  // A few terms of dark pixels with a firefly would outweigh all others.
  if (std::all_of(terms.begin(), terms.end(), [](double t) { return std::isfinite(t); })) {
    const auto dropped = static_cast<std::ptrdiff_t>(terms.size() / 1000);
    std::nth_element(terms.begin(), terms.begin() + dropped, terms.end(), std::greater<>());
    terms.erase(terms.begin(), terms.begin() + dropped);
  }
  double sum = 0;
  for (const double term : terms) sum += term;
  return sum / static_cast<double>(terms.size());
}

Errors measureErrors(const Image& reference, const Image& test) {
  if (reference.window != test.window || reference.window.empty())
    throw Error("the pictures do not have the same pixels", Failure::usage);
  Errors e;
  std::vector<double> relative;
  for (const char* name : {"R", "G", "B"}) {
    const auto *r = reference.channel(name), *t = test.channel(name);
    if (r == nullptr || t == nullptr)
      throw Error("errors need pictures with channels R, G and B", Failure::usage);
    for (std::size_t i = 0; i < r->size(); ++i) {
      const double a = (*r)[i], b = (*t)[i];
      const double difference = std::abs(b - a);
      e.mse += sqr(difference);
      e.mae += difference;
      e.meanReference += a;
      e.meanTest += b;
      relative.push_back(sqr(difference) / (sqr(a) + 0.01));
      // Not a number is the largest of all, and stays so.
      if (!(difference <= e.largest) && !std::isnan(e.largest)) {
        e.largest = difference;
        e.largestPixel = pixelAt(reference, i);
      }
    }
  }
  const auto n = static_cast<double>(relative.size());
  e.mse /= n;
  e.rmse = std::sqrt(e.mse);
  e.mae /= n;
  e.meanReference /= n;
  e.meanTest /= n;

  e.relMse = trimmedMean(std::move(relative));
  return e;
}

}  // namespace pbrt
