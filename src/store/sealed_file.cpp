#include "store/sealed_file.hpp"

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>
#include <vector>

#include "base/checksum.hpp"
#include "base/message.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/version.hpp"

namespace lichtmc {

namespace fs = std::filesystem;

namespace {

// Checksum of all bytes after the seal; n: their number.
std::array<std::uint64_t, 2> checksum_of_rest(std::istream& in, std::uint64_t& n) {
  Checksum sum;
  std::vector<char> piece(std::size_t{1} << 20);
  n = 0;
  in.seekg(seal_bytes);
  while (in) {
    in.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    const auto got = static_cast<std::size_t>(in.gcount());
    sum.add(piece.data(), got);
    n += got;
  }
  return sum.value();
}

std::string seal_with(std::string_view title, const std::array<std::uint64_t, 2>& checksum, std::uint64_t n) {
  std::string text =
      std::string(title) + "\n" + std::to_string(n) + " bytes follow; XXH3-128 " + to_hex(checksum) + "\n";
  text.resize(seal_bytes, '\0');
  return text;
}

// The program that writes states with this title.
std::string writer_of(std::string_view title) {
  return title == "lichtmc state, layout 1" ? "lichtmc 0.1.0" : "another version of lichtmc";
}

[[noreturn]] void refuse(const std::string& source, const std::string& what) {
  throw InputError("Cannot read the state " + in_quotes(source) + ": " + what);
}

// found: the first bytes, as many as a seal has or fewer.
void check_title(std::string_view found, const std::string& source, std::string_view title) {
  const std::string_view first_line = found.substr(0, found.find('\n'));
  constexpr std::size_t kind = 13;  // "lichtmc state", the beginning of every title
  if (first_line == title) return;
  if (first_line.substr(0, kind) != title.substr(0, kind))
    refuse(source,
           "it is no state of lichtmc, or its beginning is damaged (allowed: a file state.h5 that lichtmc has "
           "written). Give another file, or start a new run.");
  refuse(source, "it is a " + in_quotes(std::string(first_line)) + ", as " + writer_of(first_line) +
                     " writes it (allowed: " + in_quotes(std::string(title)) + ", as lichtmc " +
                     std::string(version()) + " writes it). Use that version, or start a new run.");
}

constexpr const char* damaged =
    "it is damaged: its checksum is wrong (allowed: the unchanged file). Use a copy of it, if there is one, or start a "
    "new run.";

}  // namespace

std::string seal_of(std::string_view title, std::string_view rest) {
  Checksum sum;
  sum.add(rest.data(), rest.size());
  return seal_with(title, sum.value(), rest.size());
}

void check_seal(const fs::path& file, std::string_view title) {
  std::error_code error;
  if (fs::exists(file, error) && !fs::is_regular_file(file, error)) {  // opening a pipe would wait for ever
    refuse(
        file.string(),
        "it is no state of lichtmc, but a folder, pipe or device (allowed: a file state.h5 that lichtmc has written). "
        "Give another file, or start a new run.");
  }
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    refuse(file.string(), std::string(std::strerror(errno)) +
                              " (allowed: a file state.h5 that lichtmc has written). Check the name and the folder.");
  }
  std::string found(seal_bytes, '\0');
  stream.read(found.data(), static_cast<std::streamsize>(found.size()));
  check_title(found, file.string(), title);
  std::uint64_t n = 0;
  stream.clear();
  const std::array<std::uint64_t, 2> checksum = checksum_of_rest(stream, n);
  if (found != seal_with(title, checksum, n)) refuse(file.string(), damaged);
}

void check_seal(std::string_view bytes, const std::string& source, std::string_view title) {
  const std::string_view found = bytes.substr(0, seal_bytes);
  check_title(found, source, title);
  if (found.size() < seal_bytes || found != seal_of(title, bytes.substr(seal_bytes))) refuse(source, damaged);
}

}  // namespace lichtmc
