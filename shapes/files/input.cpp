#include "input.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/file.h"

namespace pbrt::files {

Input::Input(const std::filesystem::path& file) : Input(file.string(), readFile(file)) {}

void Input::fail(const std::string& message) const {
  throw Error(fmt::format("{}: {}", name_, message));
}

void Input::failAtByte(const char* at, const std::string& message) const {
  fail(fmt::format("byte {}: {}", at - bytes_.data(), message));
}

void Input::failAtText(std::string_view marked, const std::string& message) const {
  const std::string_view before(bytes_.data(), marked.data() - bytes_.data());
  const std::size_t lineBegin = before.rfind('\n') + 1;  // npos + 1 == 0
  const std::size_t lineEnd = std::min(bytes_.find('\n', before.size()), bytes_.size());
  const Source line{name_, bytes_.substr(lineBegin, lineEnd - lineBegin)};
  Diagnostic d =
      diagnose(Severity::error, {&line, before.size() - lineBegin, marked.size()}, message);
  d.line = 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
  throw Error({std::move(d)});
}

}  // namespace pbrt::files
