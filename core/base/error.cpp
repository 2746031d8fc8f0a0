#include "core/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace pbrt {
namespace {

// Lines longer than this are quoted as a window about the mark.
constexpr std::size_t kWindow = 96;
constexpr std::string_view kEllipsis = "...";

// Bytes after the first of a UTF-8 sequence take no column on the screen.
bool continuesCharacter(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

char printable(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return (byte < ' ' && c != '\t') || byte == 0x7F ? '?' : c;
}

// Quotes the part of the line about the mark at `column` (from 0), cut between characters.
void quote(Diagnostic& d, std::string_view line, std::size_t column) {
  std::size_t from = 0;
  std::size_t to = line.size();
  if (line.size() > kWindow) {
    from = std::min(column - std::min(column, kWindow / 2), line.size() - kWindow);
    to = from + kWindow;
    while (from < column && continuesCharacter(line[from])) ++from;
    while (to < line.size() && to > column && continuesCharacter(line[to])) --to;
  }
  if (from > 0) d.quote = kEllipsis;
  d.quoteColumn = d.quote.size() + column - from;
  for (const char c : line.substr(from, to - from)) d.quote += printable(c);
  if (to < line.size()) d.quote += kEllipsis;
}

void locate(Diagnostic& d, const Location& where) {
  if (!where.source) return;
  const std::string_view text = where.source->text;
  const std::size_t begin = std::min(where.begin, text.size());
  std::size_t lineBegin = begin == 0 ? 0 : text.rfind('\n', begin - 1) + 1;  // npos + 1 == 0
  if (lineBegin == 0 && begin >= 3 && text.starts_with("\xEF\xBB\xBF")) lineBegin = 3;
  std::size_t lineEnd = std::min(text.find('\n', begin), text.size());
  if (lineEnd > begin && text[lineEnd - 1] == '\r') --lineEnd;

  d.file = where.source->name;
  d.line = 1 + static_cast<std::size_t>(std::count(text.begin(), text.begin() + begin, '\n'));
  d.column = begin - lineBegin + 1;
  d.length = std::clamp<std::size_t>(where.length, 1, std::max<std::size_t>(1, lineEnd - begin));
  quote(d, text.substr(lineBegin, lineEnd - lineBegin), begin - lineBegin);
}

std::string formatAll(const std::vector<Diagnostic>& diagnostics) {
  std::string all;
  for (const Diagnostic& d : diagnostics) {
    if (!all.empty()) all += '\n';
    all += format(d);
  }
  return all;
}

// Edits from a to b: insert, delete, replace, swap of neighbours; case is free (the optimal string
// alignment distance; Damerau 1964, "A technique for computer detection and correction of
// spelling errors").
std::size_t editDistance(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  // Three rows of the table of distances between the first i of a and the first j of b.
  std::vector<std::size_t> beforeLast(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(beforeLast, last);
    std::swap(last, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) &&
          lower(a[i - 2]) == lower(b[j - 1]))
        row[j] = std::min(row[j], beforeLast[j - 2] + 1);
    }
  }
  return row[b.size()];
}

}  // namespace

Diagnostic diagnose(Severity severity, const Location& where, std::string message) {
  Diagnostic d;
  d.severity = severity;
  d.message = std::move(message);
  locate(d, where);
  return d;
}

std::string format(const Diagnostic& d) {
  constexpr std::string_view kSeverity[] = {"note", "warning", "error"};
  const std::string_view severity = kSeverity[static_cast<int>(d.severity)];
  if (d.file.empty()) return fmt::format("{}: {}", severity, d.message);

  // The mark stands under the quote: tabs stay tabs, a character of several bytes is one column.
  std::string mark;
  for (const char c : std::string_view(d.quote).substr(0, d.quoteColumn))
    if (!continuesCharacter(c)) mark += c == '\t' ? '\t' : ' ';
  mark += '^';
  for (std::size_t i = 1; i < d.length && d.quoteColumn + i < d.quote.size(); ++i)
    if (!continuesCharacter(d.quote[d.quoteColumn + i])) mark += '~';

  const std::string line = std::to_string(d.line);
  return fmt::format("{}:{}:{}: {}: {}\n {} | {}\n {:{}} | {}", d.file, line, d.column, severity,
                     d.message, line, d.quote, "", line.size(), mark);
}

Error::Error(const std::string& message, Failure failure) : Error(Location{}, message, failure) {}

Error::Error(const Location& where, const std::string& message, Failure failure)
    : Error(std::vector{diagnose(Severity::error, where, message)}, failure) {}

Error::Error(std::vector<Diagnostic> diagnostics, Failure failure)
    : std::runtime_error(formatAll(diagnostics)),
      diagnostics_(std::move(diagnostics)),
      failure_(failure) {}

Error Error::at(const Location& where) const {
  std::vector<Diagnostic> placed = diagnostics_;
  for (Diagnostic& d : placed)
    if (d.file.empty()) locate(d, where);
  return Error(std::move(placed), failure_);
}

std::string shown(std::string_view name, std::size_t most) {
  return std::string(name.substr(0, most)) + (name.size() > most ? "..." : "");
}

std::string_view closest(std::string_view name, std::span<const std::string> candidates) {
  std::string_view best;
  std::size_t allowed = name.size() / 3;
  for (const std::string& candidate : candidates) {
    // Each edit changes the length by at most one.
    const std::size_t longer = std::max(name.size(), candidate.size());
    if (longer - std::min(name.size(), candidate.size()) > allowed) continue;
    const std::size_t distance = editDistance(name, candidate);
    if (distance > allowed) continue;
    best = candidate;
    if (distance == 0) break;
    allowed = distance - 1;  // from here on only a nearer one
  }
  return best;
}

std::string didYouMean(std::string_view name, std::span<const std::string> candidates) {
  const std::string_view near = closest(name, candidates);
  return near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near);
}

}  // namespace pbrt
