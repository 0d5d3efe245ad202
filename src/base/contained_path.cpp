#include "base/contained_path.hpp"

#include <algorithm>
#include <cctype>
#include <system_error>

namespace lichtmc {

namespace {

namespace fs = std::filesystem;

ContainedPath refused(std::string fault, std::string remedy) {
  ContainedPath result;
  result.fault = std::move(fault);
  result.allowed = "a file beneath the folder of the file that names it";
  result.remedy = std::move(remedy);
  return result;
}

bool has_drive_letter(const std::string& name) {
  return name.size() >= 2 && std::isalpha(static_cast<unsigned char>(name[0])) != 0 && name[1] == ':';
}

// Whether a path with all links resolved is `folder` or lies beneath it.
bool lies_beneath(const fs::path& folder, const fs::path& path) {
  const auto [in_folder, in_path] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return in_folder == folder.end();
}

}  // namespace

ContainedPath path_within(const fs::path& folder, const std::string& name, bool follow_links) {
  const std::string move_it = "Copy the file there, and write its name relative to that folder.";
  if (name.empty()) return refused("the name is empty", "Write the name of the file.");
  if (name.find('\0') != std::string::npos) return refused("the name has a NUL character", "Rename the file.");
  if (name.front() == '/' || name.compare(0, 2, "\\\\") == 0 || has_drive_letter(name))
    return refused("it is an absolute path", move_it);
  const fs::path relative = fs::path(name).lexically_normal();
  if (*relative.begin() == "..") return refused("it leads out of the folder", move_it);

  ContainedPath result;
  const fs::path base = folder.empty() ? fs::path(".") : folder;
  result.path = base / relative;
  if (follow_links) return result;
  std::error_code error;
  const fs::path real_base = fs::canonical(base, error);
  if (error) return result;  // reading the file reports the reason
  const fs::path real = fs::canonical(result.path, error);
  if (error) return result;
  if (!lies_beneath(real_base, real))
    return refused("it is a symbolic link that leads out of the folder",
                   "Copy the file there, or give --follow-links.");
  return result;
}

}  // namespace lichtmc
