// Form of a checkpoint file: an HDF5 file with a user block of 512 bytes in front (HDF5 tools skip it),
//
//   user block   text: name of the format, its version, length of the file, FNV-1a hash of all that follows the block
//   /reals       one dataset of 64-bit floats per column      root attributes: version, state_hash
//   /integers    one dataset of 64-bit integers per column
//   /texts       one string per text
//
// A column's name with '/' in it becomes groups. The user block is checked before HDF5 sees the file, because the
// library may not survive a damaged one. The file is made in memory (it costs twice the size of the archive) and
// written by write_file, which reports a full disk with the system's reason and never leaves half a file.
#include "common/io/checkpoint.hpp"

#include <array>
#include <cstring>
#include <sstream>
#include <string_view>

#include <fmt/format.h>

#include "common/core/error.hpp"
#include "common/io/files.hpp"
#include "common/io/hdf5.hpp"

namespace galet {

namespace {

using hdf5::checked;
using hdf5::Handle;
using hdf5::Properties;
using hdf5::simple_space;

constexpr std::size_t block_size = 512;  // the least that HDF5 allows
constexpr std::string_view format_name = "galet checkpoint";
constexpr std::string_view hdf5_signature = "\x89HDF\r\n\x1a\n";

std::uint64_t hash_bytes(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (unsigned char byte : bytes) hash = (hash ^ byte) * 0x100000001b3ULL;
  return hash;
}

/// The user block of a file of the current version. `content` is all that follows the block.
std::string user_block(std::string_view content) {
  std::string block = fmt::format("{}\nversion {}\nbytes {}\nhash {:016x}\n", format_name, checkpoint_version,
                                  block_size + content.size(), hash_bytes(content));
  block.resize(block_size, '\0');
  return block;
}

/// A name that HDF5 would read differently (as a path) must not become a column that comes back under another name.
void check_name(const std::string& name) {
  std::istringstream parts(name + '/');
  for (std::string part; std::getline(parts, part, '/');)
    require(!part.empty() && part != "." && part.find('\0') == std::string::npos,
            "checkpoint column '" + name + "': a name is one or more non-empty words joined by '/'");
}

Handle text_type(std::size_t size) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "making a text type");
  checked(H5Tset_size(type, size), "sizing a text type");
  checked(H5Tset_strpad(type, H5T_STR_NULLPAD), "padding a text type");
  checked(H5Tset_cset(type, H5T_CSET_UTF8), "setting the encoding of a text type");
  return type;
}

void write_dataset(hid_t group, const Properties& properties, const std::string& name, hid_t stored, hid_t memory,
                   const Handle& space, const void* data) {
  check_name(name);
  const Handle dataset(H5Dcreate2(group, name.c_str(), stored, space, properties.link, properties.dataset, H5P_DEFAULT),
                       H5Dclose, "making column '" + name + "'");
  if (checked(H5Sget_simple_extent_npoints(space), "sizing column '" + name + "'") > 0)
    checked(H5Dwrite(dataset, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), "storing column '" + name + "'");
}

Handle make_group(hid_t file, const char* name) {
  return {H5Gcreate2(file, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, "making a group"};
}

template <class Number>
void write_attribute(hid_t object, const char* name, hid_t stored, hid_t memory, Number value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, "making a data space");
  const Handle attribute(H5Acreate2(object, name, stored, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                         "making an attribute");
  checked(H5Awrite(attribute, memory, &value), "storing an attribute");
}

void fill_file(hid_t file, const Archive& archive) {
  const Properties properties;
  write_attribute(file, "version", H5T_STD_I64LE, H5T_NATIVE_INT64, static_cast<std::int64_t>(checkpoint_version));
  write_attribute(file, "state_hash", H5T_STD_U64LE, H5T_NATIVE_UINT64, state_hash(archive));
  const Handle reals = make_group(file, "reals");
  for (const auto& [name, values] : archive.reals)
    write_dataset(reals, properties, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, simple_space(values.size()),
                  values.data());
  const Handle integers = make_group(file, "integers");
  for (const auto& [name, values] : archive.integers)
    write_dataset(integers, properties, name, H5T_STD_I64LE, H5T_NATIVE_INT64, simple_space(values.size()),
                  values.data());
  const Handle texts = make_group(file, "texts");
  for (const auto& [name, text] : archive.texts) {
    const Handle type = text_type(std::max<std::size_t>(text.size(), 1));  // HDF5 has no type for an empty text,
    const Handle space(H5Screate(text.empty() ? H5S_NULL : H5S_SCALAR), H5Sclose, "making a data space");  // but this
    write_dataset(texts, properties, name, type, type, space, text.data());
  }
}

/// The bytes, after the user block, of the HDF5 file that holds `archive`.
std::string file_image(const Archive& archive) {
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "making file properties");
  checked(H5Pset_userblock(creation, block_size), "reserving the user block");
  return hdf5::file_image(creation, [&](hid_t file) { fill_file(file, archive); });
}

[[noreturn]] void refuse(const std::string& path, const std::string& message) {
  throw InputError({Mistake{path, 0, 0, message}});
}

/// Refuses every file that is not, byte for byte, what write_checkpoint wrote in this version.
void check_bytes(const std::string& path, std::string_view bytes) {
  const auto is_hdf5 = [&](std::size_t offset) {
    return bytes.size() > offset && bytes.substr(offset).starts_with(hdf5_signature);
  };
  if (!bytes.starts_with(format_name)) {
    if (is_hdf5(0) || is_hdf5(block_size)) refuse(path, "this HDF5 file is not a galet checkpoint");
    refuse(path, "this is not an HDF5 file, let alone a galet checkpoint");
  }
  std::istringstream head{std::string(bytes.substr(0, std::min(bytes.size(), block_size)))};
  std::string line, word;
  int version = 0;
  std::size_t size = 0;
  std::getline(head, line);
  if (!(head >> word >> version) || word != "version")
    refuse(path, "the checkpoint is damaged or truncated: its head can't be read");
  if (version != checkpoint_version)
    refuse(path, fmt::format("the checkpoint has version {} of the format; this program reads version {}", version,
                             checkpoint_version));
  if (!(head >> word >> size) || word != "bytes")
    refuse(path, "the checkpoint is damaged or truncated: its head can't be read");
  if (bytes.size() < size)
    refuse(path, fmt::format("the checkpoint is truncated: it has {} bytes of {}", bytes.size(), size));
  if (bytes.size() > size || size < block_size)
    refuse(path, fmt::format("the checkpoint is damaged: it has {} bytes instead of {}", bytes.size(), size));
  if (bytes.substr(0, block_size) != user_block(bytes.substr(block_size)))
    refuse(path, "the checkpoint is damaged: its hash does not match its content");
}

/// Paths of all datasets below `group`, relative to it.
std::vector<std::string> dataset_names(hid_t group) {
  std::vector<std::string> names;
  const auto collect = [](hid_t from, const char* name, const H5L_info_t*, void* data) -> herr_t {
    const hid_t object = H5Oopen(from, name, H5P_DEFAULT);
    if (object < 0) return -1;
    if (H5Iget_type(object) == H5I_DATASET) static_cast<std::vector<std::string>*>(data)->emplace_back(name);
    return H5Oclose(object);
  };
  checked(H5Lvisit(group, H5_INDEX_NAME, H5_ITER_INC, collect, &names), "listing the columns");
  return names;
}

template <class Value>
std::vector<Value> read_column(hid_t group, const std::string& name, hid_t stored, hid_t memory) {
  const Handle dataset(H5Dopen2(group, name.c_str(), H5P_DEFAULT), H5Dclose, "opening column '" + name + "'");
  const Handle type(H5Dget_type(dataset), H5Tclose, "reading the type of column '" + name + "'");
  if (checked(H5Tequal(type, stored), "comparing types") == 0)
    throw hdf5::Failure("column '" + name + "' has another type than it should");
  const Handle space(H5Dget_space(dataset), H5Sclose, "sizing column '" + name + "'");
  std::vector<Value> values(
      static_cast<std::size_t>(checked(H5Sget_simple_extent_npoints(space), "sizing column '" + name + "'")));
  if (!values.empty())
    checked(H5Dread(dataset, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "reading column '" + name + "'");
  return values;
}

std::string read_text(hid_t group, const std::string& name) {
  const Handle dataset(H5Dopen2(group, name.c_str(), H5P_DEFAULT), H5Dclose, "opening text '" + name + "'");
  const Handle space(H5Dget_space(dataset), H5Sclose, "sizing text '" + name + "'");
  if (H5Sget_simple_extent_type(space) == H5S_NULL) return {};
  const Handle type(H5Dget_type(dataset), H5Tclose, "reading the type of text '" + name + "'");
  if (H5Tget_class(type) != H5T_STRING || checked(H5Tis_variable_str(type), "reading a text type") > 0)
    throw hdf5::Failure("text '" + name + "' has another type than it should");
  std::string text(H5Tget_size(type), '\0');
  checked(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()), "reading text '" + name + "'");
  return text;
}

template <class Number>
Number read_attribute(hid_t object, const char* name, hid_t memory) {
  const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose, std::string("opening attribute ") + name);
  Number value{};
  checked(H5Aread(attribute, memory, &value), std::string("reading attribute ") + name);
  return value;
}

/// Reads a file whose bytes have been checked.
Archive read_columns(const std::string& path) {
  const Handle file = hdf5::open_to_read(path);
  Archive archive;
  const Handle reals(H5Gopen2(file, "reals", H5P_DEFAULT), H5Gclose, "opening the real columns");
  for (const std::string& name : dataset_names(reals))
    archive.reals[name] = read_column<double>(reals, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE);
  const Handle integers(H5Gopen2(file, "integers", H5P_DEFAULT), H5Gclose, "opening the integer columns");
  for (const std::string& name : dataset_names(integers))
    archive.integers[name] = read_column<std::int64_t>(integers, name, H5T_STD_I64LE, H5T_NATIVE_INT64);
  const Handle texts(H5Gopen2(file, "texts", H5P_DEFAULT), H5Gclose, "opening the texts");
  for (const std::string& name : dataset_names(texts)) archive.texts[name] = read_text(texts, name);
  if (read_attribute<std::uint64_t>(file, "state_hash", H5T_NATIVE_UINT64) != state_hash(archive))
    throw hdf5::Failure("the hash of the columns differs from the stored one");
  return archive;
}

}  // namespace

void write_checkpoint(const std::string& path, const Archive& archive) {
  const hdf5::Silence silence;
  std::string image;
  try {
    image = file_image(archive);
  } catch (const hdf5::Failure& failure) {
    throw RunError(fmt::format("can't write '{}': {}", path, failure.what()));
  }
  image.insert(0, user_block(image));
  write_file(path, image);
}

Archive read_checkpoint(const std::string& path) {
  const hdf5::Silence silence;
  check_bytes(path, read_file(path));
  try {
    return read_columns(path);
  } catch (const hdf5::Failure& failure) {
    refuse(path, std::string("the checkpoint is damaged: ") + failure.what());
  }
}

}  // namespace galet
