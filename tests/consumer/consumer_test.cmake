# Installs into an empty folder, builds a project that finds the package there, with a program for each of its components, runs
# them, compiles some by pkg-config, and runs an installed program.
# Then the lines of README that install the library and build on it, as a reader would type them.
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})

function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE out WORKING_DIRECTORY ${WORK})
  if(NOT code EQUAL 0)
    list(JOIN ARGV " " command)
    message(FATAL_ERROR "${command}\nended with ${code}:\n${out}")
  endif()
endfunction()

set(flags "")
if(SANITIZE)
  set(flags -DCMAKE_CXX_FLAGS=-fsanitize=${SANITIZE})
  set(flags_typed -fsanitize=${SANITIZE})
  set(ENV{CXXFLAGS} -fsanitize=${SANITIZE})
endif()
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} -S ${PROJECT} -B ${WORK}/build-consumer -DCMAKE_PREFIX_PATH=${WORK}/prefix -DCMAKE_CXX_COMPILER=${COMPILER} ${flags})
run(${CMAKE_COMMAND} --build ${WORK}/build-consumer)
run(${WORK}/build-consumer/consumer)

file(GLOB_RECURSE config ${WORK}/prefix/lib*/nlmechConfig.cmake)
file(READ ${config} text)
string(REGEX MATCH "set.nlmech_COMPONENTS ([a-z_;]+)" line "${text}")
set(components ${CMAKE_MATCH_1})
list(JOIN components "," listed)
if(NOT listed MATCHES "geodesy")
  message(FATAL_ERROR "the package names no components: '${listed}'")
endif()
run(${CMAKE_COMMAND} -S ${COMPONENTS} -B ${WORK}/build-components -DCMAKE_PREFIX_PATH=${WORK}/prefix -DCMAKE_CXX_COMPILER=${COMPILER}
    -DCOMPONENTS=${listed} ${flags})
run(${CMAKE_COMMAND} --build ${WORK}/build-components --parallel 2)
foreach(component IN LISTS components)
  run(${WORK}/build-components/${component}/use_${component})
endforeach()

# The same without CMake: every component is known to pkg-config with all that it requires, and the programs of a few, of which
# one needs nothing, one libraries and one headers alone, are compiled by what it says.
file(GLOB pkgconfig ${WORK}/prefix/lib*/pkgconfig ${WORK}/prefix/lib/*/pkgconfig)
set(ENV{PKG_CONFIG_PATH} ${pkgconfig})
foreach(component IN LISTS components)
  run(pkg-config --print-errors --exists nlmech-${component})
  if(component MATCHES "^(geodesy|ivp|frames)$")
    run(sh -c "$0 ${flags_typed} -std=c++20 $1 $(pkg-config --cflags --libs nlmech-$2) -o typed_$2"
        ${COMPILER} ${COMPONENTS}/${component}.cpp ${component})
    run(${WORK}/typed_${component})
  endif()
endforeach()

if(EXISTS ${WORK}/build-consumer/pendulum)  # the floors for integration are part of this build
  run(${WORK}/build-consumer/pendulum)

  # README: its folder is WORK, its home too.
  file(CREATE_LINK ${BUILD} ${WORK}/build SYMBOLIC)
  file(CREATE_LINK ${SOURCE}/examples ${WORK}/examples SYMBOLIC)
  set(ENV{HOME} ${WORK})
  set(ENV{CXX} ${COMPILER})
  file(STRINGS ${SOURCE}/README.md lines REGEX "^(cmake |build-mine/)")
  foreach(line IN LISTS lines)
    run(sh -c "${line}")
  endforeach()
  file(STRINGS ${WORK}/build-mine/CMakeCache.txt build_type REGEX "^CMAKE_BUILD_TYPE:")
  if(NOT build_type MATCHES "=Release$")
    message(FATAL_ERROR "README's lines build without optimising: ${build_type}")
  endif()
  list(LENGTH lines typed)
  if(typed LESS 4)
    message(FATAL_ERROR "README does not say how to install the library and build on it")
  endif()
endif()

# An installed program reads templates and published values from the installation, not from the source tree.
foreach(chapter IN LISTS CHAPTERS)
  if(chapter STREQUAL geodesy)
    run(${WORK}/prefix/bin/geodesy run fig-2.27 --quick --out ${WORK}/out)
    if(NOT EXISTS ${WORK}/out/figures/geodesy/fig-2.27.svg)
      message(FATAL_ERROR "the installed program drew nothing")
    endif()
    run(${WORK}/prefix/bin/geodesy check --quick --out ${WORK}/out)
  endif()
endforeach()
