#include "common/io/hdf5_states.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

#include <fmt/format.h>

#include "common/core/error.hpp"
#include "common/geometry/wrap.hpp"
#include "common/io/hdf5.hpp"

namespace galet {

namespace {

using hdf5::checked;
using hdf5::Handle;

template <class Number>
hid_t stored_type() {
  if constexpr (std::is_same_v<Number, double>) return H5T_IEEE_F64LE;
  if constexpr (std::is_same_v<Number, std::int64_t>) return H5T_STD_I64LE;
  if constexpr (std::is_same_v<Number, std::uint8_t>) return H5T_STD_U8LE;
}

template <class Number>
hid_t memory_type() {
  if constexpr (std::is_same_v<Number, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<Number, std::int64_t>) return H5T_NATIVE_INT64;
  if constexpr (std::is_same_v<Number, std::uint8_t>) return H5T_NATIVE_UINT8;
}

void put_attribute(hid_t object, const char* name, const std::string& text) {
  if (text.empty()) return;
  // Of variable length: h5py then hands out text, and not bytes.
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "making a text type");
  checked(H5Tset_size(type, H5T_VARIABLE), "sizing a text type");
  checked(H5Tset_cset(type, H5T_CSET_UTF8), "setting the encoding of a text type");
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, "making a data space");
  const Handle attribute(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                         "making an attribute");
  const char* letters = text.c_str();
  checked(H5Awrite(attribute, type, &letters), "storing an attribute");
}

template <class Number>
void put_attribute(hid_t object, const char* name, Number value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, "making a data space");
  const Handle attribute(H5Acreate2(object, name, stored_type<Number>(), space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                         "making an attribute");
  checked(H5Awrite(attribute, memory_type<Number>(), &value), "storing an attribute");
}

/// Writes datasets into a file; the groups on their way are made.
class Writer {
 public:
  Writer(hid_t file, bool si) : file_(file), si_(si) {}

  /// `width`: numbers per row; 0 for one number per row without a second dimension.
  template <class Number>
  void put(const std::string& name, const std::vector<Number>& values, std::size_t width, const std::string& unit,
           const std::string& meaning = "") const {
    const std::array<hsize_t, 2> extent = {values.size() / std::max<std::size_t>(width, 1), width};
    const Handle space(H5Screate_simple(width == 0 ? 1 : 2, extent.data(), nullptr), H5Sclose, "making a data space");
    const Handle dataset(H5Dcreate2(file_, name.c_str(), stored_type<Number>(), space, properties_.link,
                                    properties_.dataset, H5P_DEFAULT),
                         H5Dclose, "making '" + name + "'");
    if (!values.empty())
      checked(H5Dwrite(dataset, memory_type<Number>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
              "storing '" + name + "'");
    if (si_) put_attribute(dataset, "unit", unit);
    put_attribute(dataset, "meaning", meaning);
  }

 private:
  hid_t file_;
  bool si_;
  hdf5::Properties properties_;
};

template <int D, class Vectors>
std::vector<double> flat(const Vectors& vectors) {
  std::vector<double> numbers;
  numbers.reserve(D * vectors.size());
  for (const auto& vector : vectors) numbers.insert(numbers.end(), vector.data(), vector.data() + D);
  return numbers;
}

template <int D>
std::vector<double> by_rows(const Mat<D>& matrix) {
  std::vector<double> numbers;
  for (int a = 0; a < D; ++a)
    for (int b = 0; b < D; ++b) numbers.push_back(matrix(a, b));
  return numbers;
}

template <int D>
void put_cell(const Writer& writer, const Cell<D>& cell) {
  writer.put("cell/box", by_rows<D>(cell.box), D, "m");
  writer.put("cell/rate", by_rows<D>(cell.rate), D, "1/s");
  writer.put("cell/strain", by_rows<D>(cell.strain), D, "");
  writer.put("cell/periodic", std::vector<std::uint8_t>(cell.periodic.begin(), cell.periodic.end()), 0, "");
}

template <int D>
void put_spins(const Writer& writer, const std::string& name, std::span<const Spin<D>> spins) {
  if constexpr (D == 2)
    writer.put(name, std::vector<double>(spins.begin(), spins.end()), 0, "1/s");
  else
    writer.put(name, flat<3>(spins), 3, "1/s");
}

template <int D>
void put_grains(const Writer& writer, const Snapshot<D>& snapshot, const std::vector<int>& material) {
  const Cell<D>& cell = *snapshot.cell;
  const Mat<D> inverse = cell.box.inverse();
  std::vector<Vec<D>> position, velocity;
  for (int i = 0; i < snapshot.grains(); ++i) {
    position.push_back(wrapped_position<D>(cell, inverse, snapshot.position[i]));
    velocity.push_back(snapshot.velocity[i] + cell.rate * position.back());
  }
  writer.put("grains/position", flat<D>(position), D, "m");
  writer.put("grains/velocity", flat<D>(velocity), D, "m/s");
  writer.put("grains/fluctuation", flat<D>(snapshot.velocity), D, "m/s");
  if (!snapshot.spin.empty()) put_spins<D>(writer, "grains/angular_velocity", snapshot.spin);
  writer.put("grains/radius", std::vector<double>(snapshot.radius.begin(), snapshot.radius.end()), 0, "m");
  writer.put("grains/mass", std::vector<double>(snapshot.mass.begin(), snapshot.mass.end()), 0, "kg");
  std::vector<std::int64_t> kinds(static_cast<std::size_t>(snapshot.grains()), 0);
  for (std::size_t i = 0; i < material.size() && i < kinds.size(); ++i) kinds[i] = material[i];
  writer.put("grains/material", kinds, 0, "");
  if (!snapshot.body_of.empty())
    writer.put("grains/body", std::vector<std::int64_t>(snapshot.body_of.begin(), snapshot.body_of.end()), 0, "",
               "the grain's rigid body, -1: none");
}

template <int D>
void put_contacts(const Writer& writer, const ContactColumns<D>& contacts) {
  writer.put("contacts/i", std::vector<std::int64_t>(contacts.i.begin(), contacts.i.end()), 0, "");
  writer.put("contacts/j", std::vector<std::int64_t>(contacts.j.begin(), contacts.j.end()), 0, "");
  writer.put("contacts/normal", flat<D>(contacts.normal), D, "");
  writer.put("contacts/branch", flat<D>(contacts.branch), D, "m");
  writer.put("contacts/gap", contacts.gap, 0, "m");
  writer.put("contacts/force", flat<D>(contacts.force), D, "N");
  std::vector<std::uint8_t> touching;
  for (std::size_t c = 0; c < contacts.size(); ++c) touching.push_back(contacts.touches(c) ? 1 : 0);
  writer.put("contacts/touching", touching, 0, "");
  if (!contacts.mobilised.empty()) writer.put("contacts/mobilised", contacts.mobilised, 0, "");
}

template <int D>
void put_planes(const Writer& writer, std::span<const Plane<D>> planes) {
  std::vector<Vec<D>> point, normal, velocity, axis;
  std::vector<double> radius;
  std::vector<std::uint8_t> inside;
  std::vector<Spin<D>> spin;
  for (const Plane<D>& plane : planes) {
    point.push_back(plane.point), normal.push_back(plane.normal), velocity.push_back(plane.velocity);
    radius.push_back(plane.radius), inside.push_back(plane.curved() && plane.inside ? 1 : 0);
    axis.push_back(plane.axis), spin.push_back(plane.spin);
  }
  writer.put("planes/point", flat<D>(point), D, "m");
  writer.put("planes/normal", flat<D>(normal), D, "");
  writer.put("planes/velocity", flat<D>(velocity), D, "m/s");
  writer.put("planes/radius", radius, 0, "m", "of a cylinder; 0: a plane");
  writer.put("planes/inside", inside, 0, "", "1: a cylinder that has the grains inside");
  put_spins<D>(writer, "planes/angular_velocity", spin);
  if (D == 3) writer.put("planes/axis", flat<D>(axis), D, "");
}

Handle file_properties() { return {H5Pcreate(H5P_FILE_CREATE), H5Pclose, "making file properties"}; }

}  // namespace

template <int D>
std::string hdf5_state(const Snapshot<D>& snapshot, const StateLabels& labels) {
  const hdf5::Silence silence;
  return hdf5::file_image(file_properties(), [&](hid_t file) {
    put_attribute(file, "format", std::string("galet state"));
    put_attribute(file, "version", std::int64_t{1});
    put_attribute(file, "dimension", std::int64_t{D});
    put_attribute(file, "engine", std::string(snapshot.engine));
    put_attribute(file, "time", snapshot.time);
    put_attribute(file, "step", static_cast<std::int64_t>(labels.step));
    const Writer writer(file, labels.si);
    put_cell<D>(writer, *snapshot.cell);
    put_grains<D>(writer, snapshot, labels.material);
    put_contacts<D>(writer, *snapshot.contacts);
    put_planes<D>(writer, snapshot.planes);
  });
}

std::string hdf5_trajectory(const std::vector<double>& times, const std::vector<long>& steps,
                            const std::vector<std::string>& files) {
  require(times.size() == files.size() && steps.size() == files.size(),
          "a trajectory needs a time and a step for each file");
  const hdf5::Silence silence;
  return hdf5::file_image(file_properties(), [&](hid_t file) {
    put_attribute(file, "format", std::string("galet trajectory"));
    put_attribute(file, "version", std::int64_t{1});
    const Writer writer(file, false);
    writer.put("time", times, 0, "");
    writer.put("step", std::vector<std::int64_t>(steps.begin(), steps.end()), 0, "");
    const Handle frames(H5Gcreate2(file, "frames", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, "making a group");
    for (std::size_t k = 0; k < files.size(); ++k)
      checked(
          H5Lcreate_external(files[k].c_str(), "/", frames, fmt::format("{:06}", k).c_str(), H5P_DEFAULT, H5P_DEFAULT),
          "making a link");
  });
}

namespace {

double number_in(const CsvCell& cell) {
  if (const double* real = std::get_if<double>(&cell)) return *real;
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) return static_cast<double>(*whole);
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

std::string hdf5_table(const CsvTable& table) {
  const hdf5::Silence silence;
  return hdf5::file_image(file_properties(), [&](hid_t file) {
    std::string rest;
    std::vector<std::string> meanings(table.columns.size());
    for (const std::string& comment : table.comments) {
      bool of_column = false;
      for (std::size_t k = 0; k < table.columns.size(); ++k)
        if (comment.starts_with(table.columns[k].name + ": "))
          meanings[k] = comment.substr(table.columns[k].name.size() + 2), of_column = true;
      if (!of_column) rest += comment + "\n";
    }
    put_attribute(file, "format", std::string("galet table"));
    put_attribute(file, "comments", rest);
    const Writer writer(file, true);  // a column without a unit gets no attribute
    for (std::size_t k = 0; k < table.columns.size(); ++k) {
      std::vector<double> values;
      for (const std::vector<CsvCell>& row : table.rows) values.push_back(number_in(row[k]));
      writer.put(table.columns[k].name, values, 0, table.columns[k].unit, meanings[k]);
    }
  });
}

template std::string hdf5_state<2>(const Snapshot<2>&, const StateLabels&);
template std::string hdf5_state<3>(const Snapshot<3>&, const StateLabels&);

}  // namespace galet
