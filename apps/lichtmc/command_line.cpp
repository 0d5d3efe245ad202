#include "command_line.hpp"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <string>

#include "commands.hpp"
#include "console.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/version.hpp"
#include "lichtmc/visible_text.hpp"
#include "process_group.hpp"

namespace lichtmc::app {

namespace {

constexpr int exit_failed = 1;       // the run failed: disk, memory, device
constexpr int exit_wrong_input = 2;  // the command line or an input is wrong

// Names an unknown command; the parser would only report that a command is missing.
void check_command(CLI::App& program, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::string names;
  for (const CLI::App* command : program.get_subcommands({})) {
    if (command->get_name() == argv[1]) return;
    names += (names.empty() ? "" : ", ") + command->get_name();
  }
  throw InputError("There is no command '" + std::string(argv[1]) + "' (allowed: " + names + "). See lichtmc --help.");
}

// Only run and resume share their work; every process would execute any other command.
void check_ranks_agree(int argc, char** argv, const Communicator* communicator) {
  if (communicator == nullptr || communicator->size() == 1 || argc < 2) return;
  const std::string command = argv[1];
  if (command == "run" || command == "resume" || command[0] == '-') return;
  throw InputError("The command '" + command + "' runs in one process, but " + std::to_string(communicator->size()) +
                   " were started (allowed with several processes: run, resume). Start it without mpirun.");
}

// Slurm's srun connects the processes that it starts only through PMIx; without PMIx each process has no communicator.
void warn_if_unconnected(int argc, char** argv, const Communicator* communicator) {
  const auto number = [](const char* name) {
    const char* text = std::getenv(name);
    return text == nullptr ? -1 : std::atoi(text);
  };
  const bool runs = argc > 1 && (std::string(argv[1]) == "run" || std::string(argv[1]) == "resume");
  if (!runs || communicator != nullptr || number("SLURM_STEP_NUM_TASKS") < 2 || number("SLURM_PROCID") != 0) return;
  std::cerr
      << "Warning: srun has started " << number("SLURM_STEP_NUM_TASKS")
      << " processes without a connection between them: each simulates the whole run. To share one run, give srun "
         "--mpi=pmix or use mpirun; for separate runs, give each process a different --output.\n";
}

// The arguments as one line, quoted for a shell.
std::string command_line(int argc, char** argv) {
  std::string line = "lichtmc";
  for (int k = 1; k < argc; ++k) {
    const std::string word = argv[k];
    constexpr const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./:,=%+@";
    if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) {
      line += ' ' + word;
      continue;
    }
    line += " '";
    for (const char c : word) line += c == '\'' ? std::string("'\\''") : std::string(1, c);
    line += '\'';
  }
  return line;
}

int run_program(int argc, char** argv, Communicator* communicator) {
  int status = 0;
  CLI::App program{
      "lichtmc computes the irradiance (W/m^2) or illuminance (lx) on all surfaces of a glTF room, tile by tile, each\n"
      "with its standard error, by Monte Carlo simulation of photons between diffusely reflecting surfaces.\n",
      "lichtmc"};
  program.set_version_flag("--version", std::string("lichtmc ") + std::string(version()));
  program.require_subcommand(1);
  program.footer(
      "Start with:  lichtmc check room.glb, then lichtmc run room.glb\n"
      "More on a command:  lichtmc COMMAND --help\n"
      "Exit status: 0 done; 1 the run failed; 2 the command line or an input is wrong.");
  Invocation invocation;
  invocation.command_line = command_line(argc, argv);
  if (argc > 2) invocation.arguments.assign(argv + 2, argv + argc);
  invocation.communicator = communicator;
  invocation.status = &status;
  for (const auto add_command : all_commands) add_command(program, invocation);
  try {
    check_command(program, argc, argv);
    check_ranks_agree(argc, argv, communicator);
    warn_if_unconnected(argc, argv, communicator);
    program.parse(argc, argv);
  } catch (const CLI::Success& asked) {  // --help and --version
    program.exit(asked);
  }
  return status;
}

constexpr const char* no_memory =
    "The memory was not sufficient. Use larger tiles or fewer threads, free some memory, or split the room.";
constexpr const char* internal_error =
    "An internal error occurred. Please report it together with the command and the room file.";

struct Failure {
  std::string message;
  int status = exit_failed;
};

// Of the exception that is being handled; names in it cannot look like lines of the program.
Failure current_failure() {
  try {
    throw;
  } catch (const CLI::ParseError& error) {
    return {visible_text(error.what()) + "\nSee lichtmc --help, or lichtmc COMMAND --help.", exit_wrong_input};
  } catch (const InputError& error) {
    return {visible_text(error.what()), exit_wrong_input};
  } catch (const Error& error) {
    return {visible_text(error.what()), exit_failed};
  } catch (const std::bad_alloc&) {
    return {no_memory, exit_failed};
  } catch (const std::filesystem::filesystem_error& error) {
    return {"Cannot use " + visible_text(error.path1().string()) + " (" + error.code().message() +
                "). Check the path, its permissions and its disk.",
            exit_failed};
  } catch (...) {  // the texts of other exceptions of libraries mean nothing to a user
    return {internal_error, exit_failed};
  }
}

// For an exception that nobody can handle: libraries need memory even where they release some (nlohmann-json in its
// destructor), and end the program there if it lacks. Takes no memory itself.
[[noreturn]] void end_at_once() {
  const char* message = internal_error;
  if (const std::exception_ptr error = std::current_exception()) {
    try {
      std::rethrow_exception(error);
    } catch (const std::bad_alloc&) {
      message = no_memory;
    } catch (...) {
    }
  }
  for (const char* part : {"lichtmc: ", message, "\n"}) std::fputs(part, stderr);
  std::_Exit(exit_failed);
}

}  // namespace

int run_command_line(int argc, char** argv) {
  std::set_terminate(end_at_once);
  std::signal(SIGXFSZ, SIG_IGN);  // beyond the limit of file size a write then fails with a message
  Console console;
  try {
    const ProcessGroup communicator;
    try {
      const int status = run_program(argc, argv, communicator.get());
      console.finish();
      return status;
    } catch (...) {
      const Failure failure = current_failure();
      communicator.end(failure.message.c_str(), failure.status);
      throw;
    }
  } catch (...) {
    const Failure failure = current_failure();
    std::cerr << "lichtmc: " << failure.message << '\n';
    return failure.status;
  }
}

}  // namespace lichtmc::app
