// One writer per folder of results.
#pragma once

#include <filesystem>

namespace lichtmc {

// Holds a folder of results for one writer. Two runs that write into one folder at the same time would leave the report
// of one beside the tables of the other.
//
// The lock is one of the operating system on the file .lichtmc.lock in the folder: it ends with the object or with the
// process, however that ends, so a file that a killed process has left does not block. It is exclusive also within one
// process. On several machines it holds where the file system has locks that all of them see (NFS does).
class FolderLock {
 public:
  // Locks an existing folder. Throws InputError that names the folder and, if known, the process, if another writer
  // holds it; also if the file cannot be created.
  explicit FolderLock(const std::filesystem::path& folder);
  // Removes the file and ends the lock.
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&& other) noexcept;

  // Whether the folder still exists and has the file of this lock; false after someone has removed them.
  bool holds() const;

  // False if the file system has no locks: then other writers are not kept out.
  bool supported() const { return supported_; }

 private:
  void release() noexcept;

  std::filesystem::path file_;
  int descriptor_ = -1;
  bool supported_ = true;
};

}  // namespace lichtmc
