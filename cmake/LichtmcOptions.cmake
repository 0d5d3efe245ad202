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

# lichtmc_precompile(TARGET HEADER...): the headers are parsed once for all sources of the target. A source must not
# depend on this: the presets asan, tsan and fuzz build with LICHTMC_PCH=OFF and LICHTMC_UNITY=OFF, so that a missing
# #include is an error there.
function(lichtmc_precompile target)
  if(NOT LICHTMC_PCH)
    return()
  endif()
  target_precompile_headers(${target} PRIVATE ${ARGN})
  lichtmc_precompiled_options(${target})
endfunction()

# lichtmc_precompile_from(TARGET OTHER): TARGET uses the precompiled headers of OTHER. Both need the same options.
function(lichtmc_precompile_from target other)
  if(NOT LICHTMC_PCH)
    return()
  endif()
  target_precompile_headers(${target} REUSE_FROM ${other})
  lichtmc_precompiled_options(${target})
endfunction()

function(lichtmc_precompiled_options target)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -fpch-preprocess)  # for ccache
    if(CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
      # With a precompiled <string> GCC 12 reports overlaps and overflows in std::string that do not exist. The presets
      # without precompiled headers keep these warnings.
      target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
    endif()
  elseif(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    target_compile_options(${target} PRIVATE "SHELL:-Xclang -fno-pch-timestamp")  # for ccache
  endif()
endfunction()

# lichtmc_compile_together(TARGET GROUP SOURCE...): with LICHTMC_UNITY these sources of the current folder are compiled as
# one, which reads and instantiates the templates of a large library once for all. Names in unnamed namespaces must
# differ within a group. asan, tsan and fuzz compile them one by one.
function(lichtmc_compile_together target group)
  list(TRANSFORM ARGN PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${LICHTMC_UNITY} UNITY_BUILD_MODE GROUP)
  set_source_files_properties(${ARGN} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP ${group})
endfunction()

# lichtmc_compile_in_groups(TARGET SIZE FOLDER...): with LICHTMC_UNITY the remaining sources of these folders below the current
# one are compiled SIZE at a time, which reads the headers once for all: less than half of the time.
function(lichtmc_compile_in_groups target size)
  get_target_property(sources ${target} SOURCES)
  foreach(folder ${ARGN})
    set(number 0)
    foreach(source ${sources})
      get_source_file_property(grouped ${source} TARGET_DIRECTORY ${target} UNITY_GROUP)
      if(grouped OR NOT source MATCHES "^${CMAKE_CURRENT_SOURCE_DIR}/${folder}/")
        continue()
      endif()
      math(EXPR group "${number} / ${size}")
      set_source_files_properties(${source} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP ${folder}_${group})
      math(EXPR number "${number} + 1")
    endforeach()
  endforeach()
endfunction()

find_program(LICHTMC_CCACHE ccache)
mark_as_advanced(LICHTMC_CCACHE)
if(LICHTMC_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # ccache caches nothing that uses precompiled headers without this setting.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime ${LICHTMC_CCACHE})
endif()
