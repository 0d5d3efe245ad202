// Files that are written completely or not at all.
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>
#include <vector>

namespace lichtmc {

// Takes a file's bytes, piece by piece.
using Sink = std::function<void(std::string_view)>;

// Writes what `produce` passes to its sink to a temporary file beside `file`, flushes it to the disk and renames it: at
// any moment, also after a crash, `file` is the old file or the new one. Throws RuntimeError that names the file and
// the reason. If this or `produce` throws, the temporary file is removed.
void write_file_atomically(const std::filesystem::path& file, const std::function<void(const Sink&)>& produce);
void write_file_atomically(const std::filesystem::path& file, std::string_view bytes);

// Writes a file without flushing it to the disk; an existing file is replaced at once. Messages name it `shown`. Throws
// RuntimeError if it cannot be written completely.
void write_file(const std::filesystem::path& file, const std::filesystem::path& shown,
                const std::function<void(const Sink&)>& produce);

// Flushes files of one folder (and folders in it) to the disk. `folder` is a descriptor of it that was opened before
// they were written. Many files are flushed by one call for their whole file system (syncfs), because flushing each
// takes a write of the file system's journal per file: minutes for ten thousand. Where that call is missing, does not
// report errors (Linux before 5.8) or does not reach the disk (FUSE), each file is flushed. Throws RuntimeError if a
// file could not be written to the disk.
void flush_files(int folder, const std::vector<std::filesystem::path>& files);

// Flushes a folder's entries (new and removed names) to the disk. Where the file system cannot do this, nothing
// happens.
void flush_folder(const std::filesystem::path& folder);

}  // namespace lichtmc
