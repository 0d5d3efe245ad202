// The main function of the test programs where Catch2 brings none as a library.
#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>
