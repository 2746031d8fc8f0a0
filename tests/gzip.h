#pragma once
// Packs bytes as gzip does; the test links zlib.

#include <gtest/gtest.h>
#include <zlib.h>

#include <string>

namespace pbrt::test {

// One member of a gzip file (RFC 1952).
inline std::string packed(const std::string& bytes) {
  z_stream stream{};
  constexpr int kGzip = 16;  // added to the size of the window
  EXPECT_EQ(deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, MAX_WBITS + kGzip, 8,
                         Z_DEFAULT_STRATEGY),
            Z_OK);
  std::string out(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

}  // namespace pbrt::test
