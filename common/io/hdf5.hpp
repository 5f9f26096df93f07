// A thin layer over the HDF5 C library: identifiers that close themselves, errors as exceptions, and silence on
// stderr (HDF5 prints its error stack by default). Included by .cpp files only.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include <hdf5.h>

namespace galet::hdf5 {

/// A call of the library failed. The message says what was tried and what the library gave as the reason.
class Failure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Stops the library from printing, for as long as the object lives; the caller's own setting comes back then.
class Silence {
 public:
  Silence() {
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Silence() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

/// The innermost entry of the library's error stack, where the trouble began.
inline std::string reason() {
  std::string text = "unknown reason";
  const auto take_innermost = [](unsigned depth, const H5E_error2_t* error, void* data) -> herr_t {
    if (depth == 0 && error->desc != nullptr) *static_cast<std::string*>(data) = error->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take_innermost, &text);
  return text;
}

/// Passes a result of the library on, or throws when it means failure (any negative value does).
template <class Result>
Result checked(Result result, const std::string& action) {
  if (result < 0) throw Failure(action + ": " + reason());
  return result;
}

/// An identifier that the library gave, and the function that closes its kind.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close close, const std::string& action) : id_(checked(id, action)), close_(close) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Handle& operator=(Handle&&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  Close close_;
};

inline Handle simple_space(std::size_t count) {
  const hsize_t extent = count;
  return {H5Screate_simple(1, &extent, nullptr), H5Sclose, "making a data space"};
}

/// Creation properties of datasets and of the groups on their way: no time stamps, so that equal contents give equal
/// files.
struct Properties {
  Handle link{H5Pcreate(H5P_LINK_CREATE), H5Pclose, "making link properties"};
  Handle dataset{H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "making dataset properties"};
  Properties() {
    checked(H5Pset_create_intermediate_group(link, 1), "setting link properties");
    checked(H5Pset_obj_track_times(dataset, false), "setting dataset properties");
  }
};

/// The bytes of a file that is made in memory; `fill` writes into it. `creation`: properties of the file.
template <class Fill>
std::string file_image(hid_t creation, const Fill& fill) {
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "making file properties");
  checked(H5Pset_fapl_core(access, std::size_t{1} << 20, false), "keeping the file in memory");
  const Handle file(H5Fcreate("file in memory", H5F_ACC_TRUNC, creation, access), H5Fclose, "making the file");
  fill(file);
  checked(H5Fflush(file, H5F_SCOPE_GLOBAL), "completing the file");
  const ssize_t size = checked(H5Fget_file_image(file, nullptr, 0), "sizing the file");
  std::string image(static_cast<std::size_t>(size), '\0');
  checked(H5Fget_file_image(file, image.data(), image.size()), "copying the file");
  return image;
}

/// A file that is only read. Without locks: not every file system has them.
inline Handle open_to_read(const std::string& path) {
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "making file properties");
  checked(H5Pset_file_locking(access, false, true), "turning locks off");
  return {H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), H5Fclose, "opening the file"};
}

}  // namespace galet::hdf5
