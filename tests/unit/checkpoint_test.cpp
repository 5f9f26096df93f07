// Checkpoints: what is read has the bits of what was written, or reading is refused.
#include "common/io/checkpoint.hpp"

#include <bit>
#include <csignal>
#include <cstring>
#include <limits>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "common/core/error.hpp"
#include "tests/support/checkpoint_mutations.hpp"
#include "tests/support/temporary_folder.hpp"

namespace galet::test::checkpoint_test {
namespace {

using test::file_bytes;
using test::put_bytes;
using test::TemporaryFolder;

Archive sample_archive() {
  Archive archive;
  archive.reals["grains.position"] = {0.1,
                                      -0.0,
                                      std::numeric_limits<double>::denorm_min(),
                                      1e308,
                                      std::numeric_limits<double>::infinity(),
                                      std::bit_cast<double>(0x7ff8'dead'beef'1234ULL),   // quiet NaN with a payload
                                      std::bit_cast<double>(0xfff0'0000'0000'0001ULL)};  // signalling NaN
  archive.reals["empty"] = {};
  archive.reals["md/history/xi"] = {1, 2, 3};
  archive.integers["steps"] = {std::numeric_limits<std::int64_t>::min(), -1, 0,
                               std::numeric_limits<std::int64_t>::max()};
  archive.integers["none"] = {};
  archive.texts["scene"] = "title = \"Été µ\"\n# a comment\n";
  archive.texts["nothing"] = "";
  archive.texts["zeros"] = std::string("\0a\0\0", 4);
  return archive;
}

/// Equality of bits (NaN differs from itself, and -0 equals 0, for operator==).
bool same_bits(const Archive& a, const Archive& b) {
  if (a.integers != b.integers || a.texts != b.texts || a.reals.size() != b.reals.size()) return false;
  for (const auto& [name, values] : a.reals) {
    const auto other = b.reals.find(name);
    if (other == b.reals.end() || other->second.size() != values.size()) return false;
    if (!values.empty() && std::memcmp(values.data(), other->second.data(), values.size() * sizeof(double)) != 0)
      return false;
  }
  return true;
}

/// The message with which reading a file is refused; empty when it is read.
std::string refusal(const std::string& path) {
  try {
    read_checkpoint(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(Checkpoint, ReturnsTheSameBits) {
  const TemporaryFolder folder;
  const Archive archive = sample_archive();
  write_checkpoint(folder.file("a.h5"), archive);
  const Archive back = read_checkpoint(folder.file("a.h5"));
  EXPECT_TRUE(same_bits(archive, back));
  EXPECT_EQ(state_hash(archive), state_hash(back));

  write_checkpoint(folder.file("empty.h5"), Archive{});
  EXPECT_TRUE(same_bits(Archive{}, read_checkpoint(folder.file("empty.h5"))));
}

TEST(Checkpoint, LargeColumns) {
  const TemporaryFolder folder;
  Archive archive;
  for (int k = 0; k < 300000; ++k) archive.reals["x"].push_back(1.0 / (k + 1));
  for (int k = 0; k < 200; ++k) archive.integers[fmt::format("column {}", k)] = {k};
  archive.texts["long"] = std::string(200000, 'x');
  write_checkpoint(folder.file("a.h5"), archive);
  EXPECT_TRUE(same_bits(archive, read_checkpoint(folder.file("a.h5"))));
}

TEST(Checkpoint, EqualArchivesGiveEqualFiles) {
  const TemporaryFolder folder;
  write_checkpoint(folder.file("a.h5"), sample_archive());
  write_checkpoint(folder.file("b.h5"), sample_archive());
  EXPECT_EQ(file_bytes(folder.file("a.h5")), file_bytes(folder.file("b.h5")));
  EXPECT_EQ(folder.entries(), 2) << "a temporary file was left behind";
}

TEST(Checkpoint, NamesThatHdf5WouldChangeAreRefused) {
  const TemporaryFolder folder;
  for (const std::string name : {"", "/a", "a/", "a//b", ".", "a/./b"}) {
    Archive archive;
    archive.reals[name] = {1};
    EXPECT_THROW(write_checkpoint(folder.file("a.h5"), archive), std::invalid_argument) << name;
  }
  EXPECT_EQ(folder.entries(), 0);
  Archive clash;  // a column can't be a folder of columns too
  clash.reals["a"] = {1};
  clash.reals["a/b"] = {1};
  EXPECT_THROW(write_checkpoint(folder.file("a.h5"), clash), RunError);
}

TEST(Checkpoint, SaysWhatIsWrongWithAFile) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.h5");
  EXPECT_NE(refusal(path).find("No such file"), std::string::npos) << refusal(path);
  put_bytes(path, "x,y\n1,2\n");
  EXPECT_NE(refusal(path).find("not an HDF5 file"), std::string::npos) << refusal(path);
  put_bytes(path, "");
  EXPECT_NE(refusal(path).find("not an HDF5 file"), std::string::npos) << refusal(path);

  write_checkpoint(path, sample_archive());
  const std::string good = file_bytes(path);
  put_bytes(path, good.substr(512));
  EXPECT_NE(refusal(path).find("not a galet checkpoint"), std::string::npos) << refusal(path);
  put_bytes(path, good.substr(0, good.size() - 1));
  EXPECT_NE(refusal(path).find("truncated"), std::string::npos) << refusal(path);
  std::string other = good;
  other.replace(other.find("version ") + 8, 1, "7");
  put_bytes(path, other);
  EXPECT_NE(refusal(path).find("version 7"), std::string::npos) << refusal(path);
  EXPECT_NE(refusal(path).find(path), std::string::npos) << "the message must name the file";
  put_bytes(path, good + "x");
  EXPECT_NE(refusal(path).find("damaged"), std::string::npos) << refusal(path);
}

TEST(Checkpoint, EveryTruncationIsRefused) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.h5");
  write_checkpoint(path, sample_archive());
  const std::string good = file_bytes(path);
  for (std::size_t length = 0; length < good.size(); length += 37) {
    put_bytes(path, good.substr(0, length));
    EXPECT_NE(refusal(path), "") << "cut at " << length;
  }
}

// Every byte, one bit each.
TEST(Checkpoint, EveryFlippedBitIsRefused) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.h5");
  write_checkpoint(path, sample_archive());
  const std::string good = file_bytes(path);
  for (std::size_t place = 0; place<good.size(); place += good.size()> 20000 ? 7 : 3) {
    std::string bad = good;
    bad[place] = static_cast<char>(bad[place] ^ (1 << (place % 8)));
    put_bytes(path, bad);
    EXPECT_NE(refusal(path), "") << "byte " << place;
  }
}

// All kinds of damage to a checkpoint of a run (tests/long takes 1e4 of them).
TEST(Checkpoint, RandomDamageIsRefused) {
  const test::DamageCounts counts = test::read_damaged_checkpoints(20000, 300);
  for (const std::string& complaint : counts.complaints) ADD_FAILURE() << complaint;
  EXPECT_EQ(counts.refused, 300);
}

std::uint64_t fnv(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (unsigned char byte : bytes) hash = (hash ^ byte) * 0x100000001b3ULL;
  return hash;
}

/// The file with a head that fits its (changed) content.
std::string with_new_head(std::string bytes) {
  const std::size_t place = bytes.find("hash ") + 5;
  return bytes.replace(place, 16, fmt::format("{:016x}", fnv(std::string_view(bytes).substr(512))));
}

// A forged head lets damage through to HDF5 and to the comparison of the state's own hash. Neither may print.
TEST(Checkpoint, DamageBehindAMatchingHeadIsRefusedInSilence) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.h5");
  const Archive archive = sample_archive();
  write_checkpoint(path, archive);
  const std::string good = file_bytes(path);
  put_bytes(path, with_new_head(good));
  EXPECT_EQ(refusal(path), "");

  const std::uint64_t hash = state_hash(archive);
  std::string bad = good;
  const std::size_t stored = bad.find(std::string(reinterpret_cast<const char*>(&hash), sizeof hash));
  ASSERT_NE(stored, std::string::npos) << "the file does not hold the state's hash";
  bad[stored] = static_cast<char>(bad[stored] ^ 1);
  put_bytes(path, with_new_head(bad));
  EXPECT_NE(refusal(path).find("hash of the columns"), std::string::npos) << refusal(path);

  bad = good;
  bad.replace(512, 8, "12345678");  // the signature of HDF5
  put_bytes(path, with_new_head(bad));
  testing::internal::CaptureStderr();
  const std::string message = refusal(path);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_NE(message.find("damaged"), std::string::npos) << message;
}

/// Files may not grow beyond `bytes` for as long as this lives: a disk that is full.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit small{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST(Checkpoint, AFullDiskLeavesTheEarlierFileWhole) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.h5");
  write_checkpoint(path, sample_archive());
  Archive large;
  large.reals["x"].assign(100000, 1.5);
  std::string message;
  {
    const SmallDisk disk(65536);
    try {
      write_checkpoint(path, large);
    } catch (const RunError& error) {
      message = error.what();
    }
  }
  EXPECT_NE(message.find(path), std::string::npos) << message;
  EXPECT_NE(message.find("File too large"), std::string::npos) << message;
  EXPECT_TRUE(same_bits(sample_archive(), read_checkpoint(path)));
  EXPECT_EQ(folder.entries(), 1) << "half a file was left behind";
  write_checkpoint(path, large);  // and the library still works
  EXPECT_TRUE(same_bits(large, read_checkpoint(path)));
}

TEST(Checkpoint, FailureToWriteNamesPathAndReason) {
  const TemporaryFolder folder;
  const auto message_for = [](const std::string& path) -> std::string {
    try {
      write_checkpoint(path, sample_archive());
    } catch (const RunError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_NE(message_for("/dev/full").find("No space left"), std::string::npos) << message_for("/dev/full");
  const std::string path = folder.file("absent/a.h5");
  EXPECT_NE(message_for(path).find(path), std::string::npos);
  EXPECT_NE(message_for(path).find("No such file"), std::string::npos);
}

}  // namespace
}  // namespace galet::test::checkpoint_test
