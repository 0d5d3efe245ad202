// The error of HDF5, for code that does not call it itself.
#pragma once

#include <stdexcept>

namespace lichtmc {

// HDF5 failed, or a file has other contents than required. The text is a part of a message.
class Hdf5Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace lichtmc
