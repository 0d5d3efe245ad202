#include "store/hdf5_file.hpp"

#include <array>
#include <system_error>

#include <hdf5.h>

#include "base/hdf5.hpp"

namespace lichtmc {

namespace {

using Handle = Hdf5Handle;

void check(herr_t status, const std::string& what) {
  check_hdf5(status, what);
}

Handle space_of(Shape shape) {
  const std::array<hsize_t, 2> sizes{shape.rows, shape.columns};
  return {H5Screate_simple(shape.columns == 1 ? 1 : 2, sizes.data(), nullptr), H5Sclose, "describe an array"};
}

// Requires a member of the group itself, not a link.
void require_member(hid_t group, const char* name) {
  H5L_info_t info{};
  check(H5Lget_info(group, name, &info, H5P_DEFAULT), std::string("find ") + name);
  if (info.type != H5L_TYPE_HARD) throw Hdf5Error(std::string(name) + " is a link to something elsewhere");
}

}  // namespace

struct Hdf5File::Handles {
  Hdf5Session session;  // ends after the objects below are closed
  Handle file;
  Handle group;
  bool writes = false;
  std::uint64_t user_bytes = 0;
  std::uint64_t file_bytes = 0;  // of a file to read

  void write_attribute(const char* name, hid_t type, const void* value) const {
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose, "describe an attribute");
    const Handle attribute(H5Acreate2(group, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                           "make an attribute");
    check(H5Awrite(attribute, type, value), "write an attribute");
  }
  Handle attribute(const char* name) const {
    Handle found(H5Aopen(group, name, H5P_DEFAULT), H5Aclose, "find an attribute");
    const Handle space(H5Aget_space(found), H5Sclose, "read an attribute");
    if (H5Sget_simple_extent_type(space) != H5S_SCALAR)
      throw Hdf5Error(std::string("attribute ") + name + " is not a scalar");
    return found;
  }
  void read_attribute(const char* name, hid_t type, void* value) const {
    const Handle found = attribute(name);
    const Handle own(H5Aget_type(found), H5Tclose, "read an attribute");
    if (H5Tequal(own, type) <= 0) throw Hdf5Error(std::string("attribute ") + name + " is of another type");
    check(H5Aread(found, type, value), "read an attribute");
  }
  void write_array(const char* name, hid_t type, const void* values, Shape shape) const {
    const Handle space = space_of(shape);
    const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "set up HDF5");
    check(H5Pset_obj_track_times(creation, false), "set up HDF5");
    check(H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER), "set up HDF5");
    const Handle array(H5Dcreate2(group, name, type, space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose,
                       "make an array");
    if (shape.rows > 0) check(H5Dwrite(array, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), "write an array");
  }
  Handle array(const char* name) const {
    require_member(group, name);
    return {H5Dopen2(group, name, H5P_DEFAULT), H5Dclose, "find an array"};
  }
  void read_array(const char* name, hid_t type, void* values, Shape shape) const {
    const Handle found = array(name);
    const Handle own(H5Dget_type(found), H5Tclose, "read an array");
    if (H5Tequal(own, type) <= 0) throw Hdf5Error(std::string("array ") + name + " is of another type");
    if (shape.rows > 0) check(H5Dread(found, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), "read an array");
  }
  // Whether all rows of an array are stored in the file itself, contiguously, as arrays are written.
  bool is_stored(const Handle& array, std::uint64_t rows, std::uint64_t columns) const {
    const Handle creation(H5Dget_create_plist(array), H5Pclose, "read an array");
    if (H5Pget_layout(creation) != H5D_CONTIGUOUS || H5Pget_external_count(creation) != 0) return false;
    if (rows == 0) return true;
    if (rows > file_bytes / (columns * sizeof(std::uint64_t))) return false;
    const std::uint64_t bytes = rows * columns * sizeof(std::uint64_t);
    const haddr_t first = H5Dget_offset(array);
    return H5Dget_storage_size(array) == bytes && first != HADDR_UNDEF && first <= file_bytes - bytes;
  }
};

Hdf5File::Hdf5File() : handles_(std::make_unique<Handles>()) {}
Hdf5File::~Hdf5File() = default;
Hdf5File::Hdf5File(Hdf5File&&) noexcept = default;
Hdf5File& Hdf5File::operator=(Hdf5File&&) noexcept = default;

Hdf5File Hdf5File::in_memory(std::uint64_t user_bytes, std::uint64_t about) {
  Hdf5File made;
  made.handles_->writes = true;
  made.handles_->user_bytes = user_bytes;
  made.handles_->file = make_hdf5_in_memory(user_bytes, about);
  return made;
}

// Without file locks, which network file systems may not support.
Hdf5File::Hdf5File(const std::filesystem::path& file) : Hdf5File() {
  const Handle access = hdf5_file_access();
  check(H5Pset_file_locking(access, false, true), "set up HDF5");
  std::error_code unknown;
  handles_->file_bytes = std::filesystem::file_size(file, unknown);
  if (unknown) throw Hdf5Error("cannot open the file");
  handles_->file = Handle(H5Fopen(file.c_str(), H5F_ACC_RDONLY, access), H5Fclose, "open the file");
}

Hdf5File Hdf5File::of_bytes(std::string_view bytes) {
  Hdf5File made;
  const Handle access = hdf5_file_access();
  constexpr std::size_t growth = 1 << 16;  // never needed: the file is only read
  constexpr bool on_disk = false;
  check(H5Pset_fapl_core(access, growth, on_disk), "set up HDF5");
  // HDF5 takes the bytes by a pointer to variable ones, and copies them.
  check(H5Pset_file_image(access, const_cast<char*>(bytes.data()), bytes.size()), "set up HDF5");
  made.handles_->file_bytes = bytes.size();
  made.handles_->file = Handle(H5Fopen("memory.h5", H5F_ACC_RDONLY, access), H5Fclose, "open the file");
  return made;
}

std::string_view Hdf5File::image() {
  Handles& h = *handles_;
  h.group.close();
  return hdf5_image(h.file, h.user_bytes);
}

void Hdf5File::enter(const std::string& group) {
  Handles& h = *handles_;
  if (!h.writes || group == "/") {
    if (group != "/") require_member(h.file, group.c_str());
    h.group = Handle(H5Gopen2(h.file, group.c_str(), H5P_DEFAULT), H5Gclose, "find a group");
    return;
  }
  const Handle creation(H5Pcreate(H5P_GROUP_CREATE), H5Pclose, "set up HDF5");
  check(H5Pset_obj_track_times(creation, false), "set up HDF5");
  h.group = Handle(H5Gcreate2(h.file, group.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT), H5Gclose, "make a group");
}

bool Hdf5File::has_group(const std::string& group) const {
  const htri_t exists = H5Lexists(handles_->file, group.c_str(), H5P_DEFAULT);
  if (exists < 0) throw Hdf5Error("cannot search for a group");
  return exists > 0;
}

std::uint64_t Hdf5File::members() const {
  H5G_info_t info{};
  check(H5Gget_info(handles_->file, &info), "list the groups");
  return info.nlinks;
}

void Hdf5File::write(const char* attribute, std::uint64_t value) {
  handles_->write_attribute(attribute, H5T_NATIVE_UINT64, &value);
}
void Hdf5File::write(const char* attribute, double value) {
  handles_->write_attribute(attribute, H5T_NATIVE_DOUBLE, &value);
}
void Hdf5File::write(const char* attribute, const std::string& text) {
  const Handle type = hdf5_text_type(text.size());
  handles_->write_attribute(attribute, type, text.c_str());
}
void Hdf5File::write(const char* array, const std::uint64_t* values, Shape shape) {
  handles_->write_array(array, H5T_NATIVE_UINT64, values, shape);
}
void Hdf5File::write(const char* array, const double* values, Shape shape) {
  handles_->write_array(array, H5T_NATIVE_DOUBLE, values, shape);
}

void Hdf5File::read(const char* attribute, std::uint64_t& value) {
  handles_->read_attribute(attribute, H5T_NATIVE_UINT64, &value);
}
void Hdf5File::read(const char* attribute, double& value) {
  handles_->read_attribute(attribute, H5T_NATIVE_DOUBLE, &value);
}
void Hdf5File::read(const char* attribute, std::string& text) {
  const Handle found = handles_->attribute(attribute);
  const Handle type(H5Aget_type(found), H5Tclose, "read text");
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0)
    throw Hdf5Error(std::string("attribute ") + attribute + " is not text of fixed length");
  const std::size_t size = H5Tget_size(type);
  if (size > handles_->file_bytes) throw Hdf5Error(std::string("attribute ") + attribute + " is longer than the file");
  text.assign(size, '\0');
  check(H5Aread(found, type, text.data()), "read text");
  text.resize(text.find_first_of('\0') == std::string::npos ? text.size() : text.find_first_of('\0'));
}

std::uint64_t Hdf5File::rows(const char* array, std::uint64_t columns) const {
  const Handle found = handles_->array(array);
  const Handle space(H5Dget_space(found), H5Sclose, "read an array");
  std::array<hsize_t, 2> sizes{0, 1};
  const int wanted = columns == 1 ? 1 : 2;
  if (H5Sget_simple_extent_ndims(space) != wanted || H5Sget_simple_extent_dims(space, sizes.data(), nullptr) < 0 ||
      (columns != 1 && sizes[1] != columns))
    throw Hdf5Error(std::string("array ") + array + " has another shape");
  if (!handles_->is_stored(found, sizes[0], columns))
    throw Hdf5Error(std::string("array ") + array + " has " + std::to_string(sizes[0]) +
                    " rows, which are not stored in the file as required");
  return sizes[0];
}

void Hdf5File::read(const char* array, std::uint64_t* values, Shape shape) {
  handles_->read_array(array, H5T_NATIVE_UINT64, values, shape);
}
void Hdf5File::read(const char* array, double* values, Shape shape) {
  handles_->read_array(array, H5T_NATIVE_DOUBLE, values, shape);
}

}  // namespace lichtmc
