#pragma once
// What pbrt-converge leaves behind: a page for people, the same numbers for programs.

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "measure.h"

namespace pbrt {

// Everything that was measured.
struct Report {
  std::string command;  // as it was typed
  int threads = 0;
  std::vector<std::string> notes;
  std::vector<Reference> references;
  const std::vector<Variant>* variants = nullptr;
  std::vector<std::size_t> referenceOf;  // one per variant
  std::vector<Curve> curves;             // one per variant
};

// The contents of report.json; the page draws itself from the same, tools/converge/report.html.
nlohmann::ordered_json toJson(const Report& report);

// As text, indented by so many spaces a level, on one line if -1; bytes that are no UTF-8 are
// replaced.
std::string toText(const nlohmann::ordered_json& report, int indent);

// The page: report.html with its style, its script and the numbers in it.
std::string toHtml(const nlohmann::ordered_json& report);

// A row for each snapshot.
std::string toCsv(const nlohmann::ordered_json& report);

// Aligned columns for a terminal: the last snapshot of every variant.
std::string toTable(const nlohmann::ordered_json& report);

}  // namespace pbrt
