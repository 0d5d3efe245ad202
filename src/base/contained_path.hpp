// Names of files in a file that comes from elsewhere: only files beneath its own folder may be opened.
#pragma once

#include <filesystem>
#include <string>

namespace lichtmc {

// Where a named file is, or why it must not be opened.
struct ContainedPath {
  std::filesystem::path path;
  std::string fault;    // empty if the path may be opened: "it is an absolute path", …
  std::string allowed;  // with a fault: which names are allowed
  std::string remedy;   // with a fault: what to do, one or two sentences
};

// The path of the file `name` (UTF-8, "/" between folders) beneath `folder`. Faults: an empty name, a NUL character, an
// absolute path or a drive letter of Windows, ".." that leads out of the folder, and, unless `follow_links`, a symbolic
// link that does. The file may be missing. `folder`: empty for the working folder.
ContainedPath path_within(const std::filesystem::path& folder, const std::string& name, bool follow_links);

}  // namespace lichtmc
