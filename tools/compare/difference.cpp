#include "tools/compare/difference.h"

#include <fmt/format.h>

#include <bit>

#include "tools/compare/metrics.h"

namespace pbrt {

namespace {

std::string text(const Bounds2i& b) {
  return fmt::format("[{}, {}) x [{}, {})", b.lo.x, b.hi.x, b.lo.y, b.hi.y);
}

struct AttributeText {
  std::string operator()(const std::string& v) const { return '"' + v + '"'; }
  std::string operator()(const glm::dmat4& m) const {
    std::string result = "[";
    for (int column = 0; column < 4; ++column)
      for (int row = 0; row < 4; ++row) result += fmt::format(" {:g}", m[column][row]);
    return result + " ]";
  }
  template <class Number>
  std::string operator()(Number v) const {
    return fmt::format("{}", v);
  }
};

std::string valueOf(const Image& image, const std::string& attribute) {
  const auto found = image.attributes.find(attribute);
  return found == image.attributes.end() ? "none" : std::visit(AttributeText(), found->second);
}

}  // namespace

Image withoutChannels(Image image, std::span<const std::string> names) {
  for (std::size_t i = image.names.size(); i-- > 0;)
    if (std::any_of(names.begin(), names.end(), [&](const std::string& name) {
          return image.names[i] == name || image.names[i].starts_with(name + ".");
        })) {
      image.names.erase(image.names.begin() + static_cast<std::ptrdiff_t>(i));
      image.channels.erase(image.channels.begin() + static_cast<std::ptrdiff_t>(i));
    }
  return image;
}

void compareLayout(const Image& reference, const Image& test, bool varianceIsOptional,
                   Findings& findings) {
  if (reference.window != test.window)
    findings.failures.push_back(
        fmt::format("unlike pixels (data window): {} in the reference, {} in the test",
                    text(reference.window), text(test.window)));
  if (reference.resolution != test.resolution)
    findings.failures.push_back(fmt::format(
        "unlike size of the whole picture (display window): {} x {} in the reference, {} x {} in "
        "the test",
        reference.resolution.x, reference.resolution.y, test.resolution.x, test.resolution.y));
  const auto missing = [&](const Image& from, const Image& in, std::string_view whose) {
    for (const std::string& name : from.names) {
      if (in.channel(name)) continue;
      const bool optional = varianceIsOptional && name.starts_with("Variance.");
      (optional ? findings.notes : findings.failures)
          .push_back(fmt::format("the {} has no channel {}", whose, name));
    }
  };
  missing(reference, test, "test");
  missing(test, reference, "reference");
}

void findNonFinite(const Image& image, std::string_view whose, Findings& findings) {
  for (std::size_t c = 0; c < image.names.size(); ++c) {
    const std::vector<float>& values = image.channels[c];
    const auto bad = [](float v) { return !std::isfinite(v); };
    const auto first = std::find_if(values.begin(), values.end(), bad);
    if (first == values.end()) continue;
    const Point2i at = pixelAt(image, static_cast<std::size_t>(first - values.begin()));
    findings.failures.push_back(fmt::format(
        "the {}'s channel {} has {} values that are not finite; the first, {}, at pixel ({}, {})",
        whose, image.names[c], std::count_if(first, values.end(), bad), *first, at.x, at.y));
  }
}

bool isOfTheRun(std::string_view attribute) {
  constexpr std::string_view kOfTheRun[] = {"renderTimeSeconds", "seed",      "scene", "software",
                                            "capDate",           "utcOffset", "owner", "comments"};
  return std::find(std::begin(kOfTheRun), std::end(kOfTheRun), attribute) != std::end(kOfTheRun);
}

void compareMetadata(const Image& reference, const Image& test, bool strict, Findings& findings) {
  const auto tell = [&](const std::string& name) {
    (strict && !isOfTheRun(name) ? findings.failures : findings.notes)
        .push_back(fmt::format("unlike metadata {}: {} in the reference, {} in the test", name,
                               valueOf(reference, name), valueOf(test, name)));
  };
  for (const auto& [name, value] : reference.attributes) {
    const auto other = test.attributes.find(name);
    if (other == test.attributes.end() || other->second != value) tell(name);
  }
  for (const auto& [name, value] : test.attributes)
    if (!reference.attributes.contains(name)) tell(name);
}

std::vector<ChannelDifference> compareChannels(const Image& reference, const Image& test) {
  std::vector<ChannelDifference> result;
  for (std::size_t c = 0; c < reference.names.size(); ++c) {
    const std::vector<float>* other = test.channel(reference.names[c]);
    if (other == nullptr) continue;
    const std::vector<float>& values = reference.channels[c];
    ChannelDifference difference{.name = reference.names[c]};
    for (std::size_t i = 0; i < values.size(); ++i) {
      const float a = values[i], b = (*other)[i];
      if (std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b)) continue;
      if (difference.differing++ == 0) difference.first = pixelAt(reference, i);
      // Not a number is the largest of all, and stays so.
      if (const double d = std::abs(double{b} - double{a});
          !(d <= difference.largest) && !std::isnan(difference.largest))
        difference.largest = d;
    }
    result.push_back(difference);
  }
  return result;
}

Image signedDifference(const Image& reference, const Image& test) {
  Image result{.window = reference.window, .resolution = reference.resolution};
  for (std::size_t c = 0; c < reference.names.size(); ++c) {
    const std::vector<float>* other = test.channel(reference.names[c]);
    if (other == nullptr) continue;
    result.names.push_back(reference.names[c]);
    std::vector<float>& values = result.channels.emplace_back(reference.channels[c]);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = (*other)[i] - values[i];
  }
  return result;
}

}  // namespace pbrt
