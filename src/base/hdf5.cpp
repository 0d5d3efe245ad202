#include "base/hdf5.hpp"

#include <cstddef>

namespace lichtmc {

namespace {

std::mutex& library_mutex() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

void check_hdf5(herr_t status, const std::string& what) {
  if (status < 0) throw Hdf5Error("cannot " + what);
}

Hdf5Session::Hdf5Session() : lock_(library_mutex()) {
  H5Eget_auto2(H5E_DEFAULT, &old_report_, &old_data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Hdf5Session::~Hdf5Session() {
  H5Eset_auto2(H5E_DEFAULT, old_report_, old_data_);
}

Hdf5Handle::Hdf5Handle(hid_t id, Closer closer, const std::string& what) : id_(id), closer_(closer) {
  if (id < 0) throw Hdf5Error("cannot " + what);
}

Hdf5Handle hdf5_file_access() {
  Hdf5Handle list(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "set up HDF5");
  check_hdf5(H5Pset_fclose_degree(list, H5F_CLOSE_STRONG), "set up HDF5");
  return list;
}

Hdf5Handle hdf5_text_type(std::size_t length) {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "describe text");
  check_hdf5(H5Tset_size(type, length + 1), "describe text");
  check_hdf5(H5Tset_cset(type, H5T_CSET_UTF8), "describe text");
  return type;
}

Hdf5Handle hdf5_any_text_type() {
  Hdf5Handle type = hdf5_text_type(0);
  check_hdf5(H5Tset_size(type, H5T_VARIABLE), "describe text");
  return type;
}

Hdf5Handle make_hdf5_in_memory(std::uint64_t user_bytes, std::uint64_t about) {
  const Hdf5Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "set up HDF5");
  check_hdf5(H5Pset_userblock(creation, user_bytes), "set up HDF5");
  check_hdf5(H5Pset_obj_track_times(creation, false), "set up HDF5");
  const Hdf5Handle access = hdf5_file_access();
  constexpr std::uint64_t page = 1 << 16;
  constexpr bool on_disk = false;
  check_hdf5(H5Pset_fapl_core(access, (about / page + 1) * page, on_disk), "set up HDF5");
  return {H5Fcreate("memory.h5", H5F_ACC_TRUNC, creation, access), H5Fclose, "make a file"};
}

std::string_view hdf5_image(const Hdf5Handle& file, std::uint64_t user_bytes) {
  check_hdf5(H5Fflush(file, H5F_SCOPE_GLOBAL), "finish the file");
  // Without the user block, and without the reserve after the last byte in use.
  const ssize_t size = H5Fget_file_image(file, nullptr, 0);
  if (size < 0) throw Hdf5Error("cannot finish the file");
  // For a file in memory the handle points to the pointer to its bytes.
  void* handle = nullptr;
  check_hdf5(H5Fget_vfd_handle(file, H5P_DEFAULT, &handle), "finish the file");
  return {*static_cast<const char* const*>(handle) + user_bytes, static_cast<std::size_t>(size)};
}

}  // namespace lichtmc
