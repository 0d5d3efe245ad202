// The subset of HDF5 that states need: groups with attributes (numbers, text) and arrays of 64-bit numbers.
//
// One thread may call HDF5 at a time: an Hdf5File holds a lock during its lifetime (base/hdf5.hpp).
//
// Reading accepts only what writing makes: integers, reals and text of the written types, groups and arrays that are
// members of the file itself, arrays with all rows stored in it. HDF5 itself would convert other types, follow links to
// other files, and return rows that are not stored.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/hdf5_error.hpp"

namespace lichtmc {

// Rows of `columns` numbers; one column: a one-dimensional array.
struct Shape {
  std::uint64_t rows = 0;
  std::uint64_t columns = 1;
};

class Hdf5File {
 public:
  // A new file, in memory, that leaves `user_bytes` (a power of two ≥ 512) free at its beginning. about: its expected
  // size in bytes. All functions of this class throw Hdf5Error.
  static Hdf5File in_memory(std::uint64_t user_bytes, std::uint64_t about);
  // An existing file, to read.
  explicit Hdf5File(const std::filesystem::path& file);
  // The same, of the bytes of a file, which are copied.
  static Hdf5File of_bytes(std::string_view bytes);
  ~Hdf5File();
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;
  Hdf5File(Hdf5File&&) noexcept;
  Hdf5File& operator=(Hdf5File&&) noexcept;

  // Selects the current group ("/": the root group); when writing, creates it.
  void enter(const std::string& group);
  bool has_group(const std::string& group) const;
  // Number of groups and arrays in the root group.
  std::uint64_t members() const;

  void write(const char* attribute, std::uint64_t value);
  void write(const char* attribute, double value);
  void write(const char* attribute, const std::string& text);
  void write(const char* array, const std::uint64_t* values, Shape shape);
  void write(const char* array, const double* values, Shape shape);

  void read(const char* attribute, std::uint64_t& value);
  void read(const char* attribute, double& value);
  void read(const char* attribute, std::string& text);
  // Number of rows of an array with this number of columns; at most as many as the file has bytes for.
  std::uint64_t rows(const char* array, std::uint64_t columns) const;
  void read(const char* array, std::uint64_t* values, Shape shape);
  void read(const char* array, double* values, Shape shape);

  // All bytes of a file in memory after the user block; valid until the next write or the end of the object.
  std::string_view image();

 private:
  Hdf5File();

  struct Handles;
  std::unique_ptr<Handles> handles_;
};

}  // namespace lichtmc
