#include "shapes/files/ply.h"

#include <fmt/format.h>

#include <cmath>

namespace pbrt::files {

bool PlyElement::hasLists() const {
  return std::any_of(properties.begin(), properties.end(),
                     [](const PlyProperty& p) { return p.lengthType.has_value(); });
}

std::optional<std::size_t> PlyElement::find(std::span<const std::string_view> names) const {
  for (const std::string_view wanted : names)
    for (std::size_t i = 0; i < properties.size(); ++i)
      if (properties[i].name == wanted) return i;
  return {};
}

PlyFile::PlyFile(const Input& input) : input_(input), scanner_(input) {
  readHeader();
}

NumberType PlyFile::readType() {
  using enum NumberType;
  static constexpr std::pair<std::string_view, NumberType> kTypes[] = {
      {"char", int8},     {"int8", int8},       {"uchar", uint8},    {"uint8", uint8},
      {"short", int16},   {"int16", int16},     {"ushort", uint16},  {"uint16", uint16},
      {"int", int32},     {"int32", int32},     {"uint", uint32},    {"uint32", uint32},
      {"float", float32}, {"float32", float32}, {"double", float64}, {"float64", float64}};
  const std::string_view word = scanner_.word();
  for (const auto& [name, type] : kTypes)
    if (name == word) return type;
  scanner_.fail(word, fmt::format("\"{}\" is not a type of PLY", word.substr(0, 40)));
}

void PlyFile::readProperty() {
  PlyProperty property;
  Scanner afterKeyword = scanner_;
  if (afterKeyword.word() == "list") {
    scanner_ = afterKeyword;
    property.lengthType = readType();
  }
  property.type = readType();
  property.name = scanner_.word();
  elements_.back().properties.push_back(std::move(property));
}

void PlyFile::readHeader() {
  if (scanner_.line() != "ply") input_.fail("is not a PLY file: it does not begin with \"ply\"");
  bool hasFormat = false;
  while (true) {
    const std::string_view word = scanner_.word();
    if (word == "end_header") {
      if (!hasFormat) scanner_.fail(word, "the header says no format");
      return scanner_.endLine();
    }
    if (word == "comment" || word == "obj_info") {
      scanner_.line();
      continue;
    }
    if (word == "format") {
      const std::string_view format = scanner_.word();
      ascii_ = format == "ascii";
      if (format == "binary_big_endian")
        order_ = std::endian::big;
      else if (!ascii_ && format != "binary_little_endian")
        scanner_.fail(format,
                      "the format must be ascii, binary_little_endian or binary_big_endian");
      scanner_.word();  // the version, 1.0 for ever
      hasFormat = true;
    } else if (word == "element") {
      PlyElement& element = elements_.emplace_back();
      element.name = scanner_.word();
      element.count = scanner_.count();
    } else if (word == "property" && !elements_.empty()) {
      readProperty();
    } else {
      scanner_.fail(word,
                    "a line of the header begins with format, element, property, comment, "
                    "obj_info or end_header");
    }
    scanner_.endLine();
  }
}

// Binary data have no lines.
void PlyFile::failAt(const char* at, const std::string& message) const {
  if (ascii_) input_.failAtText({at, at}, message);
  input_.failAtByte(at, message);
}

// Bytes, where every list is empty.
std::size_t PlyFile::smallestRow(const PlyElement& element) const {
  if (ascii_) return 2 * element.properties.size();  // a digit and white space
  std::size_t size = 0;
  for (const PlyProperty& p : element.properties) size += sizeOf(p.lengthType.value_or(p.type));
  return size;
}

void PlyFile::checkRoom(const PlyElement& element) const {
  const std::size_t size = smallestRow(element);
  const std::size_t left = scanner_.left() + ascii_;  // the last line may lack its end
  if (size > 0 && element.count > left / size)
    failAt(
        scanner_.position(),
        fmt::format("{} times \"{}\", of at least {} bytes, should follow, but {} bytes are left",
                    element.count, element.name, size, scanner_.left()));
}

double PlyFile::next(NumberType type) {
  if (ascii_) return scanner_.number();
  if (scanner_.left() < sizeOf(type)) failAt(scanner_.position(), "the file ends here, too early");
  const double value = loadNumber(scanner_.position(), type, order_);
  scanner_.skip(sizeOf(type));
  return value;
}

std::size_t PlyFile::listLength(NumberType type) {
  const char* at = scanner_.position();
  const double length = next(type);
  if (!(length >= 0 && length <= 0x1p32 && length == std::floor(length)))
    failAt(at, fmt::format("a list cannot have {} entries", length));
  return static_cast<std::size_t>(length);
}

void PlyFile::read(const PlyElement& element, std::span<const std::optional<Target>> targets) {
  checkRoom(element);
  const std::size_t size = smallestRow(element);
  if (size == 0) return;
  const auto target = [&](std::size_t i) { return i < targets.size() ? targets[i] : std::nullopt; };
  if (ascii_ || element.hasLists()) {
    for (std::size_t row = 0; row < element.count; ++row) {
      for (std::size_t i = 0; i < element.properties.size(); ++i) {
        const PlyProperty& property = element.properties[i];
        if (property.lengthType) {
          for (std::size_t n = listLength(*property.lengthType); n > 0; --n) next(property.type);
        } else {
          const double value = next(property.type);
          if (const auto to = target(i)) to->store(row, static_cast<float>(value));
        }
      }
      if (ascii_) scanner_.endLine();
    }
    return;
  }
  std::vector<Field> fields;
  std::size_t offset = 0;
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const NumberType type = element.properties[i].type;
    if (const auto to = target(i)) fields.push_back({offset, type, *to});
    offset += sizeOf(type);
  }
  copyRecords(scanner_.position(), size, element.count, order_, fields);
  scanner_.skip(element.count * size);
}

void PlyFile::readLists(const PlyElement& element, std::size_t wanted, const Visit& visit) {
  checkRoom(element);
  std::vector<double> list;
  for (std::size_t row = 0; row < element.count; ++row) {
    row_ = scanner_.position();
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      if (i == wanted) list.clear();
      std::size_t n = property.lengthType ? listLength(*property.lengthType) : 1;
      for (; n > 0; --n) {
        const double value = next(property.type);
        if (i == wanted) list.push_back(value);
      }
    }
    visit(row, list);
    if (ascii_) scanner_.endLine();
  }
}

}  // namespace pbrt::files
