#pragma once
// Binary numbers in records of one size, in either byte order.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>

namespace pbrt::files {

enum class NumberType : std::uint8_t {
  int8,
  uint8,
  int16,
  uint16,
  int32,
  uint32,
  int64,
  uint64,
  float32,
  float64
};

std::size_t sizeOf(NumberType type);

// What a stored colour is multiplied by: bytes and shorts without sign run to their largest value.
float colorScale(NumberType type);

// Turns the bytes of T about, if they are not in the machine's order.
template <class T>
T load(const char* p, std::endian order) {
  T value;
  char bytes[sizeof(T)];
  std::memcpy(bytes, p, sizeof(T));
  if (order != std::endian::native) std::reverse(bytes, bytes + sizeof(T));
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

double loadNumber(const char* p, NumberType type, std::endian order);

// Where one number of every record goes.
struct Target {
  float* first = nullptr;
  std::size_t stride = 1;
  float scale = 1;

  void store(std::size_t record, float value) const { first[record * stride] = scale * value; }
};

// One number of every record.
struct Field {
  std::size_t offset = 0;  // from the record's first byte
  NumberType type = NumberType::float32;
  Target to;
};

// Copies those fields of `count` records of `size` bytes to the places 0, 1, ... of their targets.
void copyRecords(const char* first, std::size_t size, std::size_t count, std::endian order,
                 std::span<const Field> fields);

}  // namespace pbrt::files
