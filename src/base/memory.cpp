#include "base/memory.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
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

// The number behind a name in a file of lines "name: number" or "name number"; nothing if there is none.
std::optional<double> value_in(const std::filesystem::path& file, const std::string& name) {
  std::ifstream in(file);
  for (std::string word; in >> word;) {
    double value = 0.0;
    if (word == name && in >> value) return value;
    in.clear();
  }
  return std::nullopt;
}

// What the process and the groups that contain it may still use. Pages of files that have not been used lately are
// given back when memory is needed.
double left_of_group(const std::filesystem::path& folder) {
  const double limit = limit_in(folder / "memory.max");
  if (limit == unlimited) return unlimited;
  const double given_back = value_in(folder / "memory.stat", "inactive_file").value_or(0.0);
  return std::max(0.0, limit - limit_in(folder / "memory.current") + given_back);
}

double left_of_groups() {
  const std::filesystem::path root = "/sys/fs/cgroup";
  double least = left_of_group(root);
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    if (line.rfind("0::", 0) != 0) continue;  // version 2
    for (std::filesystem::path group = line.substr(3); group.has_relative_path(); group = group.parent_path())
      least = std::min(least, left_of_group(root / group.relative_path()));
  }
  return least;
}

double left_of_process() {
  constexpr double kilobyte = 1024.0;
  const double limit = process_limit();
  if (limit == unlimited) return unlimited;
  return std::max(0.0, limit - kilobyte * value_in("/proc/self/status", "VmSize:").value_or(0.0));
}

}  // namespace

double memory_available() {
  constexpr double kilobyte = 1024.0;
  const auto free = value_in("/proc/meminfo", "MemAvailable:");
  return std::min({free ? kilobyte * *free : unlimited, left_of_process(), left_of_groups()});
}

double memory_used() {
  constexpr double kilobyte = 1024.0;
  return kilobyte * value_in("/proc/self/status", "VmRSS:").value_or(0.0);
}

double memory_limit() {
  return std::min({machine_memory(), process_limit(), group_limit()});
}

}  // namespace lichtmc
