// The little of HDF5 that states need: groups with attributes (numbers, text) and arrays of 64-bit numbers.
//
// HDF5 keeps state for the whole process and may be called by one thread at a time: an Hdf5File holds a lock as long as
// it lives. A file is made in memory: where a disk is full HDF5 1.10 cannot let go of a file on it any more.
//
// Reading takes only what writing makes: whole numbers, reals and text of the types that are written, groups and arrays
// that are members of the file itself, arrays all of whose rows are in it. HDF5 would convert other types, follow links
// to other files, and promise rows that nobody has written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace lichtmc {

// What HDF5 has refused, or what is not as states have it: a short text, the middle of a message.
class Hdf5Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Rows of `columns` numbers; one column makes a plain list.
struct Shape {
  std::uint64_t rows = 0;
  std::uint64_t columns = 1;
};

class Hdf5File {
 public:
  // A new file, in memory, that leaves `user_bytes` (a power of two ≥ 512) free at its beginning. about: bytes that it
  // will have. Throws Hdf5Error, as everything here does.
  static Hdf5File in_memory(std::uint64_t user_bytes, std::uint64_t about);
  // An existing one, to read.
  explicit Hdf5File(const std::filesystem::path& file);
  ~Hdf5File();
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;
  Hdf5File(Hdf5File&&) noexcept;
  Hdf5File& operator=(Hdf5File&&) noexcept;

  // What follows is inside this group; "/" is the outermost. When writing it is made.
  void enter(const std::string& group);
  bool has_group(const std::string& group) const;
  // How many groups and arrays the outermost group has.
  std::uint64_t members() const;

  void write(const char* attribute, std::uint64_t value);
  void write(const char* attribute, double value);
  void write(const char* attribute, const std::string& text);
  void write(const char* array, const std::uint64_t* values, Shape shape);
  void write(const char* array, const double* values, Shape shape);

  void read(const char* attribute, std::uint64_t& value);
  void read(const char* attribute, double& value);
  void read(const char* attribute, std::string& text);
  // How many rows of so many columns there are, no more than the file has bytes for.
  std::uint64_t rows(const char* array, std::uint64_t columns) const;
  void read(const char* array, std::uint64_t* values, Shape shape);
  void read(const char* array, double* values, Shape shape);

  // All bytes of a file in memory but the user's; they are there until something is written or the object ends.
  std::string_view image();

 private:
  Hdf5File();

  struct Handles;
  std::unique_ptr<Handles> handles_;
};

}  // namespace lichtmc
