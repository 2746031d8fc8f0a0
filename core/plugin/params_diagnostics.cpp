// What Params says about parameters that are wrong, missing or unknown.

#include <fmt/format.h>

#include "core/plugin/params.h"

namespace pbrt {

namespace {

std::size_t count(const Param& p) {
  return std::visit([](const auto& v) { return v.size(); }, p.values);
}

}  // namespace

bool Params::has(const std::string& name) const {
  for (const Use& use : uses_)
    for (const Param& p : *use.list)
      if (p.name == name) return true;
  return false;
}

// The value that find() would choose; the statement, if there is none.
Location Params::place(const std::string& name) const {
  for (const Use& use : uses_)
    for (auto p = use.list->rbegin(); p != use.list->rend(); ++p)
      if (p->name == name) return count(*p) ? p->valueWhere : p->where;
  return where_;
}

void Params::fail(const std::string& name, const std::string& text) const {
  throw Error(place(name), message(fmt::format("\"{}\" {}", name, text)));
}

void Params::require(const std::string& name) const {
  if (!describing() && !has(name)) fail(name, "is missing");
}

void Params::warn(const std::string& name, const std::string& text) const {
  if (report_)
    report_(
        diagnose(Severity::warning, place(name), message(fmt::format("\"{}\" {}", name, text))));
}

std::vector<const Param*> Params::unread(std::size_t i) const {
  std::vector<const Param*> found;
  const Use& use = uses_.at(i);
  for (std::size_t k = 0; k < use.read.size(); ++k)
    if (!use.read[k]) found.push_back(&(*use.list)[k]);
  return found;
}

Diagnostic Params::unknown(const Param& param) const {
  return diagnose(Severity::error, param.where,
                  message(fmt::format("\"{}\" is not a parameter of it{}", param.name,
                                      didYouMean(param.name, known_))));
}

void Params::refuseUnread(std::size_t i) const {
  std::vector<Diagnostic> errors;
  for (const Param* param : unread(i)) errors.push_back(unknown(*param));
  if (!errors.empty()) throw Error(std::move(errors));
}

}  // namespace pbrt
