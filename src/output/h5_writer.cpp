#include "output/h5_writer.hpp"

#include <algorithm>

#include <hdf5.h>

namespace lichtmc {

namespace {

constexpr std::size_t chunk_values = std::size_t{1} << 16;  // 512 kB: fits into the cache, and compresses as one piece

// Large arrays are compressed in chunks: of whole rows of the last dimensions, as many as fit.
Hdf5Handle creation_of(const NamedArray& array) {
  Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "set up HDF5");
  check_hdf5(H5Pset_obj_track_times(creation, false), "set up HDF5");
  constexpr std::size_t few_values = 2048;  // less than four blocks of a disk: chunks would cost more than they save
  if (array.values().size() < few_values) return creation;
  std::vector<hsize_t> chunk(array.sizes.size());
  std::size_t left = chunk_values;
  for (std::size_t d = chunk.size(); d-- > 0;) {
    chunk[d] = std::min(array.sizes[d], std::max<std::size_t>(left, 1));
    left /= chunk[d];
  }
  check_hdf5(H5Pset_chunk(creation, static_cast<int>(chunk.size()), chunk.data()), "set up HDF5");
  // The bytes of doubles side by side: exponents compress, the last digits do not.
  check_hdf5(H5Pset_shuffle(creation), "set up HDF5");
  constexpr unsigned fast = 1;
  check_hdf5(H5Pset_deflate(creation, fast), "set up HDF5");
  return creation;
}

}  // namespace

void H5Writer::make_group(const std::string& name) {
  const Hdf5Handle creation(H5Pcreate(H5P_GROUP_CREATE), H5Pclose, "set up HDF5");
  check_hdf5(H5Pset_obj_track_times(creation, false), "set up HDF5");
  const Hdf5Handle group(H5Gcreate2(file_, name.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT), H5Gclose, "make a group");
}

void H5Writer::attribute(const std::string& of, const std::string& name, const std::string& text) {
  const char* const pointer = text.c_str();
  write_attribute(of, name, hdf5_any_text_type(), &pointer);
}

void H5Writer::attribute(const std::string& of, const std::string& name, double value) {
  write_attribute(of, name, H5T_NATIVE_DOUBLE, &value);
}

void H5Writer::attribute(const std::string& of, const std::string& name, std::uint64_t value) {
  write_attribute(of, name, H5T_NATIVE_UINT64, &value);
}

void H5Writer::array(const NamedArray& array) {
  const std::vector<hsize_t> sizes(array.sizes.begin(), array.sizes.end());
  const Hdf5Handle space = sizes.empty()
                               ? Hdf5Handle(H5Screate(H5S_SCALAR), H5Sclose, "describe an array")
                               : Hdf5Handle(H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr),
                                            H5Sclose, "describe an array");
  const Hdf5Handle creation = creation_of(array);
  const Hdf5Handle made(
      H5Dcreate2(file_, array.name.c_str(), H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose,
      "make an array");
  if (!array.values().empty())
    check_hdf5(H5Dwrite(made, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, array.values().data()),
               "write an array");
  describe(array.name, array.unit, array.dimensions, array.description);
}

void H5Writer::names(const std::string& name, const std::string& dimension, const std::string& what,
                     const std::vector<std::string>& texts) {
  const Hdf5Handle type = hdf5_any_text_type();
  const hsize_t count = texts.size();
  const Hdf5Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose, "describe an array");
  const Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "set up HDF5");
  check_hdf5(H5Pset_obj_track_times(creation, false), "set up HDF5");
  const Hdf5Handle made(H5Dcreate2(file_, name.c_str(), type, space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose,
                        "make an array");
  std::vector<const char*> pointers;
  for (const std::string& text : texts) pointers.push_back(text.c_str());
  if (count > 0) check_hdf5(H5Dwrite(made, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data()), "write an array");
  describe(name, "", dimension, what);
}

void H5Writer::write_attribute(const std::string& of, const std::string& name, hid_t type, const void* value) {
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose, "describe an attribute");
  const Hdf5Handle attribute(
      H5Acreate_by_name(file_, of.c_str(), name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
      "make an attribute");
  check_hdf5(H5Awrite(attribute, type, value), "write an attribute");
}

void H5Writer::describe(const std::string& of, const std::string& unit, const std::string& dimensions,
                        const std::string& description) {
  if (!unit.empty()) attribute(of, "unit", unit);
  attribute(of, "dimensions", dimensions);
  attribute(of, "description", description);
}

}  // namespace lichtmc
