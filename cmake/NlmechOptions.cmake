# What is built, and how.

# The chapters in the order of the book. A chapter is built once its folder exists.
set(NLMECH_ALL_CHAPTERS homotopy geodesy gss_control two_body_series rbf_ivp rbf_inverse algebraic_series hermitian transversal integrators)
# Established libraries that chapters compare with, behind our interfaces.
set(NLMECH_ALL_PEERS geographiclib cvode arkode kinsol gsl odeint ipopt)

# Within another project (FetchContent, add_subdirectory) it is the library alone.
set(default_selection all)
if(NOT PROJECT_IS_TOP_LEVEL)
  set(default_selection none)
endif()
set(NLMECH_CHAPTERS ${default_selection} CACHE STRING "Chapters to build: all, none, or a list of ${NLMECH_ALL_CHAPTERS}")
set(NLMECH_PEERS ${default_selection} CACHE STRING "Peers to compare with: all, none, or a list of ${NLMECH_ALL_PEERS}")
option(NLMECH_TESTS "Build the tests" ${PROJECT_IS_TOP_LEVEL})
option(NLMECH_BOOK "Offer the target 'book'" ${PROJECT_IS_TOP_LEVEL})
option(NLMECH_WARNINGS_ARE_ERRORS "Development: every warning is an error" OFF)
option(NLMECH_UNITY "Compile some sources at a time: the headers that they share are read once" ON)
set(NLMECH_SANITIZE "" CACHE STRING "Sanitizers, as for -fsanitize: address,undefined")

# Turns "all" into the whole list, and refuses a name that is not in it.
function(nlmech_resolve_selection variable all)
  set(chosen "${${variable}}")
  string(REPLACE "," ";" chosen "${chosen}")
  if(chosen STREQUAL "all")
    set(chosen ${all})
  elseif(chosen STREQUAL "none")
    set(chosen "")
  endif()
  list(REMOVE_DUPLICATES chosen)
  foreach(name IN LISTS chosen)
    if(NOT name IN_LIST all)
      list(JOIN all ", " known)
      message(FATAL_ERROR "${variable}: there is no '${name}'; there is ${known}")
    endif()
  endforeach()
  set(${variable}_SELECTED "${chosen}" PARENT_SCOPE)
endfunction()
nlmech_resolve_selection(NLMECH_CHAPTERS "${NLMECH_ALL_CHAPTERS}")
nlmech_resolve_selection(NLMECH_PEERS "${NLMECH_ALL_PEERS}")

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()
# GCC's -O3, CMake's default, makes integrators faster and takes longer to compile: it is left to the library, and not given to
# programs and tests, which call it. Commands, files and drawings take no time: their code is small (-Os takes 0.56 of -O3's bytes).
# Whoever asks for another level has it everywhere.
set(NLMECH_LIBRARY_OPTIONS "")
set(NLMECH_SMALL_OPTIONS "")
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_FLAGS_RELEASE MATCHES "-O3")
  string(REPLACE "-O3" "-O2" CMAKE_CXX_FLAGS_RELEASE "${CMAKE_CXX_FLAGS_RELEASE}")
  set(NLMECH_LIBRARY_OPTIONS $<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU>>:-O3>)
  set(NLMECH_SMALL_OPTIONS $<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU>>:-Os>)
endif()
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_FIND_PACKAGE_TARGETS_GLOBAL ON)  # a library found by one component is known to all
