#include "report.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "page.h"
#include "pictures.h"
#include "tools/compare/flip.h"

namespace pbrt {

namespace {

using Json = nlohmann::ordered_json;

Json orNull(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? Json(*value) : Json();
}

// "name": the mean, "nameError": its standard error.
void put(Json& to, const std::string& name, const Estimate& e) {
  to[name] = orNull(e.value);
  to[name + "Error"] = orNull(e.error);
}

Image colourOnly(const Image& image) {
  Image copy;
  copy.window = image.window;
  copy.resolution = image.resolution;
  for (const char* name : {"R", "G", "B"}) {
    copy.names.emplace_back(name);
    copy.channels.push_back(*image.channel(name));
  }
  return copy;
}

Json toJson(const Snapshot& s) {
  const auto mean = [&](auto member) { return s.mean([&](const Run& r) { return member(r); }); };
  const double samples = mean([](const Run& r) { return r.samples; }).value;
  Json json{{"samples", std::llround(samples)}, {"seeds", s.runs.size()}};
  put(json, "seconds", mean([](const Run& r) { return r.seconds; }));
  const double cpu = mean([](const Run& r) { return r.cpuSeconds; }).value;
  json["cpuSeconds"] = cpu;
  json["rays"] = mean([](const Run& r) { return static_cast<double>(r.rays); }).value;
  put(json, "rmse", mean([](const Run& r) { return r.errors.rmse; }));
  put(json, "relMse", mean([](const Run& r) { return r.errors.relMse; }));
  put(json, "mae", mean([](const Run& r) { return r.errors.mae; }));
  put(json, "flip", mean([](const Run& r) { return r.flip; }));
  json["biasShare"] = orNull(s.biasShare);
  json["biasZ"] = orNull(s.biasZ);
  const double mse = mean([](const Run& r) { return r.errors.mse; }).value;
  json["efficiency"] = orNull(1 / (mse * cpu));
  json["runs"] = Json::array();
  for (const Run& r : s.runs)
    json["runs"].push_back({{"samples", r.samples},
                            {"seconds", r.seconds},
                            {"cpuSeconds", r.cpuSeconds},
                            {"rays", r.rays},
                            {"mse", orNull(r.errors.mse)},
                            {"relMse", orNull(r.errors.relMse)},
                            {"mae", orNull(r.errors.mae)},
                            {"flip", orNull(r.flip)}});
  json["thumbnail"] = dataUri(thumbnail(s.picture, 128));
  return json;
}

std::string machine() {
  return fmt::format("{} cores", std::max(1U, std::thread::hardware_concurrency()));
}

// Replaces the only occurrence.
void fill(std::string& page, std::string_view placeholder, std::string_view text) {
  page.replace(page.find(placeholder), placeholder.size(), text);
}

}  // namespace

Json toJson(const Report& report) {
  Json json{{"title", "Error against run time"},
            {"command", report.command},
            {"date", fmt::format("{:%FT%TZ}", fmt::gmtime(std::time(nullptr)))},
            {"software", "pbrt " PBRT_VERSION},
            {"threads", report.threads},
            {"machine", machine()},
            {"interleaved", true},
            {"notes", report.notes},
            {"references", Json::array()},
            {"variants", Json::array()}};
  for (const Reference& r : report.references) {
    json["references"].push_back({{"scene", r.scene},
                                  {"description", r.description},
                                  {"samples", r.samples ? Json(*r.samples) : Json()},
                                  {"rmse", r.mse ? orNull(std::sqrt(*r.mse)) : Json()},
                                  {"width", r.image.window.width()},
                                  {"height", r.image.window.height()},
                                  {"picture", dataUri(colourOnly(r.image))}});
  }
  for (std::size_t i = 0; i < report.curves.size(); ++i) {
    const Variant& v = (*report.variants)[i];
    const Curve& curve = report.curves[i];
    const Reference& reference = report.references[report.referenceOf[i]];
    Json variant{{"label", v.label},
                 {"scene", reference.scene},
                 {"reference", report.referenceOf[i]},
                 {"statements", v.statements},
                 {"parseSeconds", v.parseSeconds},
                 {"buildSeconds", v.buildSeconds},
                 {"slope", Json()}};
    if (curve.slope)
      variant["slope"] = {{"value", curve.slope->value},
                          {"error", orNull(curve.slope->error)},
                          {"against", "seconds"},
                          {"points", curve.slopePoints}};
    variant["snapshots"] = Json::array();
    for (const Snapshot& s : curve.snapshots) variant["snapshots"].push_back(toJson(s));
    const Image& last = curve.snapshots.back().picture;
    variant["picture"] = dataUri(colourOnly(last));
    variant["errorMap"] = dataUri(
        heatMap(flip(reference.image, last).values, last.window.width(), last.window.height()));
    json["variants"].push_back(std::move(variant));
  }
  return json;
}

std::string toText(const Json& report, int indent) {
  return report.dump(indent, ' ', false, Json::error_handler_t::replace);
}

std::string toHtml(const Json& report) {
  // To a browser "<" in a script may mean its end, or a comment; in a string \u003c is the same.
  std::string numbers;
  for (const char c : toText(report, -1)) {
    if (c == '<')
      numbers += "\\u003c";
    else
      numbers += c;
  }
  std::string page = kPageHtml;
  fill(page, "/*STYLE*/", kPageStyle);
  fill(page, "/*SCRIPT*/", kPageScript);
  fill(page, "/*REPORT*/null", numbers);  // last: a label may look like a placeholder
  return page;
}

std::string toCsv(const Json& report) {
  constexpr std::array kColumns = {
      "samples", "seeds",     "seconds",   "secondsError", "cpuSeconds", "rays",
      "rmse",    "rmseError", "relMse",    "relMseError",  "mae",        "maeError",
      "flip",    "flipError", "biasShare", "biasZ",        "efficiency"};
  // RFC 4180: a quotation mark within a text is doubled.
  const auto quoted = [](std::string text) {
    for (std::size_t at = 0; (at = text.find('"', at)) != std::string::npos; at += 2)
      text.insert(at, 1, '"');
    return '"' + text + '"';
  };
  std::string csv = "scene,variant,parseSeconds,buildSeconds";
  for (const char* column : kColumns) csv += fmt::format(",{}", column);
  csv += ",slope,slopeError\n";
  for (const Json& v : report["variants"])
    for (const Json& s : v["snapshots"]) {
      csv += fmt::format("{},{},{},{}", quoted(v["scene"]), quoted(v["label"]),
                         v["parseSeconds"].dump(), v["buildSeconds"].dump());
      const auto add = [&](const Json& value) {
        csv += value.is_null() ? "," : "," + value.dump();
      };
      for (const char* column : kColumns) add(s[column]);
      const Json none;
      add(v["slope"].is_null() ? none : v["slope"]["value"]);
      add(v["slope"].is_null() ? none : v["slope"]["error"]);
      csv += '\n';
    }
  return csv;
}

std::string toTable(const Json& report) {
  std::size_t longest = 0;
  for (const Json& v : report["variants"])
    longest = std::max(longest, v["label"].get_ref<const std::string&>().size());
  std::string table =
      fmt::format("{:<{}} {:>8} {:>9} {:>9} {:>10} {:>10} {:>7} {:>7} {:>15}\n", "", longest,
                  "samples", "render s", "CPU s", "RMSE", "relMSE", "FLIP", "biased", "slope");
  const auto number = [](const Json& value, int digits = 4) {
    return value.is_null() ? std::string("-") : fmt::format("{:.{}g}", value.get<double>(), digits);
  };
  for (const Json& v : report["variants"]) {
    const Json& s = v["snapshots"].back();
    std::string slope = "-";
    if (!v["slope"].is_null()) {
      slope = fmt::format("{:.3f}", v["slope"]["value"].get<double>());
      if (!v["slope"]["error"].is_null())
        slope += fmt::format(" +- {:.3f}", v["slope"]["error"].get<double>());
    }
    const std::string biased = s["biasShare"].is_null()
                                   ? "-"
                                   : fmt::format("{:.1f} %", 100 * s["biasShare"].get<double>());
    table += fmt::format("{:<{}} {:>8} {:>9} {:>9} {:>10} {:>10} {:>7} {:>7} {:>15}\n",
                         v["label"].get<std::string>(), longest, s["samples"].dump(),
                         number(s["seconds"]), number(s["cpuSeconds"]), number(s["rmse"]),
                         number(s["relMse"]), number(s["flip"], 3), biased, slope);
  }
  return table;
}

}  // namespace pbrt
