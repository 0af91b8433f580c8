# Libraries are looked for where something selected needs them, and only there.
#
#   nlmech_require(fmt fmt libfmt-dev)               find_package(fmt), by name, Debian package
#   nlmech_require_pkg(geographiclib libgeographiclib-dev)   by pkg-config: imported target PkgConfig::geographiclib
#   nlmech_require_program(pytest-3 python3-pytest)  the program's path in the variable ${pytest-3}
#
# Each found library's version goes into the provenance of every scene.

function(nlmech_note_library name version)
  set_property(GLOBAL APPEND PROPERTY NLMECH_LIBRARIES "${name} ${version}")
endfunction()

macro(nlmech_require name package debian)
  find_package(${package} QUIET ${ARGN})
  if(NOT ${package}_FOUND)
    message(FATAL_ERROR "${name} was not found. On Debian: apt-get install ${debian}")
  endif()
  nlmech_note_library(${name} "${${package}_VERSION}")
endmacro()

macro(nlmech_require_pkg name debian)
  find_package(PkgConfig QUIET)
  if(NOT PkgConfig_FOUND)
    message(FATAL_ERROR "pkg-config was not found. On Debian: apt-get install pkg-config")
  endif()
  pkg_check_modules(${name} QUIET IMPORTED_TARGET GLOBAL ${name})
  if(NOT ${name}_FOUND)
    message(FATAL_ERROR "${name} was not found. On Debian: apt-get install ${debian}")
  endif()
  nlmech_note_library(${name} "${${name}_VERSION}")
endmacro()

macro(nlmech_require_program name debian)
  find_program(${name} ${name})
  if(NOT ${name})
    message(FATAL_ERROR "${name} was not found. On Debian: apt-get install ${debian}")
  endif()
endmacro()

# Real numbers of many digits, nlmech/support/extended_real.hpp, by the target nlmech_extended: chapters and tests.
macro(nlmech_extended_precision)
  nlmech_require(Boost Boost libboost-dev)
  nlmech_require_pkg(mpfr libmpfr-dev)
  if(NOT TARGET nlmech_extended)
    add_library(nlmech_extended INTERFACE)
    target_link_libraries(nlmech_extended INTERFACE Boost::headers PkgConfig::mpfr)
    # GCC 12 sees an overrun where Boost prints them that is none.
    target_compile_options(nlmech_extended INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-error=stringop-overflow>)
  endif()
endmacro()
