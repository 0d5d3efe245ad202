#include "console.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iostream>
#include <streambuf>
#include <string>
#include <string_view>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include "lichtmc/error.hpp"
#include "lichtmc/visible_text.hpp"

namespace lichtmc::app {

// Text to a file descriptor; control characters become visible if `safe`. Remembers the first error.
class TerminalBuffer final : public std::streambuf {
 public:
  TerminalBuffer(int descriptor, bool safe) : descriptor_(descriptor), safe_(safe) {}

  int error() const { return error_; }

 protected:
  int_type overflow(int_type c) override {
    if (!traits_type::eq_int_type(c, traits_type::eof())) text_ += traits_type::to_char_type(c);
    return write_if_full() ? traits_type::not_eof(c) : traits_type::eof();
  }
  std::streamsize xsputn(const char* text, std::streamsize count) override {
    text_.append(text, static_cast<std::size_t>(count));
    return write_if_full() ? count : 0;
  }
  int sync() override {
    write_out(text_.size() - bytes_of_open_character());
    return error_ == 0 ? 0 : -1;
  }

 private:
  bool write_if_full() {
    constexpr std::size_t full = std::size_t{1} << 16;
    if (text_.size() >= full) write_out(text_.size() - bytes_of_open_character());
    return error_ == 0;
  }

  // Bytes at the end that begin a character of UTF-8 whose other bytes are not there yet.
  std::size_t bytes_of_open_character() const {
    std::size_t bytes = 0;
    for (std::size_t k = 1; k <= std::min<std::size_t>(3, text_.size()); ++k) {
      const auto c = static_cast<unsigned char>(text_[text_.size() - k]);
      if ((c & 0xC0U) == 0x80U) continue;
      const std::size_t length = c < 0xC0 ? 1 : c < 0xE0 ? 2 : c < 0xF0 ? 3 : 4;
      if (length > k) bytes = k;
      break;
    }
    return bytes;
  }

  void write_out(std::size_t count) {
    const std::string_view text = std::string_view(text_).substr(0, count);
    write_bytes(safe_ ? safe(text) : std::string(text));
    text_.erase(0, count);
  }

  static std::string safe(std::string_view text) {
    std::string out;
    while (!text.empty()) {
      const std::size_t end = std::min(text.find_first_of("\n\t"), text.size());
      out += visible_text(text.substr(0, end));
      if (end < text.size()) out += text[end];
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    return out;
  }

  void write_bytes(std::string_view bytes) {
    while (!bytes.empty() && error_ == 0) {
      const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
      if (written >= 0) {
        bytes.remove_prefix(static_cast<std::size_t>(written));
      } else if (errno == EAGAIN) {  // a terminal or pipe that another program has set to non-blocking
        pollfd ready{descriptor_, POLLOUT, 0};
        ::poll(&ready, 1, -1);
      } else if (errno != EINTR) {
        error_ = errno;
      }
    }
  }

  int descriptor_;
  bool safe_;
  int error_ = 0;
  std::string text_;
};

namespace {

// Descriptors 0, 1 and 2 exist from now on. Reading from a replaced stdin and writing to a replaced stdout fails, so
// that what is lost is noticed.
void open_closed_streams() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(descriptor, F_GETFD) >= 0 || errno != EBADF) continue;
    // The lowest free number, which is this one.
    const int opened = ::open("/dev/null", descriptor == STDOUT_FILENO ? O_RDONLY : O_WRONLY);
    if (opened >= 0 && opened != descriptor) ::close(opened);
  }
}

std::ostream* bar = nullptr;

}  // namespace

struct Console::Streams {
  TerminalBuffer out{STDOUT_FILENO, true};
  TerminalBuffer err{STDERR_FILENO, true};
  TerminalBuffer raw_err{STDERR_FILENO, false};
  std::ostream bar{&raw_err};
  std::streambuf* previous_out = std::cout.rdbuf(&out);
  std::streambuf* previous_err = std::cerr.rdbuf(&err);
};

Console::Console() {
  open_closed_streams();
  pipe_handler_ = std::signal(SIGPIPE, SIG_IGN);
  streams_ = std::make_unique<Streams>();
  streams_->bar << std::unitbuf;
  bar = &streams_->bar;
}

Console::~Console() {
  std::cout.flush();
  std::cout.rdbuf(streams_->previous_out);
  std::cerr.rdbuf(streams_->previous_err);
  bar = nullptr;
}

void Console::finish() {
  std::cout.flush();
  const int error = streams_->out.error();
  if (error == 0) return;
  if (error == EPIPE && pipe_handler_ != SIG_IGN) {
    std::signal(SIGPIPE, SIG_DFL);
    std::raise(SIGPIPE);
  }
  throw RuntimeError(std::string("Cannot write to stdout (") + std::strerror(error) +
                     "): what was printed is incomplete. Connect stdout to a terminal, or to a file on a disk with "
                     "free space.");
}

std::ostream& bar_stream() {
  return *bar;
}

}  // namespace lichtmc::app
