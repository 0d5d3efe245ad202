#include "base/memory.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include <sys/resource.h>
#include <unistd.h>

namespace lichtmc {

namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

double machine_memory() {
  const double bytes = static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
  return bytes > 0.0 ? bytes : unlimited;
}

double process_limit() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unlimited;
  return static_cast<double>(limit.rlim_cur);
}

// The limit in a file that contains a number; "max", or no file, means no limit.
double limit_in(const std::filesystem::path& file) {
  std::ifstream in(file);
  double bytes = 0.0;
  return in >> bytes ? bytes : unlimited;
}

// The smallest limit of the process's control group and of the groups that contain it.
double group_limit() {
  const std::filesystem::path root = "/sys/fs/cgroup";
  double least = std::min(limit_in(root / "memory.max"), limit_in(root / "memory/memory.limit_in_bytes"));
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    if (line.rfind("0::", 0) != 0) continue;  // version 2
    for (std::filesystem::path group = line.substr(3); group.has_relative_path(); group = group.parent_path())
      least = std::min(least, limit_in(root / group.relative_path() / "memory.max"));
  }
  return least;
}

}  // namespace

double memory_limit() {
  return std::min({machine_memory(), process_limit(), group_limit()});
}

}  // namespace lichtmc
