// States, trajectories and tables in HDF5, read back by this program's own reader and by h5py.
#include "common/io/hdf5_states.hpp"

#include <sstream>

#include <gtest/gtest.h>

#include "common/io/files.hpp"
#include "common/io/hdf5_tree.hpp"
#include "src/frame_files.hpp"
#include "tests/support/lattices.hpp"
#include "tests/support/other_programs.hpp"
#include "tests/support/temporary_folder.hpp"

namespace galet::test::hdf5_states_test {
namespace {

using test::snapshot_of, test::TemporaryFolder;

struct State {
  Sample<3> sample = test::face_centred(2);
  ContactColumns<3> contacts;
  State() {
    sample.cell.box.col(1) += 0.25 * sample.cell.box.col(0);
    sample.cell.rate(0, 1) = 0.3;
    for (int i = 0; i < sample.count(); ++i) {
      sample.velocity[i] = Vec<3>(0.1 * i, -1.0 / 7, 1e-17);
      sample.spin[i] = Vec<3>(1, 2, i);
      sample.radius[i] = 0.4 + 0.01 * i;
      sample.material[i] = i % 2;
    }
    contacts = test::brute_force_contacts<3>(sample, 0.3, [](int i, int j, double gap) { return 1 + gap * i + j; });
    contacts.mobilised.assign(contacts.size(), 0.5);
  }
  Snapshot<3> snapshot() const {
    Snapshot<3> shown = snapshot_of(sample, contacts);
    shown.time = 2.5;
    shown.engine = "md";
    return shown;
  }
};

TEST(Hdf5States, HoldTheSnapshotBitForBit) {
  const State state;
  const TemporaryFolder folder;
  write_file(folder.file("a.h5"), hdf5_state(state.snapshot(), {7, state.sample.material, true}));
  const Archive read = read_hdf5(folder.file("a.h5"), {"cell", "grains", "contacts", "planes"});
  const std::size_t grains = state.sample.position.size(), contacts = state.contacts.size();
  EXPECT_EQ(read.reals.at("cell/box")[1], state.sample.cell.box(0, 1));  // row by row
  EXPECT_EQ(read.reals.at("cell/rate")[1], 0.3);
  ASSERT_EQ(read.reals.at("grains/position").size(), 3 * grains);
  for (std::size_t i = 0; i < grains; ++i) {
    EXPECT_EQ(read.reals.at("grains/radius")[i], state.sample.radius[i]);
    EXPECT_EQ(read.integers.at("grains/material")[i], state.sample.material[i]);
    EXPECT_EQ(read.reals.at("grains/velocity")[3 * i],
              state.sample.velocity[i].x() + 0.3 * read.reals.at("grains/position")[3 * i + 1]);
    for (std::size_t a = 0; a < 3; ++a) {
      EXPECT_EQ(read.reals.at("grains/fluctuation")[3 * i + a], state.sample.velocity[i][static_cast<int>(a)]);
      EXPECT_EQ(read.reals.at("grains/angular_velocity")[3 * i + a], state.sample.spin[i][static_cast<int>(a)]);
    }
  }
  ASSERT_EQ(read.reals.at("contacts/force").size(), 3 * contacts);
  for (std::size_t c = 0; c < contacts; ++c) {
    EXPECT_EQ(read.integers.at("contacts/j")[c], state.contacts.j[c]);
    EXPECT_EQ(read.reals.at("contacts/gap")[c], state.contacts.gap[c]);
    EXPECT_EQ(read.reals.at("contacts/force")[3 * c + 2], state.contacts.force[c].z());
  }
  EXPECT_EQ(read.reals.at("contacts/mobilised"), state.contacts.mobilised);
  EXPECT_TRUE(read.reals.at("planes/point").empty());
  EXPECT_FALSE(read.integers.contains("grains/body"));
  EXPECT_EQ(hdf5_state(state.snapshot(), {7, {}, true}), hdf5_state(state.snapshot(), {7, {}, true}));

  // Cylinders are told from planes, and grains of a body from others.
  Sample<3> walled = state.sample;
  walled.planes.resize(2);
  walled.planes[1].radius = 4, walled.planes[1].spin = Vec<3>(0, 0, 7), walled.planes[1].axis = Vec<3>::UnitX();
  Snapshot<3> shown = snapshot_of(walled, state.contacts);
  std::vector<int> body_of(grains, -1);
  body_of[3] = 0;
  shown.body_of = body_of;
  write_file(folder.file("w.h5"), hdf5_state(shown, {}));
  const Archive walls = read_hdf5(folder.file("w.h5"), {"grains", "planes"});
  EXPECT_EQ(walls.reals.at("planes/radius"), (std::vector<double>{0, 4}));
  EXPECT_EQ(walls.reals.at("planes/angular_velocity")[5], 7);
  EXPECT_EQ(walls.reals.at("planes/axis")[3], 1);
  EXPECT_EQ(walls.integers.at("grains/body")[3], 0);
  EXPECT_EQ(walls.integers.at("grains/body")[4], -1);

  // A plane without friction has neither spins nor mobilised friction.
  const Sample<2> flat = test::square(2);
  const ContactColumns<2> none;
  Snapshot<2> bare = snapshot_of(flat, none);
  bare.spin = {};
  write_file(folder.file("b.h5"), hdf5_state(bare, {}));
  const Archive plain = read_hdf5(folder.file("b.h5"), {"grains", "contacts"});
  EXPECT_FALSE(plain.reals.contains("grains/angular_velocity") || plain.reals.contains("contacts/mobilised"));
  EXPECT_EQ(plain.reals.at("grains/position").size(), 8u);
}

constexpr const char* h5py_script = R"(
import h5py, numpy
folder = sys.argv[1] + '/'
run = h5py.File(folder + 'md_trajectory.h5', 'r')
print(run['time'].shape[0], run['step'][1], len(run['frames']))
last = run['frames/000001']
print(last.attrs['engine'], last.attrs['step'], last.attrs['dimension'], repr(float(last.attrs['time'])))
print(*last['grains/position'].shape, *last['cell/box'].shape)
print(last['grains/velocity'].attrs['unit'], last['contacts/force'].attrs['unit'], 'unit' in last['contacts/i'].attrs)
print(repr(float(numpy.sum(last['contacts/force'][:, 0]))))
table = h5py.File(folder + 'table.h5', 'r')
print(table['p'].attrs['unit'], table['p'].attrs['meaning'].replace(' ', '_'), numpy.isnan(table['p'][1]))
)";

TEST(Hdf5States, AreReadByH5py) {
  const State state;
  const TemporaryFolder folder;
  const FrameFiles files(folder.file("md"), {"hdf5"}, state.sample.material, true);
  files.write(Frame{0, {0}, {0}}, state.snapshot());
  files.write(Frame{10, {0, 2.5}, {0, 10}}, state.snapshot());
  EXPECT_EQ(folder.entries(), 3);
  write_file(folder.file("table.h5"),
             hdf5_table({{"p: mean stress", "of a test"}, {{"p", "Pa"}}, {{1.5}, {std::monostate{}}}}));
  const std::optional<std::string> text = said_by_python("h5py, numpy", h5py_script, folder);
  if (!text) GTEST_SKIP() << "python3-h5py is not installed: h5py did not read the files";
  std::istringstream said(*text);
  const auto expect = [&](const std::string& word) {
    std::string found;
    said >> found;
    EXPECT_EQ(found, word);
  };
  for (const char* word : {"2", "10", "2", "md", "10", "3", "2.5"}) expect(word);
  expect(std::to_string(state.sample.count()));
  for (const char* word : {"3", "3", "3", "m/s", "N", "False"}) expect(word);
  double sum = 0, force = 0;
  said >> sum;
  for (const Vec<3>& f : state.contacts.force) force += f.x();
  EXPECT_NEAR(sum, force, 1e-10);
  for (const char* word : {"Pa", "mean_stress", "True"}) expect(word);
}

}  // namespace
}  // namespace galet::test::hdf5_states_test
