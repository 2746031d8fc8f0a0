#pragma once
// Parameters that laws add to those of their subject.

#include <algorithm>

#include "law.h"

namespace pbrt::laws {

inline Param number(std::string name, float v) {
  return {ParamType::number, std::move(name), {}, {}, std::vector<float>{v}};
}
inline Param numbers(std::string name, std::vector<float> v) {
  return {ParamType::number, std::move(name), {}, {}, std::move(v)};
}
inline Param integer(std::string name, int v) {
  return {ParamType::integer, std::move(name), {}, {}, std::vector<int>{v}};
}

// The subject with parameters that go before its own.
inline Subject with(Subject subject, const ParamList& more) {
  for (const Param& p : more)
    std::erase_if(subject.params, [&](const Param& own) { return own.name == p.name; });
  subject.params.insert(subject.params.end(), more.begin(), more.end());
  return subject;
}

// What a plug-in says it reads, as `pbrt --describe` shows it.
template <class Interface>
class Declared {
 public:
  explicit Declared(const Subject& subject, const typename Interface::Setup& setup = {}) {
    Params params = Params::describing(subject.plugin->name, all_);
    try {
      create<Interface>(*subject.plugin, params, setup);
    } catch (const Error&) {
      return;  // of zeros where something is required no object may come
    }
  }

  bool has(std::string_view name) const {
    return std::ranges::any_of(all_, [&](const Declaration& d) { return d.name == name; });
  }
  bool has(const ParamList& list) const {
    return std::ranges::all_of(list, [&](const Param& p) { return has(p.name); });
  }
  auto begin() const { return all_.begin(); }
  auto end() const { return all_.end(); }

 private:
  std::vector<Declaration> all_;
};

// Whether the subject can be made with these parameters before its own.
template <class Interface>
bool accepts(const Subject& subject, const ParamList& more,
             const typename Interface::Setup& setup = {}) {
  try {
    with(subject, more).template make<Interface>(setup);
    return true;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace pbrt::laws
