#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "formats.h"
#include "quantities.h"
#include "shapes/files/scanner.h"

namespace pbrt::particles {

using files::Field, files::Scanner, files::convert, files::isBlank, files::isSpace;

namespace {

// The columns of a table without names.
constexpr std::array<std::string_view, 7> kColumns{"x", "y", "z", "radius", "r", "g", "b"};

class TableReader {
 public:
  explicit TableReader(const Input& input) : input_(input), scanner_(input) {}
  Particles read();

 private:
  bool nextRow();
  void findSeparator();
  bool isNamed() const;
  std::vector<std::string> readNames() const;
  void readRow(std::size_t row);
  const char* readNumber(const char* p, std::size_t column, float& value) const;
  const char* skipBlanks(const char* p) const;
  const char* skipCell(const char* p) const;

  const Input& input_;
  Scanner scanner_;
  std::string_view row_;  // the current one
  char separator_ = ' ';  // a blank: any number of blanks and tabs
  Columns columns_;
  std::vector<Target> targets_;  // of the columns that have one
  Particles particles_;
};

// The next line that is neither empty nor a comment.
bool TableReader::nextRow() {
  while (scanner_.left() > 0) {
    row_ = scanner_.line();
    const auto first = std::find_if_not(row_.begin(), row_.end(), isBlank);
    if (first != row_.end() && *first != '#') return true;
  }
  return false;
}

// The likeliest in the row, outside quotes and comments.
void TableReader::findSeparator() {
  std::string plain;
  bool quoted = false;
  for (const char c : row_.substr(0, row_.find('#'))) {
    if (c == '"') quoted = !quoted;
    if (!quoted) plain += c;
  }
  for (const char c : {';', ',', '\t'})
    if (plain.find(c) != plain.npos) {
      separator_ = c;
      return;
    }
}

const char* TableReader::skipBlanks(const char* p) const {
  const char* end = row_.data() + row_.size();
  while (p != end && isBlank(*p) && (separator_ == ' ' || *p != separator_)) ++p;
  return p;
}

// From the first byte of a cell, past quotes (which hold separators), to the separator or the end.
const char* TableReader::skipCell(const char* p) const {
  const char* end = row_.data() + row_.size();
  bool quoted = false;
  for (; p != end && (quoted || (*p != separator_ && !(separator_ == ' ' && isBlank(*p)))); ++p)
    if (*p == '"') quoted = !quoted;
  return p;
}

bool TableReader::isNamed() const {
  const char* begin = skipBlanks(row_.data());
  const char* end = skipCell(begin);
  if (begin != end && *begin == '"') ++begin;
  double number = 0;
  const char* next = convert(begin, end, number);
  return !next || (next != end && !isBlank(*next) && *next != '"');
}

std::vector<std::string> TableReader::readNames() const {
  std::vector<std::string> names;
  const char* end = row_.data() + row_.size();
  for (const char* p = skipBlanks(row_.data());;) {
    const char* cell = p;
    p = skipCell(p);
    std::string_view name(cell, p);
    while (!name.empty() && isBlank(name.back())) name.remove_suffix(1);
    if (name.size() > 1 && name.front() == '"' && name.back() == '"')
      name = name.substr(1, name.size() - 2);
    names.emplace_back(name);
    p = skipBlanks(p);
    if (p == end || *p == '#') return names;
    if (separator_ != ' ') p = skipBlanks(p + 1);
  }
}

const char* TableReader::readNumber(const char* p, std::size_t column, float& value) const {
  const char* end = row_.data() + row_.size();
  const bool quoted = p != end && *p == '"';
  const char* begin = p + quoted;
  const char* next = convert(begin, end, value);
  if (next && quoted) next = next != end && *next == '"' ? next + 1 : nullptr;
  if (next && next != end && !isBlank(*next) && *next != separator_ && *next != '#') next = nullptr;
  const auto fail = [&](std::string_view problem) {
    const std::string_view cell(p, skipCell(p));
    input_.failAtText(
        cell, fmt::format("\"{}\" in column {} {}", cell.substr(0, 40), column + 1, problem));
  };
  if (!next) fail("is not a number");
  if (value > 1 && columns_[column]->quantity == Quantity::color)
    fail("is a colour above 1: colours are given from 0 to 1");
  return next;
}

void TableReader::readRow(std::size_t row) {
  const char* end = row_.data() + row_.size();
  const char* p = skipBlanks(row_.data());
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (i > 0) {
      if (p == end)
        input_.failAtText(row_.substr(row_.size()),
                          fmt::format("only {} columns of {}", i, columns_.size()));
      if (separator_ != ' ' && *p != separator_)
        input_.failAtText({p, end}, fmt::format("column {} should have ended before", i));
      if (separator_ != ' ') p = skipBlanks(p + 1);
    }
    if (columns_[i]) {
      float value = 0;
      p = readNumber(p, i, value);
      targets_[i].store(row, value);
    } else {
      p = skipCell(p);
    }
    p = skipBlanks(p);
  }
  if (p != end && *p != '#')
    input_.failAtText({p, end}, fmt::format("more than {} columns", columns_.size()));
}

Particles TableReader::read() {
  if (input_.bytes().starts_with("\xEF\xBB\xBF")) scanner_.skip(3);  // a UTF-8 mark
  if (!nextRow()) input_.fail("holds no particles");
  findSeparator();
  const bool named = isNamed();
  if (!named && separator_ == '\t') separator_ = ' ';
  std::vector<std::string> names = readNames();
  if (!named) {
    if (names.size() != 3 && names.size() != 4 && names.size() != 7)
      input_.failAtText(row_, fmt::format("{} columns; without a row of names they must be x y z, "
                                          "x y z radius, or x y z radius r g b",
                                          names.size()));
    names.assign(kColumns.begin(), kColumns.begin() + names.size());
  }
  columns_ = columnsOf(names, input_);
  if (named && !nextRow()) input_.fail("holds no particles");

  // No more rows than lines, nor than a digit and a separator a column give, but for a last one
  // that is found too short as it is read.
  const auto begin = row_.data();
  const std::size_t left = input_.bytes().data() + input_.bytes().size() - begin + 1;
  const auto used = static_cast<std::size_t>(
      std::count_if(columns_.begin(), columns_.end(), [](auto& column) { return !!column; }));
  const auto lines = static_cast<std::size_t>(std::count(begin, begin + left - 1, '\n')) + 1;
  allocate(particles_, columns_, std::min(lines, left / (2 * used) + 1));
  for (const std::optional<Slot>& slot : columns_)
    targets_.push_back(slot ? target(particles_, *slot) : Target());
  std::size_t rows = 0;
  do readRow(rows++);
  while (nextRow());
  allocate(particles_, columns_, rows);
  return std::move(particles_);
}

}  // namespace

Particles readTable(const Input& input) {
  return TableReader(input).read();
}

bool isRaw(const Input& input) {
  const std::string_view beginning = input.bytes().substr(0, 1 << 16);
  const auto isControl = [](char c) { return (c >= 0 && c < ' ' && !isSpace(c)) || c == 0x7F; };
  const auto control = std::find_if(beginning.begin(), beginning.end(), isControl);
  if (control == beginning.end()) return false;
  // Tables are nearly all digits and separators. Of the bytes of floats few are, even where most
  // happen to be letters, as for coordinates near a million.
  const auto tabular = std::ranges::count_if(beginning, [](char c) {
    return std::string_view("0123456789+-.eE,; \t\r\n").find(c) != std::string_view::npos;
  });
  if (4 * static_cast<std::size_t>(tabular) > 3 * beginning.size())
    input.failAtByte(&*control, "is text but for this byte; is it damaged?");
  return true;
}

Particles readRaw(const Input& input) {
  constexpr std::size_t kSize = 3 * sizeof(float);
  const std::size_t count = input.bytes().size() / kSize;
  if (input.bytes().size() % kSize)
    input.failAtByte(input.bytes().data() + count * kSize,
                     "the file ends within a particle; each is three float32, 12 bytes");
  Particles particles;
  allocate(particles, Quantity::position, count);
  std::vector<Field> fields;
  for (std::uint8_t i = 0; i < 3; ++i)
    fields.push_back(
        {i * sizeof(float), NumberType::float32, target(particles, {Quantity::position, i})});
  copyRecords(input.bytes().data(), kSize, count, std::endian::little, fields);
  return particles;
}

}  // namespace pbrt::particles
