// The standard streams of the program.
//
// Names in rooms and tables may contain characters that a terminal obeys. std::cout and std::cerr therefore write
// control characters, except line ends and tabs, in the visible form of visible_text(); within JSON these are escapes
// with the same meaning. A name with line ends could still look like a line of the program: texts with names are
// printed by visible_text(), one line each.
#pragma once

#include <csignal>
#include <memory>
#include <ostream>

namespace lichtmc::app {

class Console {
 public:
  // Takes over std::cout and std::cerr. A standard stream that is closed is replaced by one without content: otherwise
  // the next file that is opened would receive what is printed. From now on a write to a pipe without reader fails
  // instead of ending the program, so that a run whose messages nobody reads any more still writes its results.
  Console();
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  // Writes the rest of stdout. Throws RuntimeError if anything printed to it was lost: the disk is full, or stdout is
  // closed. If the reader of a pipe has ended (`lichtmc check room.glb | head`), it ends the program quietly by
  // SIGPIPE, like other programs.
  void finish();

 private:
  struct Streams;
  std::unique_ptr<Streams> streams_;
  void (*pipe_handler_)(int) = SIG_DFL;  // of the program's start
};

// stderr as it is, for the control characters of the progress bar. A Console must exist.
std::ostream& bar_stream();

}  // namespace lichtmc::app
