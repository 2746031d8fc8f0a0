#pragma once
// Parameters that laws add to those of their subject.

#include <algorithm>

#include "law.h"
#include "making.h"

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

// What a plug-in says it reads.
class Declared {
 public:
  explicit Declared(const Subject& subject) : all_(declarationsOf(*subject.plugin)) {}

  bool has(std::string_view name) const {
    return std::ranges::find(all_, name, &Declaration::name) != all_.end();
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
