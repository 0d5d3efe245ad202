// Files that appear whole or not at all.
#pragma once

#include <filesystem>
#include <string_view>

namespace lichtmc {

// Writes bytes to a temporary file beside `file`, has them flushed to the disk and renames it: a reader, or a crash at
// any moment, sees the old file or the new one. Throws RuntimeError naming the file and the reason; the temporary file
// is removed then.
void write_file_atomically(const std::filesystem::path& file, std::string_view bytes);

}  // namespace lichtmc
