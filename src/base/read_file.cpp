#include "base/read_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "lichtmc/error.hpp"

namespace lichtmc {

namespace {

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int number() const { return number_; }

 private:
  int number_;
};

const char* kind_of(mode_t mode) {
  if (S_ISDIR(mode)) return "it is a folder";
  if (S_ISFIFO(mode)) return "it is a pipe";
  if (S_ISSOCK(mode)) return "it is a socket";
  if (S_ISCHR(mode) || S_ISBLK(mode)) return "it is a device";
  return "it is not a regular file";
}

FileContent fault_of(std::string fault, bool missing = false) {
  FileContent content;
  content.fault = std::move(fault);
  content.missing = missing;
  return content;
}

// `needed`: the number of bytes to read; none: the whole file, if it has at most `most` bytes.
FileContent read_bytes(const std::filesystem::path& file, std::optional<std::uint64_t> needed, std::uint64_t most) {
  // O_NONBLOCK: opening a pipe without writer would wait for ever. For regular files it has no effect.
  const Descriptor in(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY));
  if (in.number() < 0) {
    const int reason = errno;
    if (reason == ENXIO) return fault_of("it is a socket or a device");
    return fault_of(std::strerror(reason), reason == ENOENT || reason == ENOTDIR);
  }
  struct stat about {};
  if (::fstat(in.number(), &about) != 0) return fault_of(std::strerror(errno));
  if (!S_ISREG(about.st_mode)) return fault_of(kind_of(about.st_mode));
  const auto size = static_cast<std::uint64_t>(about.st_size);
  const auto too_large = [&](std::uint64_t bytes) {
    FileContent content =
        fault_of("it has " + std::to_string(bytes) + " bytes, more than the limit of " + std::to_string(most));
    content.too_large = true;
    return content;
  };
  if (!needed && size > most) return too_large(size);

  // Files of /proc state the size 0, and any file may grow while it is read: the end is where read() returns 0.
  const std::uint64_t end = needed ? *needed : most;
  FileContent content;
  content.bytes.reserve(static_cast<std::size_t>(std::min(size, end)));
  char block[1 << 16];
  while (content.bytes.size() < end || !needed) {
    const ::ssize_t count = ::read(in.number(), block, sizeof block);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return fault_of(std::strerror(errno));
    if (count == 0) break;
    content.bytes.append(block, static_cast<std::size_t>(count));
    if (!needed && content.bytes.size() > most) return too_large(content.bytes.size());
  }
  if (needed && content.bytes.size() > *needed) content.bytes.resize(static_cast<std::size_t>(*needed));
  return content;
}

}  // namespace

FileContent read_regular_file(const std::filesystem::path& file, std::uint64_t most_bytes) {
  return read_bytes(file, std::nullopt, most_bytes);
}

FileContent read_start_of_file(const std::filesystem::path& file, std::uint64_t needed_bytes) {
  return read_bytes(file, needed_bytes, needed_bytes);
}

std::string require_regular_file(const std::filesystem::path& file, std::uint64_t most_bytes, const std::string& name,
                                 const std::string& remedy, const std::string& remedy_if_too_large) {
  FileContent content = read_regular_file(file, most_bytes);
  if (content.fault.empty()) return std::move(content.bytes);
  if (content.missing) throw InputError("Cannot read " + name + " (" + content.fault + "). " + remedy);
  throw InputError("Cannot read " + name + " (" + content.fault + "; allowed: a regular file of up to " +
                   std::to_string(most_bytes) + " bytes). " +
                   (content.too_large && !remedy_if_too_large.empty() ? remedy_if_too_large : remedy));
}

}  // namespace lichtmc
