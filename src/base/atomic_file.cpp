#include "base/atomic_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>
#include <utility>

#include <fcntl.h>
#include <sys/utsname.h>
#include <sys/vfs.h>
#include <unistd.h>

#include "lichtmc/error.hpp"

namespace lichtmc {

namespace {

[[noreturn]] void fail(const std::filesystem::path& file, int error) {
  throw RuntimeError("Cannot write " + file.string() + " (" + std::strerror(error) +
                     "). Check that its folder exists and that the disk has free space, or choose another file.");
}

// A new file that is written piece by piece. Messages name it `shown`.
class NewFile {
 public:
  NewFile(const std::filesystem::path& path, const std::filesystem::path& shown)
      : shown_(shown), descriptor_(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
    if (descriptor_ < 0) fail(shown_, errno);
  }
  ~NewFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  // Buffers small pieces: a system call for each would take longer than producing them.
  void write(std::string_view bytes) {
    constexpr std::size_t buffer_size = std::size_t{1} << 18;
    if (bytes.size() >= buffer_size) {
      write_buffer();
      write_out(bytes);
      return;
    }
    buffer_ += bytes;
    if (buffer_.size() >= buffer_size) write_buffer();
  }

  // A network file system may report only here that the disk is full.
  void close(bool flush_to_disk) {
    write_buffer();
    if (flush_to_disk && ::fsync(descriptor_) != 0) fail(shown_, errno);
    const int closed = ::close(std::exchange(descriptor_, -1));
    if (closed != 0) fail(shown_, errno);
  }

 private:
  void write_buffer() {
    write_out(buffer_);
    buffer_.clear();
  }
  void write_out(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail(shown_, errno);
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
  }

  std::filesystem::path shown_;
  std::string buffer_;
  int descriptor_;
};

// A file name that is removed at the end unless the file was renamed.
class TemporaryName {
 public:
  explicit TemporaryName(const std::filesystem::path& target) : path(target) {
    path += ".tmp" + std::to_string(::getpid());
  }
  ~TemporaryName() {
    if (!renamed_) ::unlink(path.c_str());
  }
  TemporaryName(const TemporaryName&) = delete;
  TemporaryName& operator=(const TemporaryName&) = delete;

  void become(const std::filesystem::path& target) {
    if (std::rename(path.c_str(), target.c_str()) != 0) fail(target, errno);
    renamed_ = true;
  }

  std::filesystem::path path;

 private:
  bool renamed_ = false;
};

// Since Linux 5.8 syncfs() reports that data could not be written.
bool syncfs_reports_errors() {
  utsname system{};
  int major = 0;
  int minor = 0;
  if (::uname(&system) != 0 || std::sscanf(system.release, "%d.%d", &major, &minor) != 2) return false;
  return major > 5 || (major == 5 && minor >= 8);
}

// Whether syncfs() on a file system brings the data to its disk; with FUSE it ends at the process that serves it.
bool syncfs_reaches_disk(int folder) {
  constexpr unsigned fuse = 0x65735546;  // FUSE_SUPER_MAGIC
  struct statfs system {};
  return ::fstatfs(folder, &system) == 0 && static_cast<unsigned>(system.f_type) != fuse;
}

void flush_file(const std::filesystem::path& file) {
  const int opened = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (opened < 0) fail(file, errno);
  const int error = ::fsync(opened) == 0 ? 0 : errno;
  ::close(opened);
  if (error != 0) fail(file, error);
}

}  // namespace

void write_file_atomically(const std::filesystem::path& file, const std::function<void(const Sink&)>& produce) {
  TemporaryName temporary(file);
  NewFile written(temporary.path, file);
  produce([&written](std::string_view bytes) { written.write(bytes); });
  written.close(true);
  temporary.become(file);
  flush_folder(file.has_parent_path() ? file.parent_path() : ".");
}

void write_file(const std::filesystem::path& file, const std::filesystem::path& shown,
                const std::function<void(const Sink&)>& produce) {
  NewFile written(file, shown);
  produce([&written](std::string_view bytes) { written.write(bytes); });
  written.close(false);
}

void flush_files(int folder, const std::vector<std::filesystem::path>& files) {
  // syncfs() also waits for the data of other programs on the same disk; few files are faster one by one.
  constexpr std::size_t few = 16;
  if (files.size() > few && syncfs_reports_errors() && syncfs_reaches_disk(folder)) {
    if (::syncfs(folder) == 0) return;
    const bool lost = errno == EIO || errno == ENOSPC || errno == EDQUOT;
    if (lost) fail(files.front().parent_path(), errno);
  }
  for (const std::filesystem::path& file : files) flush_file(file);
}

// Some file systems cannot flush folders; this is not an error.
void flush_folder(const std::filesystem::path& folder) {
  const int opened = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (opened < 0) return;
  ::fsync(opened);
  ::close(opened);
}

void write_file_atomically(const std::filesystem::path& file, std::string_view bytes) {
  write_file_atomically(file, [bytes](const Sink& sink) { sink(bytes); });
}

}  // namespace lichtmc
