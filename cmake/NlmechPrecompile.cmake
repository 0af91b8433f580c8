# Headers that most sources of a kind include, read once a build instead of once a file. Each source still includes what it
# uses: the preset dev, by which clang-tidy reads the sources, builds without these (CMAKE_DISABLE_PRECOMPILE_HEADERS).
#   nlmech_precompiled(test_headers HEADERS <gtest/gtest.h> LINKS GTest::gtest)   makes them
#   nlmech_read_precompiled(unit_ivp test_headers)                                lets a target read them
function(nlmech_precompiled name)
  cmake_parse_arguments(arg "" "" "HEADERS;LINKS;OPTIONS" ${ARGN})
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp CONTENT "" @ONLY)
  add_library(nlmech_${name} OBJECT EXCLUDE_FROM_ALL ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  target_link_libraries(nlmech_${name} PRIVATE ${arg_LINKS} nlmech_options)
  target_compile_options(nlmech_${name} PRIVATE ${arg_OPTIONS})
  target_precompile_headers(nlmech_${name} PRIVATE ${arg_HEADERS})
endfunction()

function(nlmech_read_precompiled target name)
  target_precompile_headers(${target} REUSE_FROM nlmech_${name})
  target_link_libraries(${target} PRIVATE nlmech::support)  # has the instances of templates that they declare
  # Eigen silences this one by a pragma, which the precompiled form forgets.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-ignored-attributes>)
endfunction()
