# What every target of the project is compiled with, as one interface target: the standard, the warnings, the sanitizers.
add_library(lichtmc_options INTERFACE)
target_compile_features(lichtmc_options INTERFACE cxx_std_20)
target_compile_options(lichtmc_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion
  -Wold-style-cast -Wnon-virtual-dtor -Woverloaded-virtual -Wimplicit-fallthrough)
# GCC 12 sees overlaps in std::string's operator+ that are not there (GCC bug 105651).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(lichtmc_options INTERFACE -Wno-restrict)
endif()
if(LICHTMC_WARNINGS_AS_ERRORS)
  target_compile_options(lichtmc_options INTERFACE -Werror)
endif()
# The same source gives the same bits wherever it is compiled for the same machine: no contraction into fused
# multiply-adds at the compiler's whim, and never -ffast-math.
# Nobody reads errno after a square root, or traps on floating-point exceptions: without them loops run in lanes.
target_compile_options(lichtmc_options INTERFACE -ffp-contract=off -fno-math-errno -fno-trapping-math)
if(LICHTMC_FUZZ)
  # Everything tells the fuzzer which way it went.
  target_compile_options(lichtmc_options INTERFACE -fsanitize=fuzzer-no-link)
endif()
if(LICHTMC_SANITIZE)
  target_compile_options(lichtmc_options INTERFACE -fsanitize=${LICHTMC_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(lichtmc_options INTERFACE -fsanitize=${LICHTMC_SANITIZE})
endif()

find_program(LICHTMC_CCACHE ccache)
mark_as_advanced(LICHTMC_CCACHE)
if(LICHTMC_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${LICHTMC_CCACHE})
endif()
