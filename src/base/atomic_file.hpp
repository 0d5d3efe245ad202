// Files that are written completely or not at all.
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

namespace lichtmc {

// Takes a file's bytes, piece by piece.
using Sink = std::function<void(std::string_view)>;

// Writes what `produce` passes to its sink to a temporary file beside `file`, flushes it to the disk and renames it: at
// any moment, also after a crash, `file` is the old file or the new one. Throws RuntimeError that names the file and
// the reason. If this or `produce` throws, the temporary file is removed.
void write_file_atomically(const std::filesystem::path& file, const std::function<void(const Sink&)>& produce);
void write_file_atomically(const std::filesystem::path& file, std::string_view bytes);

// Flushes a folder's entries (new and removed names) to the disk. Where the file system cannot do this, nothing
// happens.
void flush_folder(const std::filesystem::path& folder);

}  // namespace lichtmc
