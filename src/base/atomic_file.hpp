// Files that appear whole or not at all.
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

namespace lichtmc {

// Takes a file's bytes, piece by piece.
using Sink = std::function<void(std::string_view)>;

// Writes what `produce` gives to its sink to a temporary file beside `file`, has it flushed to the disk and renames it:
// a reader, or a crash at any moment, sees the old file or the new one. Throws RuntimeError naming the file and the
// reason; the temporary file is removed then, as when `produce` throws.
void write_file_atomically(const std::filesystem::path& file, const std::function<void(const Sink&)>& produce);
void write_file_atomically(const std::filesystem::path& file, std::string_view bytes);

// Has a folder's entries flushed to the disk: names that are new, and that old ones are gone. Where that cannot be done
// nothing happens.
void flush_folder(const std::filesystem::path& folder);

}  // namespace lichtmc
