// The program lichtmc.
#include "command_line.hpp"

int main(int argc, char** argv) { return lichtmc::app::run_command_line(argc, argv); }
