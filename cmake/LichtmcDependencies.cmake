# The libraries that lichtmc stands on, found where the system's packages put them. Read by the build here and by
# programs that use the installed package.
find_package(glm REQUIRED)
# Debian 12's Imath names a Python library that only another package brings; its message about that is of no use here.
set(lichtmc_log_level "${CMAKE_MESSAGE_LOG_LEVEL}")
set(CMAKE_MESSAGE_LOG_LEVEL WARNING)
find_package(OpenEXR REQUIRED)
set(CMAKE_MESSAGE_LOG_LEVEL "${lichtmc_log_level}")
find_package(TinyGLTF REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(embree 4 QUIET)
if(NOT embree_FOUND)
  find_package(embree 3 REQUIRED)
endif()
find_package(draco REQUIRED)
find_package(hwy REQUIRED)
find_package(meshoptimizer REQUIRED)
# HDF5 and xxHash come without CMake packages that both releases have.
if(NOT TARGET lichtmc_hdf5)
  find_library(LICHTMC_HDF5_LIBRARY NAMES hdf5_serial hdf5 REQUIRED)
  find_path(LICHTMC_HDF5_INCLUDE_DIR hdf5.h PATH_SUFFIXES hdf5/serial REQUIRED)
  find_library(LICHTMC_XXHASH_LIBRARY xxhash REQUIRED)
  find_path(LICHTMC_XXHASH_INCLUDE_DIR xxhash.h REQUIRED)
  mark_as_advanced(LICHTMC_HDF5_LIBRARY LICHTMC_HDF5_INCLUDE_DIR LICHTMC_XXHASH_LIBRARY LICHTMC_XXHASH_INCLUDE_DIR)
  add_library(lichtmc_hdf5 UNKNOWN IMPORTED)
  set_target_properties(lichtmc_hdf5 PROPERTIES IMPORTED_LOCATION ${LICHTMC_HDF5_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${LICHTMC_HDF5_INCLUDE_DIR})
  add_library(lichtmc_xxhash UNKNOWN IMPORTED)
  set_target_properties(lichtmc_xxhash PROPERTIES IMPORTED_LOCATION ${LICHTMC_XXHASH_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${LICHTMC_XXHASH_INCLUDE_DIR})
endif()
# matio has none.
if(NOT TARGET lichtmc_matio)
  find_library(LICHTMC_MATIO_LIBRARY matio REQUIRED)
  find_path(LICHTMC_MATIO_INCLUDE_DIR matio.h REQUIRED)
  mark_as_advanced(LICHTMC_MATIO_LIBRARY LICHTMC_MATIO_INCLUDE_DIR)
  add_library(lichtmc_matio UNKNOWN IMPORTED)
  set_target_properties(lichtmc_matio PROPERTIES IMPORTED_LOCATION ${LICHTMC_MATIO_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${LICHTMC_MATIO_INCLUDE_DIR})
endif()
# libwebp has a CMake package in neither release.
if(NOT TARGET lichtmc_webp)
  find_library(LICHTMC_WEBP_LIBRARY webp REQUIRED)
  find_path(LICHTMC_WEBP_INCLUDE_DIR webp/decode.h REQUIRED)
  mark_as_advanced(LICHTMC_WEBP_LIBRARY LICHTMC_WEBP_INCLUDE_DIR)
  add_library(lichtmc_webp UNKNOWN IMPORTED)
  set_target_properties(lichtmc_webp PROPERTIES IMPORTED_LOCATION ${LICHTMC_WEBP_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${LICHTMC_WEBP_INCLUDE_DIR})
endif()
# stb comes without a CMake package.
if(NOT TARGET stb::stb)
  find_library(LICHTMC_STB_LIBRARY stb REQUIRED)
  find_path(LICHTMC_STB_INCLUDE_DIR stb/stb_image.h REQUIRED)
  mark_as_advanced(LICHTMC_STB_LIBRARY LICHTMC_STB_INCLUDE_DIR)
  add_library(stb::stb UNKNOWN IMPORTED)
  set_target_properties(stb::stb PROPERTIES IMPORTED_LOCATION ${LICHTMC_STB_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${LICHTMC_STB_INCLUDE_DIR})
endif()
