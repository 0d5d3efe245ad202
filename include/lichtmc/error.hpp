// Errors of lichtmc, of two kinds: those that the user can correct (InputError) and failures of the machine
// (RuntimeError).
//
// Every message reads: what is wrong (the value and what is allowed). What to do.
#pragma once

#include <stdexcept>

namespace lichtmc {

// Base of all exceptions that the library itself throws.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A file, an option or a setting is wrong. The message names the file and the node, mesh or material in it, or the
// option, with the value, the legal range and what to do. Programs end with exit status 2.
class InputError : public Error {
 public:
  using Error::Error;
};

// The machine failed: disk, memory, device. Programs end with exit status 1.
class RuntimeError : public Error {
 public:
  using Error::Error;
};

}  // namespace lichtmc
