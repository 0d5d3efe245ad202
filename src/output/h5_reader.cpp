#include "output/h5_reader.hpp"

#include <hdf5.h>

namespace lichtmc {

namespace {

// Limit for untrusted input: 1 GB of numbers, some million names.
constexpr std::size_t most_values = std::size_t{1} << 27;

std::size_t values_of(const Hdf5Handle& set) {
  const Hdf5Handle space(H5Dget_space(set), H5Sclose, "read an array");
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  if (count < 0 || static_cast<std::size_t>(count) > most_values) throw Hdf5Error("an array is too large");
  return static_cast<std::size_t>(count);
}

void require_text(hid_t type, const std::string& name) {
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) <= 0) throw Hdf5Error(name + " is not text");
}

}  // namespace

H5Reader::H5Reader(const std::filesystem::path& file) {
  const Hdf5Handle access = hdf5_file_access();
  check_hdf5(H5Pset_file_locking(access, false, true), "set up HDF5");
  file_ = Hdf5Handle(H5Fopen(file.c_str(), H5F_ACC_RDONLY, access), H5Fclose, "open the file");
}

Hdf5Handle H5Reader::open(const std::string& name) const {
  if (H5Lexists(file_, name.c_str(), H5P_DEFAULT) <= 0) throw Hdf5Error("it has no array " + name);
  return {H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose, "open an array"};
}

std::uint64_t H5Reader::number(const std::string& attribute) const {
  if (H5Aexists(file_, attribute.c_str()) <= 0) throw Hdf5Error("it has no attribute " + attribute);
  const Hdf5Handle found(H5Aopen(file_, attribute.c_str(), H5P_DEFAULT), H5Aclose, "open an attribute");
  const Hdf5Handle space(H5Aget_space(found), H5Sclose, "read an attribute");
  if (H5Sget_simple_extent_npoints(space) != 1) throw Hdf5Error("attribute " + attribute + " is not a number");
  std::uint64_t value = 0;
  check_hdf5(H5Aread(found, H5T_NATIVE_UINT64, &value), "read an attribute");
  return value;
}

std::string H5Reader::text(const std::string& attribute) const {
  if (H5Aexists(file_, attribute.c_str()) <= 0) throw Hdf5Error("it has no attribute " + attribute);
  const Hdf5Handle found(H5Aopen(file_, attribute.c_str(), H5P_DEFAULT), H5Aclose, "open an attribute");
  const Hdf5Handle space(H5Aget_space(found), H5Sclose, "read an attribute");
  const Hdf5Handle type(H5Aget_type(found), H5Tclose, "read an attribute");
  require_text(type, "attribute " + attribute);
  if (H5Sget_simple_extent_npoints(space) != 1) throw Hdf5Error("attribute " + attribute + " is a list");
  char* read = nullptr;
  const Hdf5Handle wanted = hdf5_any_text_type();
  check_hdf5(H5Aread(found, wanted, &read), "read an attribute");
  std::string value(read != nullptr ? read : "");
  H5Dvlen_reclaim(wanted, space, H5P_DEFAULT, &read);
  return value;
}

std::vector<double> H5Reader::array(const std::string& name, std::size_t values) const {
  const Hdf5Handle set = open(name);
  if (values_of(set) != values)
    throw Hdf5Error("array " + name + " has " + std::to_string(values_of(set)) + " values, not " +
                    std::to_string(values));
  std::vector<double> read(values);
  if (values > 0)
    check_hdf5(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, read.data()), "read an array");
  return read;
}

std::vector<std::string> H5Reader::names(const std::string& name) const {
  const Hdf5Handle set = open(name);
  const Hdf5Handle type(H5Dget_type(set), H5Tclose, "read an array");
  require_text(type, "array " + name);
  std::vector<char*> read(values_of(set), nullptr);
  std::vector<std::string> texts;
  if (read.empty()) return texts;
  const Hdf5Handle wanted = hdf5_any_text_type();
  check_hdf5(H5Dread(set, wanted, H5S_ALL, H5S_ALL, H5P_DEFAULT, read.data()), "read an array");
  for (const char* text : read) texts.emplace_back(text != nullptr ? text : "");
  const Hdf5Handle space(H5Dget_space(set), H5Sclose, "read an array");
  H5Dvlen_reclaim(wanted, space, H5P_DEFAULT, read.data());
  return texts;
}

}  // namespace lichtmc
