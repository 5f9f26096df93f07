// FCLIB files: what is written is read with the same bits, all forms of a matrix mean the same, and a file that is
// not sound is refused with its name, the dataset and what was expected.
#include "cd/discrete/fclib.hpp"

#include <cstdlib>
#include <cstring>
#include <filesystem>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "common/core/error.hpp"
#include "common/core/random.hpp"
#include "common/io/hdf5_tree.hpp"
#include "tests/support/temporary_folder.hpp"

namespace galet::cd::fclib_test {
namespace {

using test::file_bytes;
using test::put_bytes;
using test::TemporaryFolder;

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

/// What local and global problems have alike: a title, and bounds that nothing made round.
template <class Problem>
void draw_bounds(Problem& problem, int contacts, RandomStream& stream) {
  problem.title = "random";
  problem.description = "two lines,\nand µ";
  for (int c = 0; c < contacts; ++c) {
    problem.mu.push_back(stream.uniform(0, 1));
    if (problem.block == 5) problem.mu_r.push_back(stream.uniform(0, 1));
  }
}

template <class Content>
void expect_same_bounds_and_solution(const Content& back, const Content& content) {
  EXPECT_EQ(back.problem.block, content.problem.block);
  EXPECT_EQ(back.problem.title, content.problem.title);
  EXPECT_EQ(back.problem.description, content.problem.description);
  EXPECT_TRUE(same_bits(back.problem.mu, content.problem.mu));
  EXPECT_TRUE(same_bits(back.problem.mu_r, content.problem.mu_r));
  EXPECT_TRUE(same_bits(back.u, content.u));
  EXPECT_TRUE(same_bits(back.r, content.r));
}

/// A sparse W that is not symmetric, and bounds and q that nothing made round.
FclibContent random_content(int block, int contacts, std::uint64_t seed) {
  RandomStream stream(seed, 1);
  FclibContent content;
  DiscreteProblem& problem = content.problem;
  problem.block = block;
  problem.start = {0};
  for (int a = 0; a < block * contacts; ++a) {
    for (int b = 0; b < block * contacts; ++b)
      if (a == b || stream.uniform(0, 1) < 0.3) {
        problem.column.push_back(b);
        problem.value.push_back(a == b ? 2 + stream.uniform(0, 1) : stream.normal());
      }
    problem.start.push_back(static_cast<std::int64_t>(problem.value.size()));
    problem.q.push_back(stream.normal());
    content.u.push_back(stream.normal()), content.r.push_back(stream.normal());
  }
  draw_bounds(problem, contacts, stream);
  problem.q[0] = -0.0, problem.q[1] = std::numeric_limits<double>::denorm_min();
  return content;
}

TEST(Fclib, ReturnsTheSameBits) {
  const TemporaryFolder folder;
  for (const int block : {2, 3, 5}) {
    const FclibContent content = random_content(block, 7, 10 + static_cast<std::uint64_t>(block));
    write_fclib(folder.file("a.hdf5"), content);
    const FclibContent back = read_fclib(folder.file("a.hdf5"));
    expect_same_bounds_and_solution(back, content);
    EXPECT_EQ(back.problem.start, content.problem.start);
    EXPECT_EQ(back.problem.column, content.problem.column);
    EXPECT_TRUE(same_bits(back.problem.value, content.problem.value));
    EXPECT_TRUE(same_bits(back.problem.q, content.problem.q));
    // And written again, the same file.
    write_fclib(folder.file("b.hdf5"), back);
    EXPECT_EQ(file_bytes(folder.file("a.hdf5")), file_bytes(folder.file("b.hdf5")));
  }
}

TEST(Fclib, WhatMotionsMeanForGapsIsKept) {
  const TemporaryFolder folder;
  FclibContent content = random_content(3, 4, 20);
  write_fclib(folder.file("a.hdf5"), content);
  EXPECT_FALSE(read_fclib(folder.file("a.hdf5")).scale);
  content.scale = FclibScale{0.3, 1.7};
  write_fclib(folder.file("b.hdf5"), content);
  const std::optional<FclibScale> back = read_fclib(folder.file("b.hdf5")).scale;
  ASSERT_TRUE(back);
  EXPECT_EQ(back->gap_time, 0.3);
  EXPECT_EQ(back->diameter, 1.7);
  content.scale->diameter = 0;
  write_fclib(folder.file("c.hdf5"), content);
  try {
    read_fclib(folder.file("c.hdf5"));
    FAIL() << "a diameter of zero was read";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("galet/diameter"), std::string::npos) << error.what();
  }
}

TEST(Fclib, NoContactsAndNoSolution) {
  const TemporaryFolder folder;
  FclibContent content;
  content.problem.start = {0};
  write_fclib(folder.file("a.hdf5"), content);
  const FclibContent back = read_fclib(folder.file("a.hdf5"));
  EXPECT_EQ(back.problem.contacts(), 0);
  EXPECT_TRUE(back.r.empty());
}

// ---- Forms of a file ----

/// One disk on a plane: W = [[1, 0.25], [0.25, 3]].
Archive local_file() {
  Archive file;
  file.integers["fclib_local/spacedim"] = {2};
  file.integers["fclib_local/W/m"] = file.integers["fclib_local/W/n"] = {2};
  file.integers["fclib_local/W/nz"] = {-1};
  file.integers["fclib_local/W/nzmax"] = {4};
  file.integers["fclib_local/W/p"] = {0, 2, 4};
  file.integers["fclib_local/W/i"] = {0, 1, 0, 1};
  file.reals["fclib_local/W/x"] = {1, 0.5, 0.25, 3};
  file.reals["fclib_local/vectors/q"] = {-1, 0.5};
  file.reals["fclib_local/vectors/mu"] = {0.3};
  return file;
}

DiscreteProblem through_file(const Archive& file) {
  const TemporaryFolder folder;
  write_hdf5(folder.file("a.hdf5"), file);
  return read_fclib(folder.file("a.hdf5")).problem;
}

void expect_the_disk(const DiscreteProblem& problem) {
  EXPECT_EQ(problem.start, (std::vector<std::int64_t>{0, 2, 4}));
  EXPECT_EQ(problem.column, (std::vector<int>{0, 1, 0, 1}));
  EXPECT_EQ(problem.value, (std::vector<double>{1, 0.25, 0.5, 3}));
  EXPECT_EQ(problem.q, (std::vector<double>{-1, 0.5}));
  EXPECT_EQ(problem.mu, (std::vector<double>{0.3}));
}

TEST(Fclib, FormsOfAMatrix) {
  expect_the_disk(through_file(local_file()));

  Archive rows = local_file();
  rows.integers["fclib_local/W/nz"] = {-2};
  rows.reals["fclib_local/W/x"] = {1, 0.25, 0.5, 3};
  expect_the_disk(through_file(rows));

  Archive unsorted = rows;  // and with places that nothing uses
  unsorted.integers["fclib_local/W/i"] = {1, 0, 1, 0, 77};
  unsorted.reals["fclib_local/W/x"] = {0.25, 1, 3, 0.5, 1e9};
  unsorted.integers["fclib_local/W/nzmax"] = {5};
  expect_the_disk(through_file(unsorted));

  Archive triplets = local_file();  // two at (1, 1): they are added
  triplets.integers["fclib_local/W/nz"] = {5};
  triplets.integers["fclib_local/W/i"] = {1, 0, 1, 0, 1};
  triplets.integers["fclib_local/W/p"] = {1, 1, 0, 0, 1};
  triplets.reals["fclib_local/W/x"] = {2, 0.25, 0.5, 1, 1};
  expect_the_disk(through_file(triplets));
}

Archive matrix_entries(const std::string& name, const Eigen::MatrixXd& dense) {
  Archive file;
  for (int b = 0; b < dense.cols(); ++b)
    for (int a = 0; a < dense.rows(); ++a)
      if (dense(a, b) != 0) {
        file.integers[name + "/i"].push_back(a), file.integers[name + "/p"].push_back(b);
        file.reals[name + "/x"].push_back(dense(a, b));
      }
  file.integers[name + "/nz"] =
      file.integers[name + "/nzmax"] = {static_cast<std::int64_t>(file.reals[name + "/x"].size())};
  file.integers[name + "/m"] = {dense.rows()}, file.integers[name + "/n"] = {dense.cols()};
  return file;
}

/// Two contacts (of 3 numbers) of bodies with 8 velocities.
struct Global {
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(8, 8), h = Eigen::MatrixXd::Zero(8, 6);
  Eigen::VectorXd f = Eigen::VectorXd::Zero(8), w = Eigen::VectorXd::Zero(6);

  Global() {
    RandomStream stream(5, 1);
    for (int a = 0; a < 8; ++a) {
      mass(a, a) = 4 + a, f[a] = stream.normal();
      for (int b = 0; b < 6; ++b) h(a, b) = (a + b) % 3 == 0 ? 0 : stream.normal();
    }
    mass(0, 3) = mass(3, 0) = 1.5;  // an inertia that is not diagonal
    for (int b = 0; b < 6; ++b) w[b] = stream.normal();
  }
  Archive file(const std::string& form = "fclib_global") const {
    Archive file = matrix_entries(form + "/M", mass), other = matrix_entries(form + "/H", h);
    file.reals.merge(other.reals), file.integers.merge(other.integers);
    file.integers[form + "/spacedim"] = {3};
    file.reals[form + "/vectors/f"].assign(f.begin(), f.end());
    file.reals[form + "/vectors/w"].assign(w.begin(), w.end());
    file.reals[form + "/vectors/mu"] = {0.3, 0.4};
    return file;
  }
};

Eigen::MatrixXd dense_matrix(const DiscreteProblem& problem) {
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(problem.rows(), problem.rows());
  for (int a = 0; a < problem.rows(); ++a)
    for (std::int64_t k = problem.start[a]; k < problem.start[a + 1]; ++k)
      dense(a, problem.column[k]) = problem.value[k];
  return dense;
}

TEST(Fclib, GlobalFormIsReduced) {
  for (const double gyroscopic : {0.0, 0.7}) {
    Global global;
    global.mass(1, 2) += gyroscopic, global.mass(2, 1) -= gyroscopic;
    for (const char* form : {"fclib_global", "fclib_global_rolling"}) {
      const DiscreteProblem problem = through_file(global.file(form));
      const Eigen::MatrixXd inverse = global.mass.inverse();
      const Eigen::MatrixXd w = global.h.transpose() * inverse * global.h;
      const Eigen::VectorXd q = global.h.transpose() * inverse * global.f + global.w;
      // M has a condition of 4: rounding alone.
      EXPECT_LT((dense_matrix(problem) - w).norm(), 1e-13 * w.norm());
      EXPECT_LT((Eigen::Map<const Eigen::VectorXd>(problem.q.data(), 6) - q).norm(), 1e-13 * q.norm());
      EXPECT_EQ(problem.mu, (std::vector<double>{0.3, 0.4}));
    }
  }
}

TEST(Fclib, GravityPressesABallOnTheFloor) {
  // One ball of mass 2 above a plane: M v = H r + f with f = -dt m g e_z gives q_N = -dt g.
  Global ball;
  ball.mass = 2 * Eigen::MatrixXd::Identity(3, 3);
  ball.h.resize(3, 3);
  ball.h << 0, 1, 0, 0, 0, 1, 1, 0, 0;  // normal along z
  ball.f = Eigen::Vector3d(0, 0, -0.25);
  ball.w = Eigen::VectorXd::Zero(3);
  Archive file = ball.file();
  file.reals["fclib_global/vectors/mu"] = {0.3};
  EXPECT_EQ(through_file(file).q, (std::vector<double>{-0.125, 0, 0}));
}

Eigen::SparseMatrix<double> random_sparse(int rows, int columns, RandomStream& stream) {
  Eigen::SparseMatrix<double> matrix(rows, columns);
  for (int a = 0; a < rows; ++a)
    for (int b = 0; b < columns; ++b)
      if (a == b || stream.uniform(0, 1) < 0.3)
        matrix.insert(a, b) = a == b ? 3 + stream.uniform(0, 1) : stream.normal();
  return matrix;  // not compressed: writing it must not depend on that
}

FclibGlobalContent random_global(int block, int contacts, int freedoms) {
  RandomStream stream(20 + static_cast<std::uint64_t>(block), 1);
  FclibGlobalContent content;
  GlobalProblem& problem = content.problem;
  problem.block = block;
  problem.mass = random_sparse(freedoms, freedoms, stream);
  problem.jacobian = random_sparse(freedoms, block * contacts, stream);
  for (int a = 0; a < freedoms; ++a) problem.f.push_back(stream.normal()), content.v.push_back(stream.normal());
  for (int a = 0; a < block * contacts; ++a) {
    problem.w.push_back(stream.normal());
    content.u.push_back(stream.normal()), content.r.push_back(stream.normal());
  }
  draw_bounds(problem, contacts, stream);
  return content;
}

TEST(Fclib, GlobalProblemsReturnTheSameBits) {
  const TemporaryFolder folder;
  for (const int block : {2, 3, 5}) {
    const FclibGlobalContent content = random_global(block, 4, 9);
    write_fclib(folder.file("a.hdf5"), content);
    // The group that upstream has for rolling.
    const Archive archive = read_hdf5(folder.file("a.hdf5"), {"fclib_global", "fclib_global_rolling"});
    EXPECT_EQ(archive.reals.contains("fclib_global_rolling/vectors/mu_r"), block == 5);
    EXPECT_EQ(archive.reals.contains("fclib_global/vectors/f"), block != 5);
    const FclibGlobalContent back = read_fclib_global(folder.file("a.hdf5"));
    expect_same_bounds_and_solution(back, content);
    EXPECT_TRUE(Eigen::MatrixXd(back.problem.mass) == Eigen::MatrixXd(content.problem.mass));
    EXPECT_TRUE(Eigen::MatrixXd(back.problem.jacobian) == Eigen::MatrixXd(content.problem.jacobian));
    EXPECT_EQ(back.problem.jacobian.nonZeros(), content.problem.jacobian.nonZeros());
    EXPECT_TRUE(same_bits(back.problem.f, content.problem.f));
    EXPECT_TRUE(same_bits(back.problem.w, content.problem.w));
    EXPECT_TRUE(same_bits(back.v, content.v));
    write_fclib(folder.file("b.hdf5"), back);
    EXPECT_EQ(file_bytes(folder.file("a.hdf5")), file_bytes(folder.file("b.hdf5")));
    // Reduced by reading it as a local problem.
    const DiscreteProblem local = read_fclib(folder.file("a.hdf5")).problem, own = reduced(content.problem);
    EXPECT_EQ(local.column, own.column);
    EXPECT_TRUE(same_bits(local.value, own.value));
    EXPECT_TRUE(same_bits(local.q, own.q));
  }
}

TEST(Fclib, GlobalProblemsOfOtherSizesAreRefused) {
  const TemporaryFolder folder;
  const FclibGlobalContent sound = random_global(3, 2, 5);
  const auto refused = [&](void (*harm)(FclibGlobalContent&)) {
    FclibGlobalContent content = sound;
    harm(content);
    EXPECT_THROW(write_fclib(folder.file("a.hdf5"), content), std::invalid_argument);
  };
  refused([](FclibGlobalContent& content) { content.problem.f.pop_back(); });
  refused([](FclibGlobalContent& content) { content.problem.w.push_back(0); });
  refused([](FclibGlobalContent& content) { content.problem.mu_r = {1, 1}; });
  refused([](FclibGlobalContent& content) { content.v.pop_back(); });
  refused([](FclibGlobalContent& content) { content.u.pop_back(); });
  write_hdf5(folder.file("local.hdf5"), local_file());
  EXPECT_THROW(read_fclib_global(folder.file("local.hdf5")), InputError);
}

// ---- Refusals ----

std::string refusal(const std::string& path) {
  try {
    read_fclib(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "(read)";
}

struct Damage {
  const char* expected;
  void (*harm)(Archive& file);
};

TEST(Fclib, SaysWhatIsWrong) {
  const Damage damages[] = {
      {"expected a group 'fclib_local', 'fclib_global'", [](Archive& file) { file = {}; }},
      {"dataset 'fclib_local/spacedim' is 4: expected 2, 3 or 5",
       [](Archive& file) { file.integers["fclib_local/spacedim"] = {4}; }},
      {"dataset 'fclib_local/spacedim' has 2 values: expected 1",
       [](Archive& file) {
         file.integers["fclib_local/spacedim"] = {2, 2};
       }},
      {"dataset 'fclib_local/vectors/q' is missing: expected real numbers",
       [](Archive& file) { file.reals.erase("fclib_local/vectors/q"); }},
      {"dataset 'fclib_local/vectors/q' has another type: expected real numbers",
       [](Archive& file) {
         file.reals.erase("fclib_local/vectors/q");
         file.integers["fclib_local/vectors/q"] = {1, 2};
       }},
      {"dataset 'fclib_local/vectors/q' has 3 values: expected 2 (one for each row of W)",
       [](Archive& file) { file.reals["fclib_local/vectors/q"].push_back(0); }},
      {"dataset 'fclib_local/vectors/mu' has 2 values: expected 1 (one for each contact)",
       [](Archive& file) {
         file.reals["fclib_local/vectors/mu"] = {1, 1};
       }},
      {"'fclib_local' has 2 rows: expected a multiple of spacedim = 3",
       [](Archive& file) { file.integers["fclib_local/spacedim"] = {3}; }},
      {"dataset 'fclib_local/W/nz' is -7: expected a number of triplets, -1",
       [](Archive& file) { file.integers["fclib_local/W/nz"] = {-7}; }},
      {"dataset 'fclib_local/W/m' is -1: expected a size",
       [](Archive& file) { file.integers["fclib_local/W/m"] = {-1}; }},
      {"has 3 rows and 2 columns: expected a square one",
       [](Archive& file) { file.integers["fclib_local/W/m"] = {3}; }},
      {"dataset 'fclib_local/W/i' holds the index 2: expected 0 to 1",
       [](Archive& file) { file.integers["fclib_local/W/i"][3] = 2; }},
      {"dataset 'fclib_local/W/i' holds the index -1", [](Archive& file) { file.integers["fclib_local/W/i"][0] = -1; }},
      {"dataset 'fclib_local/W/p' has 2 values: expected 3",
       [](Archive& file) { file.integers["fclib_local/W/p"].pop_back(); }},
      {"dataset 'fclib_local/W/p' falls at 2",
       [](Archive& file) {
         file.integers["fclib_local/W/p"] = {0, 2, 1};
       }},
      {"dataset 'fclib_local/W/p' begins with 1",
       [](Archive& file) {
         file.integers["fclib_local/W/p"] = {1, 2, 4};
       }},
      {"dataset 'fclib_local/W/x' has 3 values: expected 4",
       [](Archive& file) { file.reals["fclib_local/W/x"].pop_back(); }},
      {"dataset 'fclib_local/W/i' has 4 values: expected 2000000000",
       [](Archive& file) { file.integers["fclib_local/W/nz"] = {2000000000}; }},
      {"W(0, 0) is negative", [](Archive& file) { file.reals["fclib_local/W/x"][0] = -1; }},
      {"not finite", [](Archive& file) { file.reals["fclib_local/W/x"][1] = std::numeric_limits<double>::infinity(); }},
      {"mu of contact 0 is -1", [](Archive& file) { file.reals["fclib_local/vectors/mu"] = {-1}; }},
      {"dataset 'solution/r' has 1 values: expected 2", [](Archive& file) { file.reals["solution/r"] = {0}; }},
      {"dataset 'solution/u' is missing",
       [](Archive& file) {
         file.reals["solution/r"] = {0, 0};
       }},
      {"equality constraints ('fclib_local/V')", [](Archive& file) { file.integers["fclib_local/V/n"] = {1}; }},
  };
  const TemporaryFolder folder;
  for (const Damage& damage : damages) {
    Archive file = local_file();
    damage.harm(file);
    write_hdf5(folder.file("bad.hdf5"), file);
    const std::string said = refusal(folder.file("bad.hdf5"));
    EXPECT_NE(said.find(damage.expected), std::string::npos) << said;
    EXPECT_NE(said.find("bad.hdf5"), std::string::npos) << said;
  }
}

TEST(Fclib, SaysWhatIsWrongWithAGlobalProblem) {
  const TemporaryFolder folder;
  const auto said = [&](const Archive& file) {
    write_hdf5(folder.file("bad.hdf5"), file);
    return refusal(folder.file("bad.hdf5"));
  };
  Global global;
  Archive equality = global.file();
  equality.integers["fclib_global/G/n"] = {2};
  EXPECT_NE(said(equality).find("equality constraints ('fclib_global/G')"), std::string::npos) << said(equality);
  global.mass(5, 5) = 0;
  EXPECT_NE(said(global.file()).find("'fclib_global/M' is not positive definite"), std::string::npos);
  global.mass(1, 2) = 1;
  EXPECT_NE(said(global.file()).find("'fclib_global/M' is singular"), std::string::npos) << said(global.file());
  Archive narrow = Global().file();
  narrow.integers["fclib_global/H/m"] = {9};
  EXPECT_NE(said(narrow).find("expected a square M, with as many rows as H"), std::string::npos);
}

TEST(Fclib, FilesThatAreNone) {
  const TemporaryFolder folder;
  EXPECT_NE(refusal(folder.file("absent.hdf5")).find("absent.hdf5"), std::string::npos);
  put_bytes(folder.file("text.hdf5"), "title = \"a scene\"\n");
  EXPECT_NE(refusal(folder.file("text.hdf5")).find("not an HDF5 file"), std::string::npos);
  put_bytes(folder.file("empty.hdf5"), "");
  EXPECT_NE(refusal(folder.file("empty.hdf5")).find("not an HDF5 file"), std::string::npos);
}

TEST(Fclib, TruncatedFilesAreRefused) {
  const TemporaryFolder folder;
  write_fclib(folder.file("a.hdf5"), random_content(3, 6, 3));
  const std::string bytes = file_bytes(folder.file("a.hdf5"));
  for (std::size_t k = 0; k < 64; ++k) {
    put_bytes(folder.file("cut.hdf5"), bytes.substr(0, bytes.size() * k / 64));
    EXPECT_NE(refusal(folder.file("cut.hdf5")).find("cut.hdf5"), std::string::npos) << k;
  }
}

// ---- Problems of other codes, where they are at hand ----

TEST(Fclib, ProblemsOfOtherCodes) {
  const char* given = std::getenv("GALET_FCLIB");
  const std::filesystem::path folder = given != nullptr ? given : GALET_SOURCE_DIR "/../shared/fclib";
  if (!std::filesystem::is_directory(folder))
    GTEST_SKIP() << "no folder " << folder << " with problems of other codes (or name one in GALET_FCLIB)";
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".hdf5") continue;
    SCOPED_TRACE(entry.path().filename());
    const DiscreteProblem problem = read_fclib(entry.path().string()).problem;
    EXPECT_GT(problem.contacts(), 0);
    ++files;
    if (entry.path().filename() == "Box_Stacks-i0122-82-5.hdf5") {
      // Stored in global form, boxes under gravity that rest: without reactions contacts would close.
      EXPECT_EQ(problem.contacts(), 82);
      EXPECT_LT(*std::min_element(problem.q.begin(), problem.q.end()), 0);
      double closing = 0, opening = 0;
      for (int c = 0; c < problem.contacts(); ++c)
        (problem.q[3 * c] < 0 ? closing : opening) += std::abs(problem.q[3 * c]);
      EXPECT_GT(closing, 10 * opening);
    }
  }
  EXPECT_GT(files, 0);
}

}  // namespace
}  // namespace galet::cd::fclib_test
