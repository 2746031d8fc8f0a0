// How much memory there is: the least of all limits.

#include "core/base/memory_limit.h"

#include <sys/resource.h>

#include "core/base/error.h"
#include "tests/command.h"

namespace pbrt {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

// A system of files as the kernel shows them.
class Groups : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) const { folder_.write(name, text); }
  std::size_t limit() const { return controlGroupMemory(folder_.path()); }

  test::Folder folder_;
};

TEST_F(Groups, NotThereLimitNothing) {
  EXPECT_EQ(limit(), kNone);
  write("proc/self/cgroup", "0::/a/b\n");
  EXPECT_EQ(limit(), kNone);
}

TEST_F(Groups, OfVersion2AreHeldToThoseAboutThem) {
  write("proc/self/cgroup", "0::/batch/job\n");
  write("sys/fs/cgroup/batch/job/memory.max", "max\n");
  EXPECT_EQ(limit(), kNone);
  write("sys/fs/cgroup/batch/memory.max", "1000000\n");
  EXPECT_EQ(limit(), 1000000U);
  write("sys/fs/cgroup/batch/job/memory.max", "2000000\n");
  EXPECT_EQ(limit(), 1000000U);
  write("sys/fs/cgroup/batch/job/memory.max", "500000\n");
  EXPECT_EQ(limit(), 500000U);
}

TEST_F(Groups, OfVersion1HaveAFolderForMemory) {
  write("proc/self/cgroup", "5:cpu,cpuacct:/x\n4:memory:/job\n0::/\n");
  write("sys/fs/cgroup/memory/job/memory.limit_in_bytes", "9223372036854771712\n");
  EXPECT_EQ(limit(), 9223372036854771712U);
  write("sys/fs/cgroup/memory/job/memory.limit_in_bytes", "700000\n");
  EXPECT_EQ(limit(), 700000U);
}

// Inside, the container's own group is the uppermost; the path is the machine's.
TEST_F(Groups, OfAContainer) {
  write("proc/self/cgroup", "0::/../../docker/abc\n");
  write("sys/fs/cgroup/memory.max", "800000\n");
  EXPECT_EQ(limit(), 800000U);
}

TEST(MemoryLimit, IsNotMoreThanTheMachineHas) {
  EXPECT_GT(memoryLimit(), std::size_t{64} << 20);
  EXPECT_LE(memoryLimit(), static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)) *
                               static_cast<std::size_t>(sysconf(_SC_PAGESIZE)));
}

TEST(CheckMemory, TellsBothFigures) {
  EXPECT_NO_THROW(checkMemory(0, "nothing"));
  EXPECT_NO_THROW(checkMemory(static_cast<double>(memoryLimit()), "all"));
  for (const double bytes : {0x1p60, std::numeric_limits<double>::infinity()}) try {
      checkMemory(bytes, "a whale");
      ADD_FAILURE() << "not refused";
    } catch (const Error& error) {
      const std::string said = error.what();
      EXPECT_NE(said.find("a whale needs "), said.npos) << said;
      EXPECT_NE(said.find(bytes < 0x1p61 ? "1073741824.0 GiB" : "inf GiB"), said.npos) << said;
    }
}

}  // namespace
}  // namespace pbrt
