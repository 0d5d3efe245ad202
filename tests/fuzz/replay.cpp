// Calls a fuzz target without libFuzzer, so with any compiler and in the build of the suite: for each file as it is, and
// for copies with changes from a fixed seed (cut off, bytes changed, pieces removed, repeated or inserted).
//
//   replay_TARGET FAILED CHANGES FILE_OR_FOLDER...     CHANGES: the number of changed copies of a file
//
// Files above 40 kB are omitted, as in tools/fuzz.sh. Input on which the target aborts or crashes is written to FAILED.
#include <algorithm>
#include <array>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

constexpr std::uintmax_t largest_file = 40960;

using Random = std::mt19937_64;

// For the handler of signals, which may use nothing that allocates.
const char* failed_path = nullptr;
const char* input_begin = nullptr;
std::size_t input_size = 0;

void on_failure(int) {
  const int file = ::open(failed_path, O_WRONLY | O_CREAT | O_TRUNC, 0644);
  constexpr std::string_view text = "The target fails on the input that is written to: ";
  bool written = file >= 0 && ::write(file, input_begin, input_size) == static_cast<ssize_t>(input_size);
  written = ::write(STDERR_FILENO, text.data(), text.size()) > 0 && written;
  written = ::write(STDERR_FILENO, failed_path, std::string_view(failed_path).size()) > 0 && written;
  ::_exit(written ? 1 : 2);
}

void run(const std::string& input) {
  input_begin = input.data();
  input_size = input.size();
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
}

// A number below `count`; the same on all systems, unlike std::uniform_int_distribution.
std::size_t below(Random& random, std::size_t count) { return static_cast<std::size_t>(random() % count); }

std::string changed(std::string text, Random& random) {
  // What readers of text and of binary files meet seldom.
  constexpr std::array<std::string_view, 14> pieces = {"-1", "0", "1e999", "nan", "4294967295", "18446744073709551616", "\"", "{", "[", "]", ",", "\n", "\xff\xfe", "null"};
  const std::size_t count = 1 + below(random, 4);
  for (std::size_t k = 0; k < count && !text.empty(); ++k) {
    const std::size_t at = below(random, text.size());
    const std::size_t length = 1 + below(random, std::min<std::size_t>(64, text.size() - at));
    switch (below(random, 8)) {
      case 0: text.resize(at); break;
      case 1: text[at] = static_cast<char>(random() & 0xff); break;
      case 2: text[at] = static_cast<char>(text[at] ^ (1 << below(random, 8))); break;
      case 3: text.erase(at, length); break;
      case 4: text.insert(below(random, text.size()), text.substr(at, length)); break;
      case 5: text.insert(at, pieces[below(random, pieces.size())]); break;
      default: text.replace(at, length, pieces[below(random, pieces.size())]); break;
    }
  }
  return text;
}

std::vector<std::filesystem::path> files_in(int count, char** arguments) {
  std::vector<std::filesystem::path> files;
  for (int k = 0; k < count; ++k) {
    if (!std::filesystem::is_directory(arguments[k])) {
      files.emplace_back(arguments[k]);
      continue;
    }
    for (const auto& entry : std::filesystem::recursive_directory_iterator(arguments[k])) {
      if (entry.is_regular_file() && entry.file_size() <= largest_file) files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 4) {
    std::fprintf(stderr, "replay FAILED CHANGES FILE_OR_FOLDER...\n");
    return 2;
  }
  failed_path = arguments[1];
  const long changes = std::strtol(arguments[2], nullptr, 10);
  for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL}) std::signal(signal, on_failure);
  Random random(1);
  long runs = 0;
  const std::vector<std::filesystem::path> files = files_in(count - 3, arguments + 3);
  for (const std::filesystem::path& path : files) {
    std::ifstream file(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    if (text.empty()) continue;
    run(text);
    ++runs;
    for (long k = 0; k < changes; ++k, ++runs) run(changed(text, random));
  }
  std::printf("%zu files, %ld inputs\n", files.size(), runs);
  return files.empty() ? 1 : 0;
}
