#include "records.h"

namespace pbrt::files {
namespace {

// use(T()) for the C++ type T.
template <class Use>
auto withType(NumberType type, Use use) {
  using enum NumberType;
  switch (type) {
    case int8:  // NOLINT(bugprone-branch-clone): each branch has a type of its own
      return use(std::int8_t());
    case uint8:
      return use(std::uint8_t());
    case int16:
      return use(std::int16_t());
    case uint16:
      return use(std::uint16_t());
    case int32:
      return use(std::int32_t());
    case uint32:
      return use(std::uint32_t());
    case int64:
      return use(std::int64_t());
    case uint64:
      return use(std::uint64_t());
    case float32:
      return use(float());
    case float64:
      break;
  }
  return use(double());
}

template <class T, std::endian order>
void copyField(const char* from, std::size_t size, std::size_t count, const Target& to,
               std::size_t record) {
  for (std::size_t i = 0; i < count; ++i, from += size)
    to.store(record + i, static_cast<float>(load<T>(from, order)));
}

}  // namespace

std::size_t sizeOf(NumberType type) {
  return withType(type, [](auto number) { return sizeof(number); });
}

float colorScale(NumberType type) {
  if (type == NumberType::uint8) return 1.F / 255;
  if (type == NumberType::uint16) return 1.F / 65535;
  return 1;
}

double loadNumber(const char* p, NumberType type, std::endian order) {
  return withType(
      type, [&](auto number) { return static_cast<double>(load<decltype(number)>(p, order)); });
}

void copyRecords(const char* first, std::size_t size, std::size_t count, std::endian order,
                 std::span<const Field> fields) {
  // Field by field, but only as many records as stay in the nearest cache meanwhile.
  const std::size_t block = std::max<std::size_t>(1, 16384 / size);
  for (std::size_t i = 0; i < count; i += block)
    for (const Field& field : fields)
      withType(field.type, [&](auto number) {
        const auto copy = order == std::endian::big
                              ? copyField<decltype(number), std::endian::big>
                              : copyField<decltype(number), std::endian::little>;
        copy(first + i * size + field.offset, size, std::min(block, count - i), field.to, i);
      });
}

}  // namespace pbrt::files
