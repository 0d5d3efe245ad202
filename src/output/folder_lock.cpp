#include "lichtmc/folder_lock.hpp"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <csignal>

#include "base/message.hpp"
#include "lichtmc/error.hpp"
#include "output/folder.hpp"

namespace lichtmc {

namespace fs = std::filesystem;

namespace {

enum class Outcome { locked, taken, unsupported };

// A lock of the open file, not of the process: two locks within one process exclude each other, and closing another
// descriptor of the file does not end it. Where these are missing, a lock of the process.
Outcome try_lock(int descriptor) {
  struct flock whole {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  for (const int command : {F_OFD_SETLK, F_SETLK}) {
    int error = 0;
    do error = ::fcntl(descriptor, command, &whole) == 0 ? 0 : errno;
    while (error == EINTR);
    if (error == 0) return Outcome::locked;
    if (error == EAGAIN || error == EACCES) return Outcome::taken;
    if (error != EINVAL) return Outcome::unsupported;  // EINVAL: this kernel does not know the command
  }
  return Outcome::unsupported;
}

// Whether a name still is that of an open file.
bool is_file_at(int descriptor, const fs::path& path) {
  struct stat opened {};
  struct stat named {};
  return ::fstat(descriptor, &opened) == 0 && ::lstat(path.c_str(), &named) == 0 && opened.st_dev == named.st_dev &&
         opened.st_ino == named.st_ino;
}

std::string host() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

// For the message to others; the lock holds also if this cannot be written.
void write_holder(int descriptor) {
  const std::string text = std::to_string(::getpid()) + ' ' + host() + '\n';
  const bool written = ::ftruncate(descriptor, 0) == 0 && ::pwrite(descriptor, text.data(), text.size(), 0) > 0;
  static_cast<void>(written);
}

// " (process 1234 on node7)", or nothing if the holder has not written it yet.
std::string holder_of(int descriptor) {
  std::array<char, 300> bytes{};
  const ssize_t count = ::pread(descriptor, bytes.data(), bytes.size() - 1, 0);
  const std::string text(bytes.data(), count > 0 ? static_cast<std::size_t>(count) : 0);
  const std::size_t blank = text.find(' ');
  const std::size_t end = text.find('\n');
  if (blank == std::string::npos || end == std::string::npos || end < blank) return {};
  const std::string process = text.substr(0, blank);
  const std::string machine = text.substr(blank + 1, end - blank - 1);
  if (process.empty() || process.find_first_not_of("0123456789") != std::string::npos) return {};
  if (machine != host()) return " (process " + process + " on " + in_quotes(machine) + ")";
  // The text of an earlier process that was killed, read before the holder has replaced it.
  if (::kill(static_cast<pid_t>(std::strtol(process.c_str(), nullptr, 10)), 0) != 0 && errno == ESRCH) return {};
  return " (process " + process + ")";
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder) : file_(folder / ".lichtmc.lock") {
  for (;;) {
    descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (descriptor_ < 0) refuse_folder(folder, reason_of({errno, std::generic_category()}));
    const Outcome outcome = try_lock(descriptor_);
    if (outcome == Outcome::taken) {
      const std::string holder = holder_of(descriptor_);
      ::close(std::exchange(descriptor_, -1));
      throw InputError("The output folder " + in_quotes(folder.string()) + " is in use by another run of lichtmc" +
                       holder +
                       " (allowed: one run at a time). Wait until that run ends, or choose another folder with "
                       "--output.");
    }
    supported_ = outcome == Outcome::locked;
    // The holder before may have removed the file between open() and the lock: a lock on a file without a name keeps
    // nobody out.
    if (is_file_at(descriptor_, file_)) break;
    ::close(std::exchange(descriptor_, -1));
  }
  write_holder(descriptor_);
}

FolderLock::FolderLock(FolderLock&& other) noexcept
    : file_(std::move(other.file_)), descriptor_(std::exchange(other.descriptor_, -1)), supported_(other.supported_) {}

FolderLock& FolderLock::operator=(FolderLock&& other) noexcept {
  if (this == &other) return *this;
  release();
  file_ = std::move(other.file_);
  descriptor_ = std::exchange(other.descriptor_, -1);
  supported_ = other.supported_;
  return *this;
}

FolderLock::~FolderLock() {
  release();
}

bool FolderLock::holds() const {
  return descriptor_ >= 0 && is_file_at(descriptor_, file_);
}

// The file is removed before the lock ends: afterwards it could be the lock of another.
void FolderLock::release() noexcept {
  if (descriptor_ < 0) return;
  if (is_file_at(descriptor_, file_)) ::unlink(file_.c_str());
  ::close(std::exchange(descriptor_, -1));
}

}  // namespace lichtmc
