#include "base/atomic_file.hpp"

#include <cerrno>
#include <cstring>
#include <string>

#include <fcntl.h>
#include <unistd.h>

#include "lichtmc/error.hpp"

namespace lichtmc {

namespace {

// A temporary file; the destructor removes it unless it was renamed.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::filesystem::path& target) : target_(target), path_(target) {
    path_ += ".tmp" + std::to_string(::getpid());
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail();
  }
  ~TemporaryFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!renamed_) ::unlink(path_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  // Buffers small pieces: a system call for each would take longer than producing them.
  void write(std::string_view bytes) {
    constexpr std::size_t buffer_size = std::size_t{1} << 18;
    if (bytes.size() >= buffer_size) {
      flush();
      write_out(bytes);
      return;
    }
    buffer_ += bytes;
    if (buffer_.size() >= buffer_size) flush();
  }

  void become_target() {
    flush();
    if (::fsync(descriptor_) != 0) fail();
    const int closed = ::close(descriptor_);
    descriptor_ = -1;
    if (closed != 0 || std::rename(path_.c_str(), target_.c_str()) != 0) fail();
    renamed_ = true;
    flush_folder(target_.has_parent_path() ? target_.parent_path() : ".");
  }

 private:
  void flush() {
    write_out(buffer_);
    buffer_.clear();
  }
  void write_out(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail();
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
  }

  [[noreturn]] void fail() const {
    const int error = errno;
    if (!renamed_) ::unlink(path_.c_str());
    throw RuntimeError("Cannot write " + target_.string() + " (" + std::strerror(error) +
                       "). Check that its folder exists and that the disk has free space, or choose another file.");
  }

  std::filesystem::path target_;
  std::filesystem::path path_;
  std::string buffer_;
  int descriptor_ = -1;
  bool renamed_ = false;
};

}  // namespace

void write_file_atomically(const std::filesystem::path& file, const std::function<void(const Sink&)>& produce) {
  TemporaryFile temporary(file);
  produce([&temporary](std::string_view bytes) { temporary.write(bytes); });
  temporary.become_target();
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
