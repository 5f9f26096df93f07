#include "common/io/hdf5_tree.hpp"

#include <limits>

#include <fmt/format.h>

#include "common/core/error.hpp"
#include "common/io/files.hpp"
#include "common/io/hdf5.hpp"

namespace galet {

namespace {

using hdf5::checked;
using hdf5::Handle;

/// What a walk through a file carries along.
struct Reading {
  Archive& archive;
  std::string group;
  std::size_t file_size;
};

/// Number of values of a dataset. An array that is stored plainly must have its bytes in the file: a damaged size
/// would else be memory that nobody has.
std::size_t value_count(hid_t dataset, hid_t type, const Reading& reading, const std::string& name) {
  const Handle space(H5Dget_space(dataset), H5Sclose, "sizing '" + name + "'");
  const hssize_t count = checked(H5Sget_simple_extent_npoints(space), "sizing '" + name + "'");
  const Handle creation(H5Dget_create_plist(dataset), H5Pclose, "reading the properties of '" + name + "'");
  const std::size_t limit = H5Pget_layout(creation) == H5D_CHUNKED ? std::numeric_limits<std::int32_t>::max()
                                                                   : reading.file_size / H5Tget_size(type);
  if (static_cast<std::size_t>(count) > limit)
    throw hdf5::Failure(fmt::format("'{}' claims {} values, more than the file can hold", name, count));
  return static_cast<std::size_t>(count);
}

template <class Value>
void read_numbers(hid_t dataset, hid_t type, hid_t memory, const Reading& reading, const std::string& name,
                  std::vector<Value>& values) {
  values.resize(value_count(dataset, type, reading, name));
  if (!values.empty())
    checked(H5Dread(dataset, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "reading '" + name + "'");
}

std::string read_text(hid_t dataset, hid_t type, const Reading& reading, const std::string& name) {
  const std::size_t count = value_count(dataset, type, reading, name);
  if (count != 1) return {};
  if (checked(H5Tis_variable_str(type), "reading the type of '" + name + "'") > 0) {
    const Handle space(H5Dget_space(dataset), H5Sclose, "sizing '" + name + "'");
    char* text = nullptr;
    checked(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, &text), "reading '" + name + "'");
    const std::string copy = text == nullptr ? "" : text;
    H5Dvlen_reclaim(type, space, H5P_DEFAULT, &text);
    return copy;
  }
  std::string text(H5Tget_size(type), '\0');
  checked(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()), "reading '" + name + "'");
  return text.substr(0, text.find('\0'));
}

void read_dataset(hid_t dataset, const std::string& name, const Reading& reading) {
  const Handle type(H5Dget_type(dataset), H5Tclose, "reading the type of '" + name + "'");
  switch (H5Tget_class(type)) {
    case H5T_INTEGER:
      return read_numbers(dataset, type, H5T_NATIVE_INT64, reading, name, reading.archive.integers[name]);
    case H5T_FLOAT:
      return read_numbers(dataset, type, H5T_NATIVE_DOUBLE, reading, name, reading.archive.reals[name]);
    case H5T_STRING:
      reading.archive.texts[name] = read_text(dataset, type, reading, name);
      return;
    default:
      return;
  }
}

/// Called by the C library for each link: no exception may pass through it.
herr_t visit(hid_t group, const char* name, const H5L_info_t* link, void* data) noexcept {
  auto& [names, failure] = *static_cast<std::pair<std::vector<std::string>, std::string>*>(data);
  try {
    if (link->type != H5L_TYPE_HARD) return 0;
    const Handle object(H5Oopen(group, name, H5P_DEFAULT), H5Oclose, fmt::format("opening '{}'", name));
    if (H5Iget_type(object) == H5I_DATASET) names.emplace_back(name);
    return 0;
  } catch (const std::exception& error) {
    failure = error.what();
    return -1;
  }
}

void read_group(hid_t file, const Reading& reading) {
  const Handle group(H5Gopen2(file, reading.group.c_str(), H5P_DEFAULT), H5Gclose, "opening '" + reading.group + "'");
  std::pair<std::vector<std::string>, std::string> found;
  const herr_t status = H5Lvisit(group, H5_INDEX_NAME, H5_ITER_INC, visit, &found);
  if (!found.second.empty()) throw hdf5::Failure(found.second);
  checked(status, "listing '" + reading.group + "'");
  for (const std::string& name : found.first) {
    const Handle dataset(H5Dopen2(group, name.c_str(), H5P_DEFAULT), H5Dclose, "opening '" + name + "'");
    read_dataset(dataset, reading.group + "/" + name, reading);
  }
}

void write_column(hid_t file, const hdf5::Properties& properties, const std::string& name, hid_t stored, hid_t memory,
                  const Handle& space, const void* data) {
  const Handle dataset(H5Dcreate2(file, name.c_str(), stored, space, properties.link, properties.dataset, H5P_DEFAULT),
                       H5Dclose, "making '" + name + "'");
  if (checked(H5Sget_simple_extent_npoints(space), "sizing '" + name + "'") > 0)
    checked(H5Dwrite(dataset, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), "storing '" + name + "'");
}

void fill_tree(hid_t file, const Archive& archive) {
  const hdf5::Properties properties;
  for (const auto& [name, values] : archive.reals)
    write_column(file, properties, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, hdf5::simple_space(values.size()),
                 values.data());
  for (const auto& [name, values] : archive.integers) {
    for (const std::int64_t value : values)
      require(value == static_cast<std::int32_t>(value), "an integer of '" + name + "' has more than 32 bits");
    write_column(file, properties, name, H5T_STD_I32LE, H5T_NATIVE_INT64, hdf5::simple_space(values.size()),
                 values.data());
  }
  for (const auto& [name, text] : archive.texts) {
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "making a text type");
    checked(H5Tset_size(type, text.size() + 1), "sizing a text type");
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose, "making a data space");
    write_column(file, properties, name, type, type, space, text.c_str());
  }
}

}  // namespace

Archive read_hdf5(const std::string& path, const std::vector<std::string>& groups) {
  const hdf5::Silence silence;
  const std::string bytes = read_file(path);  // says why, when the system can't
  const auto refuse = [&](const std::string& message) { throw InputError({Mistake{path, 0, 0, message}}); };
  if (H5Fis_hdf5(path.c_str()) <= 0) refuse("this is not an HDF5 file");
  Archive archive;
  try {
    const Handle file = hdf5::open_to_read(path);
    for (const std::string& group : groups)
      if (checked(H5Lexists(file, group.c_str(), H5P_DEFAULT), "looking for '" + group + "'") > 0)
        read_group(file, {archive, group, bytes.size()});
  } catch (const hdf5::Failure& failure) {
    refuse(std::string("the HDF5 file can't be read: ") + failure.what());
  }
  return archive;
}

void write_hdf5(const std::string& path, const Archive& archive) {
  const hdf5::Silence silence;
  std::string image;
  try {
    const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "making file properties");
    image = hdf5::file_image(creation, [&](hid_t file) { fill_tree(file, archive); });
  } catch (const hdf5::Failure& failure) {
    throw RunError(fmt::format("can't write '{}': {}", path, failure.what()));
  }
  write_file(path, image);
}

}  // namespace galet
