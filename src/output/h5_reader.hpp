// Reads what H5Writer writes: arrays of numbers, lists of names, attributes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/hdf5.hpp"

namespace lichtmc {

// A file on disk. All functions throw Hdf5Error if what they ask for is not there, or is of another type or size.
class H5Reader {
 public:
  explicit H5Reader(const std::filesystem::path& file);

  std::uint64_t number(const std::string& attribute) const;  // of the root group
  std::string text(const std::string& attribute) const;
  // An array with this number of values, whatever its dimensions.
  std::vector<double> array(const std::string& name, std::size_t values) const;
  std::vector<std::string> names(const std::string& name) const;

 private:
  Hdf5Handle open(const std::string& name) const;

  Hdf5Session session_;  // ends after the file is closed
  Hdf5Handle file_;
};

}  // namespace lichtmc
