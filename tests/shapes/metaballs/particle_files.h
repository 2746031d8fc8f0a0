#pragma once
// Particles, and the bytes of files that hold them, written here apart from the readers.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "core/base/error.h"
#include "core/base/rng.h"
#include "shapes/metaballs/particles/particles.h"

namespace pbrt::test {

// Numbers of every size; colours are multiples of 1/255, so that bytes hold them.
inline Particles someParticles(std::size_t count, std::uint64_t seed = 1) {
  Rng rng(seed);
  const auto real = [&] { return (rng.uniform() - 0.5F) * std::exp2(60 * rng.uniform() - 30); };
  const auto level = [&] { return std::floor(256 * rng.uniform()) / 255; };
  Particles p;
  for (std::size_t i = 0; i < count; ++i) {
    p.positions.emplace_back(real(), real(), real());
    p.radii.push_back(std::abs(real()));
    p.colors.emplace_back(level(), level(), level());
    p.velocities.emplace_back(real(), real(), real());
    p.strengths.push_back(real());
  }
  return p;
}

inline void expectSame(const Particles& read, const Particles& written) {
  EXPECT_EQ(read.positions, written.positions);
  EXPECT_EQ(read.radii, written.radii);
  EXPECT_EQ(read.velocities, written.velocities);
  EXPECT_EQ(read.strengths, written.strengths);
  ASSERT_EQ(read.colors.size(), written.colors.size());
  for (std::size_t i = 0; i < read.colors.size(); ++i)
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(read.colors[i][k], written.colors[i][k], 1e-7F) << i;
}

// What reading these bytes complains of; empty, if it does not.
inline std::string complaint(const std::string& name, const std::string& bytes) {
  try {
    readParticles(name, bytes);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

template <class T>
void put(std::string& bytes, T value, std::endian order) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  if (order != std::endian::native) std::reverse(raw, raw + sizeof value);
  bytes.append(raw, sizeof value);
}
inline void put(std::string& bytes, const Vec3& v, std::endian order) {
  for (int k = 0; k < 3; ++k) put(bytes, v[k], order);
}
inline std::uint8_t byteOf(float level) {
  return static_cast<std::uint8_t>(255 * level + 0.5F);
}

// All quantities, with elements before and after the particles, lists among their properties
// (unless `flat`), and properties that mean nothing.
inline std::string plyHeader(const char* format, std::size_t count, bool flat) {
  return fmt::format(
      "ply\nformat {} 1.0\ncomment made by hand\nelement camera 2\nproperty double fov\n"
      "property list uchar short views\nelement vertex {}\nproperty uint id\nproperty float x\n"
      "property float y\n{}property float z\nproperty uchar red\nproperty uchar green\n"
      "property uchar blue\nproperty float pscale\nproperty double vx\nproperty double vy\n"
      "property double vz\nproperty float strength\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n",
      format, count, flat ? "" : "property list int float neighbours\n");
}

inline std::string plyText(const Particles& p, bool flat = true) {
  std::string text = plyHeader("ascii", p.positions.size(), flat);
  text += "40.5 3 1 2 3\n35 0\n";
  for (std::size_t i = 0; i < p.positions.size(); ++i) {
    const Vec3 x = p.positions[i], c = p.colors[i], v = p.velocities[i];
    text += fmt::format("{} {} {} {}{} {} {} {} {} {} {} {} {}\n", i, x.x, x.y,
                        flat ? "" : "2 0.5 0.25 ", x.z, byteOf(c.x), byteOf(c.y), byteOf(c.z),
                        p.radii[i], v.x, v.y, v.z, p.strengths[i]);
  }
  return text + "3 0 1 2\n";
}

inline std::string plyBinary(const Particles& p, std::endian order, bool flat = true) {
  const bool big = order == std::endian::big;
  std::string bytes =
      plyHeader(big ? "binary_big_endian" : "binary_little_endian", p.positions.size(), flat);
  for (int i = 0; i < 2; ++i) {
    put(bytes, 40.5, order);
    put<std::uint8_t>(bytes, 3, order);
    for (std::int16_t k = 0; k < 3; ++k) put(bytes, k, order);
  }
  for (std::size_t i = 0; i < p.positions.size(); ++i) {
    put(bytes, static_cast<std::uint32_t>(i), order);
    put(bytes, p.positions[i].x, order);
    put(bytes, p.positions[i].y, order);
    if (!flat) {
      put<std::int32_t>(bytes, i % 4, order);
      for (std::size_t k = 0; k < i % 4; ++k) put(bytes, 1.F, order);
    }
    put(bytes, p.positions[i].z, order);
    for (int k = 0; k < 3; ++k) put(bytes, byteOf(p.colors[i][k]), order);
    put(bytes, p.radii[i], order);
    for (int k = 0; k < 3; ++k) put<double>(bytes, p.velocities[i][k], order);
    put(bytes, p.strengths[i], order);
  }
  put<std::uint8_t>(bytes, 3, order);
  for (std::int32_t k = 0; k < 3; ++k) put(bytes, k, order);
  return bytes;
}

// Version 3: lists of cells in the old way; version 5: in the new one.
inline std::string vtk(const Particles& p, bool binary, int version = 3) {
  const std::size_t n = p.positions.size();
  std::string bytes = fmt::format("# vtk DataFile Version {}\nparticles\n{}\nDATASET POLYDATA\n",
                                  version == 3 ? "3.0" : "5.1", binary ? "BINARY" : "ASCII");
  const auto number = [&](auto value) {
    if (binary)
      put(bytes, value, std::endian::big);
    else
      bytes += fmt::format("{}{}", value, bytes.size() % 5 ? ' ' : '\n');
  };
  bytes += fmt::format("POINTS {} float\n", n);
  for (const Point3& x : p.positions)
    for (int k = 0; k < 3; ++k) number(x[k]);
  if (version == 3) {
    bytes += fmt::format("\nVERTICES {} {}\n", n, 2 * n);
    for (std::size_t i = 0; i < n; ++i) {
      number(std::int32_t{1});
      number(static_cast<std::int32_t>(i));
    }
  } else {
    bytes += fmt::format("\nMETADATA\nINFORMATION 0\n\nVERTICES {} {}\nOFFSETS vtktypeint64\n",
                         n + 1, n);
    for (std::size_t i = 0; i <= n; ++i) number(static_cast<std::int64_t>(i));
    bytes += "\nCONNECTIVITY vtktypeint64\n";
    for (std::size_t i = 0; i < n; ++i) number(static_cast<std::int64_t>(i));
  }
  bytes += fmt::format("\nCELL_DATA {}\nSCALARS radius float\nLOOKUP_TABLE default\n", n);
  for (std::size_t i = 0; i < n; ++i) number(-1.F);  // of cells: not ours
  bytes += fmt::format("\nPOINT_DATA {}\nCOLOR_SCALARS color 3\n", n);
  for (const Spectrum& c : p.colors)
    for (int k = 0; k < 3; ++k)
      if (binary)
        put(bytes, byteOf(c[k]), std::endian::big);
      else
        number(c[k]);
  bytes += "\nVECTORS velocity double\n";
  for (const Vec3& v : p.velocities)
    for (int k = 0; k < 3; ++k) number(double{v[k]});
  bytes += "\nSCALARS density int 2\nLOOKUP_TABLE colours\n";
  for (std::size_t i = 0; i < 2 * n; ++i) number(std::int32_t{7});
  bytes += "\nLOOKUP_TABLE colours 2\n";
  for (int i = 0; i < 8; ++i)
    if (binary)
      put<std::uint8_t>(bytes, 200, std::endian::big);
    else
      number(0.5F);
  bytes += fmt::format("\nFIELD FieldData 3\npscale 1 {} float\n", n);
  for (const float radius : p.radii) number(radius);
  bytes += fmt::format("\nMETADATA\nINFORMATION 0\n\nflags 1 {} bit\n", n);
  for (std::size_t i = 0; i < (binary ? (n + 7) / 8 : n); ++i) number(std::uint8_t{1});
  bytes += fmt::format("\nstrength 1 {} float\n", n);
  for (const float strength : p.strengths) number(strength);
  return bytes + "\n";
}

inline std::string csv(const Particles& p, char separator = ',') {
  std::string text =
      "\"name, if any\",\"Points:0\",\"Points:1\",\"Points:2\",pscale,Cd.r,Cd.g,Cd.b,"
      "v[0],v[1],v[2],Strength\n";
  for (std::size_t i = 0; i < p.positions.size(); ++i) {
    const Vec3 x = p.positions[i], c = p.colors[i], v = p.velocities[i];
    text += fmt::format("\"a, {}\",{},{},{},{},{},{},{},{},{},{},{}\n", i, x.x, x.y, x.z,
                        p.radii[i], c.x, c.y, c.z, v.x, v.y, v.z, p.strengths[i]);
  }
  bool quoted = false;
  for (char& ch : text) {
    if (ch == '"') quoted = !quoted;
    if (ch == ',' && !quoted) ch = separator;
  }
  return text;
}

inline std::string raw(const Particles& p) {
  std::string bytes;
  for (const Point3& x : p.positions) put(bytes, x, std::endian::little);
  return bytes;
}

inline std::string bgeo(const Particles& p) {
  constexpr std::endian kBig = std::endian::big;
  std::string bytes = "BgeoV";
  const auto integers = [&](std::initializer_list<std::int32_t> values) {
    for (const std::int32_t value : values) put(bytes, value, kBig);
  };
  const auto word = [&](std::string_view text) {
    put(bytes, static_cast<std::uint16_t>(text.size()), kBig);
    bytes += text;
  };
  const auto attribute = [&](std::string_view name, std::uint16_t numbers, std::int32_t type) {
    word(name);
    put(bytes, numbers, kBig);
    put(bytes, type, kBig);
    if (type != 4)
      for (int i = 0; i < numbers; ++i) put(bytes, 0.F, kBig);
  };
  integers({5, static_cast<std::int32_t>(p.positions.size()), 0, 0, 0, 7, 0, 0, 0});
  attribute("id", 1, 1);
  attribute("v", 3, 5);
  attribute("name", 1, 4);
  integers({2});
  word("one");
  word("another");
  attribute("Cd", 3, 0);
  attribute("pscale", 1, 0);
  attribute("strength", 1, 0);
  attribute("pscale2", 1, 0);
  for (std::size_t i = 0; i < p.positions.size(); ++i) {
    put(bytes, p.positions[i], kBig);
    put(bytes, 1.F, kBig);
    put(bytes, static_cast<std::int32_t>(i), kBig);
    put(bytes, p.velocities[i], kBig);
    put(bytes, std::int32_t{1}, kBig);
    put(bytes, p.colors[i], kBig);
    for (const float x : {p.radii[i], p.strengths[i], 7.F}) put(bytes, x, kBig);
  }
  return bytes + std::string("\0\xFF", 2);
}

}  // namespace pbrt::test
