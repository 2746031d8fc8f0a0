// What was written is read, whatever the format; and each kind of mistake is named, with its place.

#include <unistd.h>
#include <zlib.h>

#include <fstream>

#include "tests/shapes/metaballs/particle_files.h"

namespace pbrt {
namespace {

using test::complaint;
using test::expectSame;
using test::someParticles;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(Ply, TextAndBothByteOrders) {
  const Particles p = someParticles(5000);
  expectSame(readParticles("a.ply", test::plyText(p)), p);
  expectSame(readParticles("a.PLY", test::plyBinary(p, std::endian::little)), p);
  expectSame(readParticles("a.ply", test::plyBinary(p, std::endian::big)), p);
}

TEST(Ply, ListsAmongTheProperties) {
  const Particles p = someParticles(100);
  expectSame(readParticles("a.ply", test::plyText(p, false)), p);
  expectSame(readParticles("a.ply", test::plyBinary(p, std::endian::little, false)), p);
  expectSame(readParticles("a.ply", test::plyBinary(p, std::endian::big, false)), p);
}

TEST(Ply, WindowsLinesAndFloatColours) {
  const Particles p = readParticles(
      "a.ply",
      "ply\r\nformat ascii 1.0\r\nelement vertex 1\r\nproperty float x\r\nproperty float y\r\n"
      "property float z\r\nproperty float r\r\nproperty float g\r\nproperty float b\r\n"
      "end_header\r\n1 2 3 0.25 0.5 1.5");
  EXPECT_EQ(p.positions.at(0), Point3(1, 2, 3));
  EXPECT_EQ(p.colors.at(0), Spectrum(0.25F, 0.5F, 1.5F));
  EXPECT_THAT(p.radii, IsEmpty());
}

TEST(Ply, TheLetterRIsARadiusIfThereIsNoGAndB) {
  const Particles p = readParticles(
      "a.ply",
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
      "property float z\nproperty float r\nproperty uchar red\nend_header\n1 2 3 4 5\n");
  EXPECT_EQ(p.radii.at(0), 4);
  EXPECT_THAT(p.colors, IsEmpty());  // red alone is none
}

const std::string kPly =
    "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
    "property float z\nend_header\n";

TEST(Ply, Mistakes) {
  EXPECT_THAT(complaint("a.ply", "solid thing\n"), HasSubstr("does not begin with \"ply\""));
  EXPECT_THAT(complaint("a.ply", kPly + "1 2 3\n4 five 6\n"),
              AllOf(HasSubstr("a.ply:9:3:"), HasSubstr("\"five\" is not a number"),
                    HasSubstr("4 five 6\n")));
  EXPECT_THAT(complaint("a.ply", kPly + "1 2 3 4\n5 6 7\n"), HasSubstr("a.ply:8:7:"));
  EXPECT_THAT(complaint("a.ply", kPly + "1 2 3\n4 567\n"), HasSubstr("too early"));
  EXPECT_THAT(complaint("a.ply", kPly + "1 2 3\n4 5 nan\n"),
              HasSubstr("a.ply: particle 1 (the first is 0): its position is not finite"));
  EXPECT_THAT(complaint("a.ply", kPly + "1 2 1e39\n4 5 6\n"), HasSubstr("particle 0"));
  std::string none = kPly;
  none.replace(none.find("vertex 2"), 8, "vertex 0");
  EXPECT_THAT(complaint("a.ply", none), HasSubstr("holds no particles"));
  std::string noZ = kPly;
  noZ.replace(noZ.find("float z"), 7, "float w");
  EXPECT_THAT(complaint("a.ply", noZ + "1 2 3\n4 5 6\n"), HasSubstr("no positions"));
  EXPECT_THAT(complaint("a.ply", "ply\nformat ascii 1.0\nend_header\n"),
              HasSubstr("no element \"vertex\""));
  EXPECT_THAT(complaint("a.ply", "ply\nformat binary 1.0\nend_header\n"), HasSubstr("a.ply:2:8:"));
  EXPECT_THAT(complaint("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty half x\n"),
              HasSubstr("a.ply:4:10:"));
}

TEST(Ply, CountsThatTheFileCannotHold) {
  for (const char* count : {"3", "99999999999", "18446744073709551615"}) {
    std::string text = kPly;
    text.replace(text.find("vertex 2"), 8, fmt::format("vertex {}", count));
    EXPECT_THAT(complaint("a.ply", text + "1 2 3\n4 5 6\n"), HasSubstr("a.ply:8:")) << count;
    std::string binary = text;
    binary.replace(binary.find("ascii"), 5, "binary_little_endian");
    EXPECT_THAT(complaint("a.ply", binary + std::string(24, '\0')),
                HasSubstr(fmt::format("a.ply: byte {}:", binary.size())))
        << count;
  }
  EXPECT_THAT(complaint("a.ply", kPly + "123456789012345678901234567890 2 3\n4 5 6\n"), "");
}

TEST(Vtk, TextAndBinaryOldAndNew) {
  const Particles p = someParticles(500);
  for (const int version : {3, 5})
    for (const bool binary : {false, true}) {
      SCOPED_TRACE(fmt::format("version {} binary {}", version, binary));
      expectSame(readParticles("a.vtk", test::vtk(p, binary, version)), p);
    }
}

const std::string kVtk = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\n";

TEST(Vtk, Mistakes) {
  EXPECT_THAT(complaint("a.vtk", "<VTKFile>"), HasSubstr("not a legacy VTK file"));
  EXPECT_THAT(complaint("a.vtk", "# vtk DataFile Version 3.0\nt\nXML\n"), HasSubstr("a.vtk:3:1:"));
  EXPECT_THAT(
      complaint("a.vtk", "# vtk DataFile Version 3.0\nt\nASCII\nDATASET RECTILINEAR_GRID\n"),
      HasSubstr("a.vtk:4:9:"));
  EXPECT_THAT(complaint("a.vtk", kVtk), HasSubstr("holds no particles"));
  EXPECT_THAT(complaint("a.vtk", kVtk + "POINTS 9 float\n1 2 3\n"), HasSubstr("a.vtk:5:"));
  EXPECT_THAT(complaint("a.vtk", kVtk + "POINTS 99999999999999999999 float\n1 2 3\n"),
              HasSubstr("is not a count"));
  const std::string good = kVtk + "POINTS 1 float\n1 2 3\n";
  EXPECT_EQ(complaint("a.vtk", good), "");
  EXPECT_THAT(complaint("a.vtk", good + "POINT_DATA 2\n"), HasSubstr("a.vtk:7:1:"));
  EXPECT_THAT(complaint("a.vtk", good + "NONSENSE 2\n"), HasSubstr("a.vtk:7:1:"));
  EXPECT_THAT(complaint("a.vtk", good + "POINT_DATA 1\nFIELD f 1\nradius 1 2 float 1 2"),
              HasSubstr("a.vtk:9:1:"));
  EXPECT_THAT(complaint("a.vtk", good + "POINT_DATA 1\nFIELD f 1\nname 1 1 string\nhello\n"),
              HasSubstr("arrays of \"string\""));
  EXPECT_THAT(complaint("a.vtk", good + "POINT_DATA 1\nSCALARS radius float\ninf\n"),
              HasSubstr("particle 0 (the first is 0): its radius"));
  EXPECT_EQ(complaint("a.vtk", good + "FIELD f 1\nnothing 0 18446744073709551615 float\n"), "");
  const std::string binary =
      "# vtk DataFile Version 3.0\nt\nBINARY\nDATASET POLYDATA\nPOINTS 2000000000000 double\n";
  EXPECT_THAT(complaint("a.vtk", binary + "abcdefgh"),
              HasSubstr(fmt::format("a.vtk: byte {}:", binary.size())));
}

TEST(Table, NamedColumnsWithAnySeparator) {
  const Particles p = someParticles(2000);
  for (const char separator : {',', ';', '\t'})
    expectSame(readParticles("a.csv", test::csv(p, separator)), p);
}

TEST(Table, WithoutNames) {
  const Particles three =
      readParticles("a.xyz", "# a comment\n 1 2\t3\r\n\n4 5 6 # another, too\n");
  EXPECT_THAT(three.positions, ::testing::ElementsAre(Point3(1, 2, 3), Point3(4, 5, 6)));
  EXPECT_THAT(three.radii, IsEmpty());
  const Particles seven =
      readParticles("a.txt", "+1, -2.5e-1 ,3,4, 0.25,.5,1 # one\n5, 6,7,8,0,0,0");
  EXPECT_THAT(seven.positions, ::testing::ElementsAre(Point3(1, -0.25F, 3), Point3(5, 6, 7)));
  EXPECT_THAT(seven.radii, ::testing::ElementsAre(4, 8));
  EXPECT_EQ(seven.colors.at(0), Spectrum(0.25F, 0.5F, 1));
}

TEST(Table, NamesInWordsBetweenBlanks) {
  const Particles p = readParticles("a.txt", "\xEF\xBB\xBFid y x z radius\n7 2 1 3 0.5\n");
  EXPECT_EQ(p.positions.at(0), Point3(1, 2, 3));
  EXPECT_EQ(p.radii.at(0), 0.5F);
}

TEST(Table, EmptyCellsOfOtherColumns) {
  const Particles p = readParticles("a.csv", "a\tx\ty\tz\tb\n\t1\t2\t3\t\n");
  EXPECT_EQ(p.positions.at(0), Point3(1, 2, 3));
}

TEST(Table, Mistakes) {
  EXPECT_THAT(complaint("a.xyz", "1 2\n"), AllOf(HasSubstr("a.xyz:1:1:"), HasSubstr("2 columns")));
  EXPECT_THAT(complaint("a.xyz", "1 2 3 4 5 6\n"), HasSubstr("x y z radius r g b"));
  EXPECT_THAT(complaint("a.xyz", "1 2 3\n4 5\n"),
              AllOf(HasSubstr("a.xyz:2:4:"), HasSubstr("only")));
  EXPECT_THAT(complaint("a.xyz", "1 2 3\n4 5 6 7\n"), HasSubstr("a.xyz:2:7:"));
  EXPECT_THAT(complaint("a.csv", "x,y,z\n1,2,\n"), HasSubstr("a.csv:2:5:"));
  EXPECT_THAT(complaint("a.csv", "x,y,z\n1,2x,3\n"), HasSubstr("a.csv:2:3:"));
  EXPECT_THAT(complaint("a.csv", "x,y,z\n1,2 3,4\n"), HasSubstr("a.csv:2:5:"));
  EXPECT_THAT(complaint("a.csv", "x;y;z\n1,5;2;3\n"), HasSubstr("a.csv:2:1:"));
  EXPECT_THAT(complaint("a.csv", "x,y,z\n"), HasSubstr("holds no particles"));
  EXPECT_THAT(complaint("a.csv", "a,b,c\n1,2,3\n"),
              AllOf(HasSubstr("no positions"), HasSubstr("a, b, c")));
  EXPECT_THAT(complaint("a.xyz", "1 2 3 4 255 0 0\n"), HasSubstr("from 0 to 1"));
  EXPECT_THAT(complaint("a.xyz", "1 2 3\n4 nan 6\n"), HasSubstr("particle 1 "));
  EXPECT_THAT(complaint("a.txt", "# nothing\n\n"), HasSubstr("holds no particles"));
}

TEST(Raw, FloatsAndNotText) {
  const Particles p = someParticles(1000);
  const std::string bytes = test::raw(p);
  EXPECT_EQ(readParticles("a.xyz", bytes).positions, p.positions);
  EXPECT_THAT(complaint("a.xyz", bytes + "abcd"), HasSubstr("a.xyz: byte 12000:"));
  std::string nan = bytes;
  nan.replace(120, 4, "\xFF\xFF\xFF\x7F");
  EXPECT_THAT(complaint("a.xyz", nan), HasSubstr("particle 10 "));
}

// The bytes of numbers just above a million are letters: "Pt$I".
TEST(Raw, FloatsThatLookLikeLetters) {
  Particles p;
  p.positions.emplace_back(1e6F);
  for (int i = 0; i < 1000; ++i)
    p.positions.emplace_back(1e6F + 2 + 0.25F * Vec3(i % 16, i % 7, 3));
  EXPECT_EQ(readParticles("a.xyz", test::raw(p)).positions, p.positions);
}

TEST(Raw, TextWithADamagedByteIsRefused) {
  std::string text = "1 2 3\n4 5 6\n7 8 9\n10 11 12\n";
  while (text.size() % 12) text += ' ';
  for (const std::size_t at : {0, 9, 20}) {
    std::string damaged = text;
    damaged[at] = '\0';
    EXPECT_THAT(complaint("a.xyz", damaged), HasSubstr(fmt::format("a.xyz: byte {}:", at)));
  }
}

TEST(Bgeo, ClassicAttributes) {
  const Particles p = someParticles(3000);
  expectSame(readParticles("a.bgeo", test::bgeo(p)), p);
  expectSame(readParticles("a.bhclassic", test::bgeo(p)), p);
}

TEST(Bgeo, Mistakes) {
  const std::string good = test::bgeo(someParticles(3));
  EXPECT_THAT(complaint("a.bgeo", "[\"fileversion\",\"18.5\"]"), HasSubstr("bhclassic"));
  EXPECT_THAT(complaint("a.bgeo", "\x7FNSJb"), HasSubstr("bhclassic"));
  EXPECT_THAT(complaint("a.bgeo", "Bgeo5"), HasSubstr("BgeoV"));
  std::string bytes = good;
  bytes[8] = 6;
  EXPECT_THAT(complaint("a.bgeo", bytes), HasSubstr("a.bgeo: byte 5: is of version 6"));
  bytes = good;
  bytes[9] = 0x70;  // many points
  EXPECT_THAT(complaint("a.bgeo", bytes), HasSubstr("bytes are left"));
  bytes[9] = static_cast<char>(0xFF);
  EXPECT_THAT(complaint("a.bgeo", bytes), HasSubstr("a.bgeo: byte 9:"));
  for (std::size_t length = 0; length + 2 < good.size(); ++length)
    EXPECT_NE(complaint("a.bgeo", good.substr(0, length)), "") << length;
}

TEST(ParticleFiles, Suffixes) {
  EXPECT_THAT(complaint("a.vtu", "<"), HasSubstr("legacy .vtk"));
  EXPECT_THAT(complaint("a.abc", "x"), AllOf(HasSubstr("\".abc\""), HasSubstr(".ply .vtk")));
  EXPECT_THAT(complaint("ply", "x"), HasSubstr("ply: \"\" is not a suffix"));
  EXPECT_THAT(complaint("a.ply", ""), HasSubstr("a.ply: is empty"));
}

class ParticleFolder : public ::testing::Test {
 protected:
  ParticleFolder() { std::filesystem::create_directories(folder_); }
  ~ParticleFolder() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  std::filesystem::path pack(const std::string& name, const std::string& bytes) const {
    const std::filesystem::path path = folder_ / name;
    gzFile file = gzopen(path.c_str(), "wb");
    EXPECT_EQ(gzwrite(file, bytes.data(), static_cast<unsigned>(bytes.size())),
              static_cast<int>(bytes.size()));
    EXPECT_EQ(gzclose(file), Z_OK);
    return path;
  }
  static std::string failure(const std::filesystem::path& file, Failure kind) {
    try {
      readParticles(file);
    } catch (const Error& error) {
      EXPECT_EQ(error.failure(), kind);
      return error.what();
    }
    ADD_FAILURE() << file << " was read";
    return "";
  }

  const std::filesystem::path folder_ =
      std::filesystem::path(::testing::TempDir()) /
      fmt::format("particles-{}-{}", getpid(),
                  ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(ParticleFolder, PlainAndGzipped) {
  const Particles p = someParticles(30000);  // several pieces of the reader
  expectSame(readParticles(write("a.bgeo", test::bgeo(p))), p);
  expectSame(readParticles(pack("b.bgeo.gz", test::bgeo(p))), p);
  expectSame(readParticles(pack("c.bgeo", test::bgeo(p))), p);
  expectSame(readParticles(pack("d.CSV.GZ", test::csv(p))), p);
}

TEST_F(ParticleFolder, SeveralGzipMembers) {
  const std::string all = test::csv(someParticles(2000));
  std::string packed;
  for (const std::string& part : {all.substr(0, 100000), all.substr(100000)}) {
    std::ifstream in(pack("part.gz", part), std::ios::binary);
    packed.append(std::istreambuf_iterator<char>(in), {});
  }
  expectSame(readParticles(write("a.csv.gz", packed)), someParticles(2000));
}

TEST_F(ParticleFolder, DamagedGzip) {
  const std::filesystem::path whole = pack("a.csv.gz", test::csv(someParticles(2000)));
  std::ifstream in(whole, std::ios::binary);
  std::string bytes(std::istreambuf_iterator<char>(in), {});
  EXPECT_THAT(failure(write("cut.csv.gz", bytes.substr(0, bytes.size() / 2)), Failure::io),
              HasSubstr("cut.csv.gz: "));
  bytes[bytes.size() / 2] ^= 0x10;
  EXPECT_THAT(failure(write("bad.csv.gz", bytes), Failure::io), HasSubstr("bad.csv.gz: "));
}

TEST_F(ParticleFolder, NotThereOrNoFile) {
  EXPECT_THAT(failure(folder_ / "no.ply", Failure::io), HasSubstr("No such file"));
  EXPECT_THAT(failure(folder_, Failure::io), HasSubstr("it is not a file"));
}

}  // namespace
}  // namespace pbrt
