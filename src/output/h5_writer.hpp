// Writes HDF5 files of results: groups, named arrays with their units and dimensions, lists of names.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/hdf5.hpp"

namespace lichtmc {

// An array of numbers, the last dimension fastest.
struct NamedArray {
  std::string name;                   // "h"; of a derived figure "derived/gain"
  std::string unit;                   // "1/s"; "1" for pure numbers
  std::string dimensions;             // "emitter, receiver, order, bin"; empty for a single number
  std::string description;            // a sentence without a full stop
  std::vector<std::size_t> sizes;     // of the dimensions
  std::vector<double> own;            // the values, if the array was made for this; else they are
  std::span<const double> elsewhere;  // in the result, which must outlive the array

  std::span<const double> values() const { return own.empty() ? elsewhere : std::span<const double>(own); }
};

// A file in memory. Errors of HDF5 are Hdf5Error.
class H5Writer {
 public:
  // about: the expected size in bytes.
  explicit H5Writer(std::uint64_t about) : file_(make_hdf5_in_memory(0, about)) {}

  void make_group(const std::string& name);

  // Attributes of the group or data set `of`.
  void attribute(const std::string& of, const std::string& name, const std::string& text);
  void attribute(const std::string& of, const std::string& name, double value);
  void attribute(const std::string& of, const std::string& name, std::uint64_t value);

  void array(const NamedArray& array);
  // A list of texts of any length.
  void names(const std::string& name, const std::string& dimension, const std::string& what,
             const std::vector<std::string>& texts);

  // All bytes of the file; valid until the next call.
  std::string_view image() const { return hdf5_image(file_, 0); }

 private:
  void write_attribute(const std::string& of, const std::string& name, hid_t type, const void* value);
  void describe(const std::string& of, const std::string& unit, const std::string& dimensions,
                const std::string& description);

  Hdf5Session session_;  // ends after the file is closed
  Hdf5Handle file_;
};

}  // namespace lichtmc
