// Loaded into the program by LD_PRELOAD: logs the calls that bring files to the disk and to their names, and makes one
// of them fail. LICHTMC_DISK_LOG: file to append to; LICHTMC_DISK_FAULT: "CALL ERRNO", for example "syncfs 5".
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <dlfcn.h>
#include <unistd.h>

namespace {

void log(const char* call, const char* path) {
  const char* file = std::getenv("LICHTMC_DISK_LOG");
  std::FILE* out = file == nullptr ? nullptr : std::fopen(file, "a");
  if (out == nullptr) return;
  std::fprintf(out, "%s %s\n", call, path);
  std::fclose(out);
}

// Sets errno and returns true if this call is to fail.
bool fails(const char* call) {
  const char* fault = std::getenv("LICHTMC_DISK_FAULT");
  const std::size_t length = std::strlen(call);
  if (fault == nullptr || std::strncmp(fault, call, length) != 0 || fault[length] != ' ') return false;
  errno = std::atoi(fault + length);
  return true;
}

int flush(const char* call, int descriptor) {
  char link[64];
  char path[4096] = "";
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  const ssize_t size = ::readlink(link, path, sizeof path - 1);
  path[size > 0 ? size : 0] = '\0';
  log(call, path);
  if (fails(call)) return -1;
  return reinterpret_cast<int (*)(int)>(::dlsym(RTLD_NEXT, call))(descriptor);
}

}  // namespace

extern "C" int fsync(int descriptor) {
  return flush("fsync", descriptor);
}

extern "C" int syncfs(int descriptor) noexcept {
  return flush("syncfs", descriptor);
}

extern "C" int rename(const char* from, const char* to) noexcept {
  log("rename", to);
  if (fails("rename")) return -1;
  return reinterpret_cast<int (*)(const char*, const char*)>(::dlsym(RTLD_NEXT, "rename"))(from, to);
}
