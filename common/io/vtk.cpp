#include "common/io/vtk.hpp"

#include <cstdint>
#include <cstring>

#include <fmt/format.h>

#include "common/geometry/boundary_surface.hpp"
#include "common/geometry/wrap.hpp"
#include "common/io/base64.hpp"

namespace galet {

namespace {

static_assert(sizeof(double) == 8);

/// A DataArray element; each value of Number in the order of the file.
template <class Number>
std::string data_array(const std::string& name, const std::vector<Number>& values, int components = 1) {
  const char* type = std::is_same_v<Number, double>         ? "Float64"
                     : std::is_same_v<Number, std::int64_t> ? "Int64"
                                                            : "UInt8";
  const std::uint64_t size = values.size() * sizeof(Number);
  std::string bytes(sizeof size + size, '\0');
  std::memcpy(bytes.data(), &size, sizeof size);
  if (size > 0) std::memcpy(bytes.data() + sizeof size, values.data(), size);
  return fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"binary\">{}</DataArray>\n",
                     type, name, components, base64(bytes));
}

template <int D>
void append_components(std::vector<double>& flat, const Vec<D>& value) {
  for (int a = 0; a < 3; ++a) flat.push_back(a < D ? value[a] : 0.0);
}
void append_components(std::vector<double>& flat, double spin) { flat.insert(flat.end(), {0, 0, spin}); }

/// The cells of a file, all of one kind ("Verts", "Lines" or "Polys"), each of some consecutive points.
struct Cells {
  std::string kind;
  std::vector<std::int64_t> ends;  ///< of each cell: the number of the point behind its last

  static Cells of_size(const std::string& kind, std::size_t count, int size) {
    Cells cells{kind, {}};
    for (std::size_t k = 0; k < count; ++k) cells.ends.push_back(static_cast<std::int64_t>(k + 1) * size);
    return cells;
  }
  std::string text() const {
    std::vector<std::int64_t> points(ends.empty() ? 0 : static_cast<std::size_t>(ends.back()));
    for (std::size_t k = 0; k < points.size(); ++k) points[k] = static_cast<std::int64_t>(k);
    return fmt::format("<{0}>\n{1}{2}</{0}>\n", kind, data_array("connectivity", points), data_array("offsets", ends));
  }
  std::size_t count_of(std::string_view other) const { return kind == other ? ends.size() : 0; }
};

/// A whole file. `points`: three numbers each.
std::string poly_data(const std::vector<double>& points, const std::string& point_data, const std::string& cell_data,
                      const Cells& cells) {
  return fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
      "<PolyData>\n<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
      "NumberOfPolys=\"{}\">\n<PointData>\n{}</PointData>\n<CellData>\n{}</CellData>\n<Points>\n{}</Points>\n{}"
      "</Piece>\n</PolyData>\n</VTKFile>\n",
      points.size() / 3, cells.count_of("Verts"), cells.count_of("Lines"), cells.count_of("Polys"), point_data,
      cell_data, data_array("Points", points, 3), cells.text());
}

}  // namespace

template <int D>
std::string vtp_grains(const Snapshot<D>& snapshot, const std::vector<int>& material) {
  const Cell<D>& cell = *snapshot.cell;
  const Mat<D> inverse = cell.box.inverse();
  std::vector<double> points, velocity, fluctuation, spin;
  std::vector<std::int64_t> id, kind, body, contacts(snapshot.grains(), 0);
  std::vector<std::uint8_t> boundary;
  for (std::size_t c = 0; c < snapshot.contacts->size(); ++c) {
    if (!snapshot.contacts->touches(c)) continue;
    ++contacts[snapshot.contacts->i[c]];
    if (const int j = snapshot.contacts->j[c]; j < snapshot.grains()) ++contacts[j];
  }
  for (int i = 0; i < snapshot.grains(); ++i) {
    const Vec<D> x = wrapped_position<D>(cell, inverse, snapshot.position[i]);
    append_components<D>(points, x);
    append_components<D>(velocity, snapshot.velocity[i] + cell.rate * x);
    append_components<D>(fluctuation, snapshot.velocity[i]);
    append_components(spin, snapshot.spin.empty() ? zero_spin<D>() : snapshot.spin[i]);
    id.push_back(i);
    kind.push_back(material.empty() ? 0 : material[i]);
    body.push_back(snapshot.body_of.empty() ? -1 : snapshot.body_of[i]);
    boundary.push_back(body.back() >= 0 && !snapshot.in_free_body(i) ? 1 : 0);
  }
  const std::vector<double> radius(snapshot.radius.begin(), snapshot.radius.end());
  const std::vector<double> mass(snapshot.mass.begin(), snapshot.mass.end());
  const std::string data = data_array("id", id) + data_array("radius", radius) + data_array("mass", mass) +
                           data_array("material", kind) + data_array("velocity", velocity, 3) +
                           data_array("fluctuation", fluctuation, 3) + data_array("angular_velocity", spin, 3) +
                           data_array("contacts", contacts) + data_array("body", body) +
                           data_array("boundary", boundary);
  return poly_data(points, data, "", Cells::of_size("Verts", id.size(), 1));
}

template <int D>
std::string vtp_contacts(const Snapshot<D>& snapshot) {
  const ContactColumns<D>& contacts = *snapshot.contacts;
  const Mat<D> inverse = snapshot.cell->box.inverse();
  std::vector<double> points, force, normal, tangential;
  std::vector<std::int64_t> first, second;
  std::vector<std::uint8_t> touching;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Vec<D> start = wrapped_position<D>(*snapshot.cell, inverse, snapshot.position[contacts.i[c]]);
    append_components<D>(points, start);
    append_components<D>(points, start + contacts.branch[c]);
    append_components<D>(force, contacts.force[c]);
    normal.push_back(contacts.force[c].dot(contacts.normal[c]));
    tangential.push_back((contacts.force[c] - normal.back() * contacts.normal[c]).norm());
    first.push_back(contacts.i[c]), second.push_back(contacts.j[c]);
    touching.push_back(contacts.touches(c) ? 1 : 0);
  }
  std::string data = data_array("force", force, 3) + data_array("normal_force", normal) +
                     data_array("tangential_force", tangential) + data_array("gap", contacts.gap) +
                     data_array("i", first) + data_array("j", second) + data_array("touching", touching);
  if (!contacts.mobilised.empty()) data += data_array("mobilised", contacts.mobilised);
  return poly_data(points, "", data, Cells::of_size("Lines", contacts.size(), 2));
}

template <int D>
std::string vtp_cell(const Snapshot<D>& snapshot) {
  const Mat<D>& box = snapshot.cell->box;
  std::vector<double> points;
  std::vector<std::uint8_t> periodic;
  for (int a = 0; a < D; ++a)
    for (int corner = 0; corner < 1 << D; ++corner) {
      if ((corner >> a & 1) != 0) continue;  // each edge once, from its end at fraction 0
      Vec<D> from = Vec<D>::Zero();
      for (int b = 0; b < D; ++b)
        if ((corner >> b & 1) != 0) from += box.col(b);
      append_components<D>(points, from);
      append_components<D>(points, from + box.col(a));
      periodic.push_back(snapshot.cell->periodic[a] ? 1 : 0);
    }
  return poly_data(points, "", data_array("periodic", periodic), Cells::of_size("Lines", periodic.size(), 2));
}

template <int D>
std::string vtp_walls(const Snapshot<D>& snapshot) {
  const Extent<D> shown = sample_extent<D>(*snapshot.cell, snapshot.position, snapshot.radius);
  Cells cells{D == 2 ? "Lines" : "Polys", {}};
  std::vector<double> points, velocity, normal;
  std::vector<std::int64_t> number;
  for (std::size_t wall = 0; wall < snapshot.planes.size(); ++wall)
    for (const std::vector<Vec<D>>& face : boundary_faces<D>(snapshot.planes[wall], shown)) {
      for (const Vec<D>& corner : face) append_components<D>(points, corner);
      cells.ends.push_back(static_cast<std::int64_t>(points.size() / 3));
      const Plane<D> there = tangent_plane<D>(snapshot.planes[wall], (face[0] + face[1]) / 2);
      append_components<D>(velocity, there.velocity);
      append_components<D>(normal, there.normal);
      number.push_back(snapshot.grains() + static_cast<std::int64_t>(wall));
    }
  return poly_data(points, "",
                   data_array("j", number) + data_array("velocity", velocity, 3) + data_array("normal", normal, 3),
                   cells);
}

std::string pvd(const std::vector<std::pair<double, std::string>>& files) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
      "<Collection>\n";
  for (const auto& [time, file] : files)
    text += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", time, file);
  return text + "</Collection>\n</VTKFile>\n";
}

template std::string vtp_grains<2>(const Snapshot<2>&, const std::vector<int>&);
template std::string vtp_grains<3>(const Snapshot<3>&, const std::vector<int>&);
template std::string vtp_contacts<2>(const Snapshot<2>&);
template std::string vtp_contacts<3>(const Snapshot<3>&);
template std::string vtp_cell<2>(const Snapshot<2>&);
template std::string vtp_cell<3>(const Snapshot<3>&);
template std::string vtp_walls<2>(const Snapshot<2>&);
template std::string vtp_walls<3>(const Snapshot<3>&);

}  // namespace galet
