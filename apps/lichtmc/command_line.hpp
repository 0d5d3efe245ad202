// The program lichtmc as a function, for its own main() and for the command of the Python package.
#pragma once

namespace lichtmc::app {

// Reads the command line (argv[0] is the name of the program), runs a command, and turns errors into messages on stderr
// and the exit status: 0 done, 1 the run failed, 2 the command line or an input is wrong. It takes charge of the
// process: its signals, its terminate handler, the state of the terminal. Call it once, from the main thread.
int run_command_line(int argc, char** argv);

}  // namespace lichtmc::app
