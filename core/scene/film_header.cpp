#include "core/scene/film_header.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace pbrt {

namespace {

using Json = nlohmann::json;

[[noreturn]] void refuse() {
  throw std::runtime_error("its header makes no sense");
}

void require(bool sense) {
  if (!sense) refuse();
}

// JSON has neither infinities nor what is no number: they are strings.
Json ofNumber(double x) {
  return std::isfinite(x) ? Json(x) : Json(std::isnan(x) ? "nan" : x < 0 ? "-inf" : "inf");
}

double number(const Json& json) {
  if (!json.is_string()) return json.get<double>();
  for (const double x : {double{kInfinity}, -double{kInfinity}, std::nan("")})
    if (json == ofNumber(x)) return x;
  throw std::runtime_error("its header has a wrong number");
}

template <class Integer>
Integer integer(const Json& json, std::uint64_t least = 0,
                std::uint64_t most = std::numeric_limits<Integer>::max()) {
  require(json.is_number_unsigned());
  const auto value = json.get<std::uint64_t>();
  require(value >= least && value <= most);
  return static_cast<Integer>(value);
}

// JSON's strings are Unicode, those here any bytes, as in names of files: byte b is the character
// of number b, in UTF-8.
Json ofBytes(std::string_view bytes) {
  std::string text;
  for (const char c : bytes) {
    const auto b = static_cast<unsigned char>(c);
    if (b < 0x80) {
      text += c;
    } else {
      text += static_cast<char>(0xC0 | b >> 6);
      text += static_cast<char>(0x80 | (b & 0x3F));
    }
  }
  return text;
}

std::string bytes(const Json& json) {
  std::string bytes;
  const std::string text = json.get<std::string>();
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned b = static_cast<unsigned char>(text[i]);
    if (b >= 0x80) {
      require(b <= 0xC3 && i + 1 < text.size());
      b = (b & 3U) << 6U | (static_cast<unsigned char>(text[++i]) & 0x3FU);
    }
    bytes += static_cast<char>(b);
  }
  return bytes;
}

Json ofPoint(Point2i p) {
  return {p.x, p.y};
}

Point2i point(const Json& json) {
  constexpr int kMost = 1 << 20;
  return {integer<int>(json.at(0), 0, kMost), integer<int>(json.at(1), 0, kMost)};
}

// One member, whose name is that of the type.
struct ToJson {
  Json operator()(int x) const { return {{"int", x}}; }
  Json operator()(float x) const { return {{"float", ofNumber(x)}}; }
  Json operator()(double x) const { return {{"double", ofNumber(x)}}; }
  Json operator()(const std::string& x) const { return {{"string", ofBytes(x)}}; }
  Json operator()(const glm::dmat4& m) const {
    Json numbers = Json::array();
    for (int i = 0; i < 16; ++i) numbers.push_back(ofNumber(m[i / 4][i % 4]));
    return {{"matrix", numbers}};
  }
};

ImageAttribute attribute(const Json& json) {
  if (json.contains("int")) return json["int"].get<int>();
  if (json.contains("float")) return static_cast<float>(number(json["float"]));
  if (json.contains("double")) return number(json["double"]);
  if (json.contains("string")) return bytes(json["string"]);
  glm::dmat4 m;
  for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = number(json.at("matrix").at(i));
  return m;
}

Json ofAovs(AovSet aovs) {
  Json names = Json::array();
  for (const std::string_view name : aovNames())
    if (aovs & *aovByName(name)) names.push_back(name);
  return names;
}

AovSet aovSet(const Json& names) {
  AovSet aovs = 0;
  for (const Json& name : names) {
    const auto aov = aovByName(name.get<std::string>());
    require(aov.has_value());
    aovs |= *aov;
  }
  return aovs;
}

}  // namespace

std::string filmHeader(const FilmInfo& info) {
  Json attributes = Json::object();
  for (const auto& [name, value] : info.attributes)
    attributes[ofBytes(name).get<std::string>()] = std::visit(ToJson(), value);
  const Json json = {
      {"key",
       {{"scene", info.key.scene},
        {"programs", info.key.programs},
        {"seed", info.key.seed},
        {"samplesPerPixel", info.key.samplesPerPixel},
        {"settings", ofBytes(info.key.settings)}}},
      {"resolution", ofPoint(info.resolution)},
      {"window", {ofPoint(info.window.lo), ofPoint(info.window.hi)}},
      {"stored", ofAovs(info.aovs)},
      {"hidden", ofAovs(info.hidden)},
      {"firstSample", info.firstSample},
      {"reached", info.reached},
      {"endSample", info.endSample},
      {"passEnd", info.passEnd},
      {"origin", {ofNumber(info.origin.x), ofNumber(info.origin.y), ofNumber(info.origin.z)}},
      {"badSamples", info.badSamples},
      {"seconds", ofNumber(info.seconds)},
      {"attributes", attributes}};
  return json.dump();
}

FilmInfo readFilmHeader(std::string_view text) try {
  const Json json = Json::parse(text);
  FilmInfo info;
  const Json& key = json.at("key");
  info.key.scene = integer<std::uint64_t>(key.at("scene"));
  info.key.programs = integer<std::uint64_t>(key.at("programs"));
  info.key.seed = integer<std::uint64_t>(key.at("seed"));
  info.key.samplesPerPixel = integer<int>(key.at("samplesPerPixel"), 1);
  info.key.settings = bytes(key.at("settings"));

  info.resolution = point(json.at("resolution"));
  info.window = {point(json.at("window").at(0)), point(json.at("window").at(1))};
  for (int i = 0; i < 2; ++i)
    require(info.window.lo[i] < info.window.hi[i] && info.window.hi[i] <= info.resolution[i]);
  info.aovs = aovSet(json.at("stored"));
  info.hidden = aovSet(json.at("hidden"));

  info.firstSample = integer<std::uint32_t>(json.at("firstSample"));
  info.endSample = integer<std::uint32_t>(json.at("endSample"), info.firstSample);
  info.passEnd = integer<std::uint32_t>(json.at("passEnd"));
  for (const Json& end : json.at("reached"))
    info.reached.push_back(integer<std::uint32_t>(end, info.endSample));
  require(info.reached.empty() || std::ranges::min(info.reached) == info.endSample);

  for (int i = 0; i < 3; ++i) info.origin[i] = number(json.at("origin").at(i));
  info.badSamples = integer<std::uint64_t>(json.at("badSamples"));
  info.seconds = number(json.at("seconds"));
  require(std::isfinite(info.seconds) && info.seconds >= 0);
  for (const auto& [name, value] : json.at("attributes").items())
    info.attributes[bytes(name)] = attribute(value);
  return info;
} catch (const Json::exception&) {  // no JSON, something missing, or of another type
  refuse();
}

}  // namespace pbrt
