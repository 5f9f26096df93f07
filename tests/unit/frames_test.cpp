// Files of states for other programs: their numbers read back, by this test and by VTK itself, and their collections.
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <sstream>

#include <gtest/gtest.h>

#include "common/io/files.hpp"
#include "common/io/particle_text.hpp"
#include "common/io/vtk.hpp"
#include "src/frame_files.hpp"
#include "tests/support/lattices.hpp"
#include "tests/support/other_programs.hpp"
#include "tests/support/temporary_folder.hpp"

namespace galet::test::frames_test {
namespace {

using test::snapshot_of, test::TemporaryFolder;

/// The bytes that a base64 text stands for.
std::string decoded(std::string_view text) {
  std::string bytes;
  std::uint32_t four = 0;
  int digits = 0;
  for (const char c : text) {
    if (c == '=') break;
    const int value = c >= 'A' && c <= 'Z'   ? c - 'A'
                      : c >= 'a' && c <= 'z' ? c - 'a' + 26
                      : c >= '0' && c <= '9' ? c - '0' + 52
                      : c == '+'             ? 62
                                             : 63;
    four = four << 6 | static_cast<std::uint32_t>(value);
    if (++digits % 4 != 0) continue;
    for (const int shift : {16, 8, 0}) bytes += static_cast<char>(four >> shift & 255);
    four = 0;
  }
  if (digits % 4 == 2) bytes += static_cast<char>(four >> 4 & 255);
  if (digits % 4 == 3) bytes += static_cast<char>(four >> 10 & 255), bytes += static_cast<char>(four >> 2 & 255);
  return bytes;
}

/// The values of the array of that name.
std::vector<double> array(const std::string& file, const std::string& name) {
  const auto at = file.find("Name=\"" + name + "\"");
  if (at == std::string::npos) return {};
  const auto begin = file.find('>', at) + 1, end = file.find('<', begin);
  const std::string bytes = decoded(std::string_view(file).substr(begin, end - begin));
  std::uint64_t size = 0;
  std::memcpy(&size, bytes.data(), 8);
  EXPECT_EQ(size, bytes.size() - 8) << name;
  const auto type_at = file.find('"', file.rfind("<DataArray type=", at)) + 1;
  const std::string type = file.substr(type_at, file.find('"', type_at) - type_at);
  std::vector<double> values;
  for (std::size_t k = 8; k < bytes.size();) {
    if (type == "Float64") {
      double value;
      std::memcpy(&value, bytes.data() + k, 8);
      values.push_back(value), k += 8;
    } else if (type == "Int64") {
      std::int64_t value;
      std::memcpy(&value, bytes.data() + k, 8);
      values.push_back(static_cast<double>(value)), k += 8;
    } else {
      values.push_back(static_cast<unsigned char>(bytes[k])), k += 1;
    }
  }
  return values;
}

struct State {
  Sample<3> sample = test::face_centred(2);
  ContactColumns<3> contacts;
  State() {
    sample.cell.box.col(1) += 0.25 * sample.cell.box.col(0);
    sample.cell.rate(0, 1) = 0.3;
    for (int i = 0; i < sample.count(); ++i) {
      sample.position[i] += Vec<3>::Constant(1.0 / 3);
      sample.velocity[i] = Vec<3>(0.1 * i, -1.0 / 7, 1e-17);
      sample.spin[i] = Vec<3>(1, 2, i);
      sample.radius[i] = 0.4 + 0.01 * i;
      sample.material[i] = i % 2;
    }
    contacts = test::brute_force_contacts<3>(sample, 0.3, [](int i, int j, double gap) { return 1 + gap * i + j; });
    contacts.mobilised.assign(contacts.size(), 0.5);
    contacts.touching.assign(contacts.size(), 1);
    contacts.touching[1] = 0;
  }
  Snapshot<3> snapshot() const {
    Snapshot<3> shown = snapshot_of(sample, contacts);
    shown.time = 2.5;
    return shown;
  }
};

TEST(Vtk, GrainsBitForBit) {
  const State state;
  const std::string file = vtp_grains(state.snapshot(), state.sample.material);
  const std::vector<double> x = array(file, "Points"), v = array(file, "velocity"), w = array(file, "angular_velocity");
  const std::vector<double> radius = array(file, "radius"), material = array(file, "material"), id = array(file, "id");
  const std::size_t grains = state.sample.position.size();
  ASSERT_EQ(x.size(), 3 * grains);
  ASSERT_EQ(radius.size(), grains);
  EXPECT_EQ(array(file, "connectivity").size(), grains);
  const Mat<3> inverse = state.sample.cell.box.inverse();
  double ends = 0;
  for (double count : array(file, "contacts")) ends += count;
  EXPECT_EQ(ends, 2.0 * static_cast<double>(state.contacts.size() - 1));  // one pair does not touch
  for (std::size_t i = 0; i < grains; ++i) {
    const Vec<3> at(x[3 * i], x[3 * i + 1], x[3 * i + 2]);
    const Vec<3> inside = inverse * at, moved = inverse * (at - state.sample.position[i]);
    for (int a = 0; a < 3; ++a) {
      EXPECT_GE(inside[a], -1e-15);
      EXPECT_LT(inside[a], 1);
      EXPECT_NEAR(moved[a], std::round(moved[a]), 1e-14);  // by whole cell vectors
      EXPECT_EQ(w[3 * i + a], state.sample.spin[i][a]);
    }
    EXPECT_EQ(v[3 * i], state.sample.velocity[i].x() + 0.3 * at.y());
    EXPECT_EQ(radius[i], state.sample.radius[i]);
    EXPECT_EQ(material[i], state.sample.material[i]);
    EXPECT_EQ(id[i], static_cast<double>(i));
  }
}

TEST(Vtk, ContactsAndCell) {
  const State state;
  const std::string file = vtp_contacts(state.snapshot());
  const std::vector<double> points = array(file, "Points"), force = array(file, "force"), gap = array(file, "gap");
  const std::vector<double> normal = array(file, "normal_force"), touching = array(file, "touching");
  ASSERT_EQ(points.size(), 6 * state.contacts.size());
  for (std::size_t c = 0; c < state.contacts.size(); ++c) {
    for (int a = 0; a < 3; ++a) {
      EXPECT_EQ(force[3 * c + a], state.contacts.force[c][a]);
      EXPECT_NEAR(points[6 * c + 3 + a] - points[6 * c + a], state.contacts.branch[c][a], 1e-14);
    }
    EXPECT_EQ(gap[c], state.contacts.gap[c]);
    EXPECT_NEAR(normal[c], state.contacts.force[c].norm(), 1e-14);
    EXPECT_EQ(touching[c], c == 1 ? 0 : 1);
  }
  EXPECT_EQ(array(file, "mobilised"), state.contacts.mobilised);
  EXPECT_EQ(array(vtp_cell(state.snapshot()), "Points").size(), 12u * 2 * 3);
  const Sample<2> flat = test::square(2);
  const ContactColumns<2> none;
  EXPECT_EQ(array(vtp_cell(snapshot_of(flat, none)), "Points").size(), 4u * 2 * 3);
  EXPECT_EQ(array(vtp_grains(snapshot_of(flat, none)), "Points")[5], 0);  // the z of a disk
  EXPECT_TRUE(array(vtp_contacts(snapshot_of(flat, none)), "force").empty());
}

/// Spheres in a box: a floor and a lid (outside of the sample), an oblique wall that cuts the cell's corner off, and a
/// cylinder along y that turns.
struct Walled {
  State state;
  double side;
  Walled() {
    Cell<3>& cell = state.sample.cell;
    side = cell.box(0, 0);
    cell.box = side * Mat<3>::Identity();
    cell.rate.setZero();
    cell.periodic = {true, true, false};
    for (double& radius : state.sample.radius) radius = 0.2;
    for (Vec<3>& x : state.sample.position) x = Vec<3>(0.5, 0.5, 0.1).cwiseProduct(x) + Vec<3>::Constant(1);
    Plane<3> floor, lid, corner, cylinder;
    floor.normal = Vec<3>::UnitZ();
    floor.velocity = Vec<3>(0.5, 0, 0);
    lid.point = Vec<3>(0, 0, side + 2);
    lid.normal = -Vec<3>::UnitZ();
    corner.point = Vec<3>(side / 2, 0, 0);
    corner.normal = Vec<3>(1, 1, 1).normalized();
    cylinder.point = Vec<3>(side / 2, 0, side / 2);
    cylinder.axis = Vec<3>::UnitY();
    cylinder.radius = 0.7;
    cylinder.inside = false;
    cylinder.spin = Vec<3>(0, 3, 0);
    state.sample.planes = {floor, lid, corner, cylinder};
  }
};

TEST(Vtk, WallsAreCutToTheSample) {
  const Walled walled;
  const std::string file = vtp_walls(walled.state.snapshot());
  const std::vector<double> x = array(file, "Points"), j = array(file, "j"), ends = array(file, "offsets");
  const std::vector<double> velocity = array(file, "velocity"), normal = array(file, "normal");
  ASSERT_EQ(ends.size(), 3u + 96u);
  EXPECT_EQ(std::vector<double>(ends.begin(), ends.begin() + 4), (std::vector<double>{4, 8, 11, 15}));
  const double side = walled.side, grains = walled.state.sample.count();
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(x[3 * k + 2], 0, 1e-14);               // floor
    EXPECT_NEAR(x[3 * (4 + k) + 2], side + 2, 1e-14);  // lid: as large as the shadow of the cell
    for (int a = 0; a < 2; ++a)
      for (const std::size_t corner : {k, 4 + k}) EXPECT_NEAR(std::abs(x[3 * corner + a] - side / 2), side / 2, 1e-14);
  }
  for (std::size_t k = 8; k < 11; ++k)  // corners of the oblique wall: side / 2 on one axis
    EXPECT_NEAR(x[3 * k] + x[3 * k + 1] + x[3 * k + 2], side / 2, 1e-14);
  for (std::size_t k = 11; k < x.size() / 3; ++k)
    EXPECT_NEAR(std::hypot(x[3 * k] - side / 2, x[3 * k + 2] - side / 2), 0.7, 1e-14);
  EXPECT_EQ(j[0], grains);
  EXPECT_EQ(j[3], grains + 3);
  EXPECT_EQ(velocity[0], 0.5);
  for (std::size_t face = 3; face < ends.size(); ++face) {  // a surface that turns: w x R, and outside of it the grains
    EXPECT_NEAR(Vec<3>(velocity[3 * face], velocity[3 * face + 1], velocity[3 * face + 2]).norm(), 3 * 0.7, 1e-13);
    EXPECT_NEAR(velocity[3 * face] - 3 * 0.7 * normal[3 * face + 2], 0, 1e-13);
  }
  Sample<2> drum = test::square(3);
  drum.planes.resize(2);
  drum.planes[1].radius = 2;
  const ContactColumns<2> none;
  const std::vector<double> lines = array(vtp_walls(snapshot_of(drum, none)), "offsets");
  EXPECT_EQ(lines, (std::vector<double>{2, 99}));  // a stretch and a closed circle
}

TEST(Vtk, GrainsOfRigidBodies) {
  const State state;
  Snapshot<3> snapshot = state.snapshot();
  EXPECT_EQ(array(vtp_grains(snapshot), "body"), std::vector<double>(state.sample.position.size(), -1));
  std::vector<RigidBody<3>> bodies(2);
  bodies[0].turning = Turning::free;
  bodies[0].mobility = Mat<3>::Identity();
  bodies[1].mobility = Vec<3>::UnitZ().asDiagonal();
  std::vector<int> body_of(state.sample.position.size(), -1);
  body_of[1] = 0, body_of[2] = 1;
  snapshot.bodies = bodies, snapshot.body_of = body_of;
  const std::string file = vtp_grains(snapshot);
  EXPECT_EQ(array(file, "body"), std::vector<double>(body_of.begin(), body_of.end()));
  const std::vector<double> boundary = array(file, "boundary");
  EXPECT_EQ(boundary[0] + boundary[1], 0);  // alone; in a clump
  EXPECT_EQ(boundary[2], 1);                // in a wall
}

constexpr const char* vtk_script = R"(
import vtk, xml.etree.ElementTree as tree
from vtk.util.numpy_support import vtk_to_numpy
def read(path):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()
folder = sys.argv[1] + '/'
parts = [read(folder + 'md_%s_000001.vtp' % part) for part in ('grains', 'contacts', 'cell', 'walls')]
grains, contacts, cell, walls = parts
radius = vtk_to_numpy(grains.GetPointData().GetArray('radius'))
force = vtk_to_numpy(contacts.GetCellData().GetArray('force'))
print(grains.GetNumberOfPoints(), grains.GetNumberOfVerts(), contacts.GetNumberOfLines(), cell.GetNumberOfLines())
print(repr(float(radius.sum())), repr(float(force[:, 0].sum())), grains.GetPointData().GetArray('velocity').GetNumberOfComponents())
print(len(tree.parse(folder + 'md_walls.pvd').getroot().find('Collection').findall('DataSet')))
print(int(vtk_to_numpy(cell.GetCellData().GetArray('periodic')).sum()), walls.GetNumberOfPolys())
area = {}
for k in range(walls.GetNumberOfCells()):
    wall = walls.GetCellData().GetArray('j').GetTuple1(k)
    face = walls.GetCell(k)
    ids = vtk.vtkIdList()
    for corner in range(face.GetNumberOfPoints()): ids.InsertNextId(face.GetPointId(corner))
    normal = [0, 0, 0]
    area[wall] = area.get(wall, 0) + vtk.vtkPolygon.ComputeArea(walls.GetPoints(), ids.GetNumberOfIds(), [ids.GetId(c) for c in range(ids.GetNumberOfIds())], normal)
print(*[repr(area[wall]) for wall in sorted(area)])
)";

TEST(Vtk, IsReadByVtk) {
  const Walled walled;
  const State& state = walled.state;
  const TemporaryFolder folder;
  FrameFiles(folder.file("md"), {"paraview"}, state.sample.material)
      .write(Frame{10, {0, 2.5}, {0, 10}}, state.snapshot());
  const std::optional<std::string> text = said_by_python("vtk, numpy", vtk_script, folder);
  if (!text) GTEST_SKIP() << "python3-vtk9 is not installed: VTK did not read the files";
  std::istringstream said(*text);
  double radius = 0, force = 0, sum_radius, sum_force;
  std::size_t points, verts, lines, edges, components, sets, periodic, polygons;
  said >> points >> verts >> lines >> edges >> sum_radius >> sum_force >> components >> sets >> periodic >> polygons;
  EXPECT_EQ(points, state.sample.position.size());
  EXPECT_EQ(verts, points);
  EXPECT_EQ(lines, state.contacts.size());
  EXPECT_EQ(edges, 12u);
  EXPECT_EQ(components, 3u);
  EXPECT_EQ(sets, 2u);
  EXPECT_EQ(periodic, 8u);  // four edges along each of two directions
  EXPECT_EQ(polygons, 3u + 96u);
  for (double r : state.sample.radius) radius += r;
  for (const Vec<3>& f : state.contacts.force) force += f.x();
  EXPECT_NEAR(sum_radius, radius, 1e-12 * radius);
  EXPECT_NEAR(sum_force, force, 1e-10);
  // Areas, in closed form: squares, an equilateral triangle with corners at side / 2, and a tube of 96 sides.
  const double side = walled.side;
  for (const double exact : {side * side, side * side, std::sqrt(3.0) / 8 * side * side,
                             96 * 2 * 0.7 * std::sin(std::numbers::pi / 96) * side}) {
    double area = 0;
    said >> area;
    EXPECT_NEAR(area, exact, 1e-12 * exact);
  }
}

TEST(ParticleText, ExtendedXyz) {
  const State state;
  std::istringstream text(extended_xyz(state.snapshot(), state.sample.material));
  std::string line;
  std::getline(text, line);
  EXPECT_EQ(line, std::to_string(state.sample.count()));
  std::getline(text, line);
  EXPECT_NE(
      line.find("pbc=\"T T T\" Time=2.5 Properties=id:I:1:species:S:1:pos:R:3:radius:R:1:mass:R:1:velo:R:3:omega:R:3"),
      std::string::npos);
  std::istringstream lattice(line.substr(line.find('"') + 1));
  for (int k = 0; k < 9; ++k) {
    double value;
    lattice >> value;
    EXPECT_EQ(value, state.sample.cell.box.data()[k]);  // vectors one after the other: columns
  }
  for (int i = 0; i < state.sample.count(); ++i) {
    double id, species, x, y, z, radius, mass, vx;
    text >> id >> species >> x >> y >> z >> radius >> mass >> vx;
    std::getline(text, line);
    EXPECT_EQ(id, i);
    EXPECT_EQ(species, i % 2 + 1);
    EXPECT_EQ(radius, state.sample.radius[i]);
    EXPECT_EQ(vx, state.sample.velocity[i].x() + 0.3 * y);
  }
}

TEST(ParticleText, LammpsDumpOfATiltedCell) {
  const State state;
  const std::string text = lammps_dump(state.snapshot(), 42, state.sample.material);
  const double lx = state.sample.cell.box(0, 0), tilt = state.sample.cell.box(0, 1);
  std::istringstream lines(text);
  std::string line;
  for (int k = 0; k < 5; ++k) std::getline(lines, line);
  EXPECT_EQ(line, "ITEM: BOX BOUNDS xy xz yz pp pp pp");
  double low, high, xy;
  lines >> low >> high >> xy;
  EXPECT_EQ(low, 0);
  EXPECT_EQ(high, lx + tilt);  // the rectangle around the tilted cell
  EXPECT_EQ(xy, tilt);
  EXPECT_EQ(text.find("ITEM: TIMESTEP\n42\nITEM: NUMBER OF ATOMS\n32\n"), 0u);
  State turned;
  turned.sample.cell.box(1, 0) = 0.1;
  EXPECT_THROW(lammps_dump(turned.snapshot(), 0), std::invalid_argument);
}

// A collection names, at each moment, files that exist: all frames so far, with their times.
TEST(FrameFiles, CollectionsListWhatIsThere) {
  const State state;
  const TemporaryFolder folder;
  const FrameFiles files(folder.file("cd"), {"paraview", "xyz", "lammps"}, {});
  std::vector<double> times;
  for (int k = 0; k < 3; ++k) {
    times.push_back(0.5 * k);
    files.write(Frame{5L * k, times, {}}, state.snapshot());
    for (const char* part : {"grains", "contacts", "cell"}) {
      std::string expected =
          "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" "
          "byte_order=\"LittleEndian\">\n<Collection>\n";
      for (int frame = 0; frame <= k; ++frame) {
        const std::string name = std::string("cd_") + part + "_00000" + std::to_string(frame) + ".vtp";
        expected += "<DataSet timestep=\"" +
                    std::string(frame == 0   ? "0"
                                : frame == 1 ? "0.5"
                                             : "1") +
                    "\" part=\"0\" file=\"" + name + "\"/>\n";
        EXPECT_FALSE(read_file(folder.file(name)).empty());
      }
      EXPECT_EQ(read_file(folder.file(std::string("cd_") + part + ".pvd")), expected + "</Collection>\n</VTKFile>\n");
    }
  }
  EXPECT_EQ(folder.entries(), 3 * 3 + 3 + 3 + 3);  // frames, collections, xyz, dumps; nothing temporary
}

}  // namespace
}  // namespace galet::test::frames_test
