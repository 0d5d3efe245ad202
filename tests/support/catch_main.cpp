// The main function of the test programs if Catch2 provides none as a library.
#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>
