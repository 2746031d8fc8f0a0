#pragma once
// The PLY format (G. Turk, "The PLY Polygon File Format", 1994): ascii, or binary of either order.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "shapes/files/records.h"
#include "shapes/files/scanner.h"

namespace pbrt::files {

struct PlyProperty {
  std::string name;
  NumberType type = NumberType::float32;
  std::optional<NumberType> lengthType;  // of a list
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;

  bool hasLists() const;
  // The property of one of these names, an index; the first name that is there.
  std::optional<std::size_t> find(std::span<const std::string_view> names) const;
};

// A file whose elements are read one after the other, in the order of the header; everything throws
// Error at what is malformed.
class PlyFile {
 public:
  // Reads the header. The input must outlive this.
  explicit PlyFile(const Input& input);

  const std::vector<PlyElement>& elements() const { return elements_; }

  // Throws if the file cannot hold as many rows of the next element as its header says. To be asked
  // before making room for them.
  void checkRoom(const PlyElement& element) const;
  // Reads all rows of the next element: row i of each property that has a target goes to its place
  // i. Lists are skipped.
  void read(const PlyElement& element, std::span<const std::optional<Target>> targets);
  // Reads all rows of the next element: calls visit(row, values) with the list `property`.
  // What visit complains of by fail() names the place of the row.
  using Visit = std::function<void(std::size_t row, std::span<const double> values)>;
  void readLists(const PlyElement& element, std::size_t property, const Visit& visit);
  void skip(const PlyElement& element) { read(element, {}); }

  // About the row that is being visited.
  [[noreturn]] void fail(const std::string& message) const { failAt(row_, message); }

 private:
  void readHeader();
  void readProperty();
  NumberType readType();
  std::size_t smallestRow(const PlyElement& element) const;
  double next(NumberType type);
  std::size_t listLength(NumberType type);
  [[noreturn]] void failAt(const char* at, const std::string& message) const;

  const Input& input_;
  Scanner scanner_;
  bool ascii_ = true;
  std::endian order_ = std::endian::little;
  std::vector<PlyElement> elements_;
  const char* row_ = nullptr;
};

}  // namespace pbrt::files
