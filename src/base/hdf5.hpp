// HDF5 for all who use it: errors as exceptions, objects that close themselves, the lock, files in memory.
//
// HDF5 has state for the whole process and may be called by one thread at a time: whoever calls it holds an
// Hdf5Session. Files are made in memory, because HDF5 1.10 cannot close a file on a full disk.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>

#include <hdf5.h>

#include "base/hdf5_error.hpp"

namespace lichtmc {

// Throws Hdf5Error "cannot <what>" if the status of a call is an error.
void check_hdf5(herr_t status, const std::string& what);

// The right to call HDF5, which one thread has at a time. Errors are exceptions, not text on stderr.
class Hdf5Session {
 public:
  Hdf5Session();
  ~Hdf5Session();
  Hdf5Session(const Hdf5Session&) = delete;
  Hdf5Session& operator=(const Hdf5Session&) = delete;

 private:
  std::unique_lock<std::mutex> lock_;
  H5E_auto2_t old_report_ = nullptr;
  void* old_data_ = nullptr;
};

// An HDF5 object, closed by the destructor.
class Hdf5Handle {
 public:
  using Closer = herr_t (*)(hid_t);

  Hdf5Handle() = default;
  // Throws Hdf5Error "cannot <what>" if the object was not made.
  Hdf5Handle(hid_t id, Closer closer, const std::string& what);
  ~Hdf5Handle() { close(); }
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), closer_(other.closer_) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(closer_, other.closer_);
    return *this;
  }
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;

  operator hid_t() const { return id_; }
  bool close() { return id_ < 0 || closer_(std::exchange(id_, -1)) >= 0; }

 private:
  hid_t id_ = -1;
  Closer closer_ = nullptr;
};

// Properties of file access: closing a file closes its objects.
Hdf5Handle hdf5_file_access();

// Text of this length (without the terminating 0) in UTF-8, as a type.
Hdf5Handle hdf5_text_type(std::size_t length);

// Text of any length in UTF-8, which Python and MATLAB read as text and not as bytes.
Hdf5Handle hdf5_any_text_type();

// A new file in memory that leaves `user_bytes` (0, or a power of two ≥ 512) free at its beginning. about: its expected
// size in bytes. The same contents give the same bytes.
Hdf5Handle make_hdf5_in_memory(std::uint64_t user_bytes, std::uint64_t about);

// All bytes of a file in memory after the user block; valid until it is written or closed.
std::string_view hdf5_image(const Hdf5Handle& file, std::uint64_t user_bytes);

}  // namespace lichtmc
