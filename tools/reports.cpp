#include "reports.h"

#include <fmt/format.h>

#include <cstdio>

namespace pbrt {

void Reports::add(const Diagnostic& d) {
  const std::size_t count = ++counts_[static_cast<std::size_t>(d.severity)];
  if (d.severity < least_ || count > kMostShown + 1) return;
  if (count <= kMostShown)
    fmt::print(stderr, "{}\n", format(d));
  else
    fmt::print(stderr, "... more {}s are not shown\n",
               d.severity == Severity::error ? "error" : "warning");
}

}  // namespace pbrt
