# Components, chapters and the facts that tests and programs need to know about the build.
include(CheckLinkerFlag)
include(GNUInstallDirs)

add_library(nlmech_options INTERFACE)
target_compile_options(nlmech_options INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow
                                                $<$<BOOL:${NLMECH_WARNINGS_ARE_ERRORS}>:-Werror>
                                                # A guess of the optimiser, often wrong inside Boost's headers: shown, no error.
                                                $<$<CXX_COMPILER_ID:GNU>:-Wno-error=maybe-uninitialized>
                                                # GCC 12 sees overlaps and overruns in "x" + std::string that are none (its bug 105651).
                                                $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict -Wno-error=array-bounds>
                                                # Clang asks for a pair of braces about each array inside an aggregate.
                                                $<$<CXX_COMPILER_ID:Clang>:-Wno-missing-braces>
                                                # GCC's garbage collector takes a seventh of the time where it begins at 128 MB.
                                                # Clang's tools, which read the preset dev, do not know the option.
                                                $<$<AND:$<BOOL:${NLMECH_UNITY}>,$<CXX_COMPILER_ID:GNU>>:--param=ggc-min-heapsize=524288>)
# Sources are compiled some at a time: the linker leaves out what a program does not use of them, and the names of the rest, which
# take a sixth of it.
target_compile_options(nlmech_options INTERFACE $<$<CONFIG:Release>:-ffunction-sections -fdata-sections>)
target_link_options(nlmech_options INTERFACE $<$<CONFIG:Release>:LINKER:--gc-sections,--strip-all>)
# Addresses that the loader adjusts take a sixtieth of a program, as a bitmap nothing (binutils 2.38 and glibc 2.36).
check_linker_flag(CXX LINKER:-z,pack-relative-relocs NLMECH_LINKER_PACKS_RELOCATIONS)
if(NLMECH_LINKER_PACKS_RELOCATIONS)
  target_link_options(nlmech_options INTERFACE $<$<CONFIG:Release>:LINKER:-z,pack-relative-relocs>)
endif()
if(NLMECH_SANITIZE)
  # Null pointers the address sanitizer stops at too, and Eigen asserts the alignment that it needs; checking both at every
  # access of a reference doubles the time to compile.
  target_compile_options(nlmech_options INTERFACE -fsanitize=${NLMECH_SANITIZE} -fno-sanitize-recover=all
                                                  -fno-sanitize=null,alignment -fno-omit-frame-pointer)
  target_link_options(nlmech_options INTERFACE -fsanitize=${NLMECH_SANITIZE})
endif()

# A component of the library: the folder common/nlmech/<name>, target nlmech::<name>.
#   nlmech_component(geodesy SOURCES a.cpp b.cpp USES support LINKS fmt::fmt)
# USES are the components that it may include; a test holds the sources to that. INTERNAL ones are not installed.
function(nlmech_component name)
  cmake_parse_arguments(arg "INTERNAL" "" "SOURCES;USES;LINKS" ${ARGN})
  add_library(nlmech_${name} STATIC ${arg_SOURCES})
  add_library(nlmech::${name} ALIAS nlmech_${name})
  set_target_properties(nlmech_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON
                                                   UNITY_BUILD ${NLMECH_UNITY} UNITY_BUILD_BATCH_SIZE 8)
  target_include_directories(nlmech_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/common>
                                                   $<INSTALL_INTERFACE:include>)
  list(TRANSFORM arg_USES PREPEND nlmech::)
  target_link_libraries(nlmech_${name} PUBLIC ${arg_USES} PRIVATE ${arg_LINKS} $<BUILD_INTERFACE:nlmech_options>)
  target_compile_options(nlmech_${name} PRIVATE ${NLMECH_LIBRARY_OPTIONS})
  target_compile_features(nlmech_${name} PUBLIC cxx_std_20)
  list(TRANSFORM arg_USES REPLACE "nlmech::" "")
  list(JOIN arg_USES " " uses)
  set_property(GLOBAL APPEND PROPERTY NLMECH_COMPONENTS "${name}: ${uses}")
  if(NOT arg_INTERNAL)
    install(TARGETS nlmech_${name} EXPORT nlmech)
    set_property(GLOBAL APPEND PROPERTY NLMECH_INSTALLED ${name})
    install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/nlmech/${name}
            FILES_MATCHING PATTERN "*.hpp" PATTERN "kernels" EXCLUDE PATTERN "assembler.hpp" EXCLUDE)
  endif()
endfunction()

# A program that is installed, with its manual page and its completions for bash, which it writes itself.
function(nlmech_install_program name)
  install(TARGETS ${name})
  if(CMAKE_CROSSCOMPILING)
    return()
  endif()
  set(manual ${PROJECT_BINARY_DIR}/generated/man1/${name}.1)
  set(completions ${PROJECT_BINARY_DIR}/generated/completions/${name})
  add_custom_command(TARGET ${name} POST_BUILD VERBATIM
                     COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:${name}> -D MANUAL=${manual} -D COMPLETIONS=${completions}
                             -P ${PROJECT_SOURCE_DIR}/cmake/WriteManual.cmake)
  install(FILES ${manual} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
  install(FILES ${completions} DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
endfunction()

# A chapter: library nlmech_chapter_<name> with its scenes, and the program build/bin/<name>.
#   nlmech_chapter(geodesy SOURCES scenes.cpp USES geodesy)
function(nlmech_chapter name)
  cmake_parse_arguments(arg "" "TITLE" "SCENES;SOURCES;USES" ${ARGN})
  list(TRANSFORM arg_USES PREPEND nlmech::)
  set(main main.cpp)
  if(arg_SCENES)  # each, "orders" or "stability/extremes", is a file with a namespace of its name; the chapter is their list
    set(generated ${PROJECT_BINARY_DIR}/generated/chapters/${name})
    set(declarations "")
    list(TRANSFORM arg_SCENES REPLACE "^.*/" "" OUTPUT_VARIABLE calls)
    foreach(scene IN LISTS calls)
      string(APPEND declarations "namespace ${scene} {\nstd::vector<scene::Scene> scenes();\n}\n")
    endforeach()
    list(TRANSFORM calls APPEND "::scenes()")
    list(JOIN calls ", " calls)
    set(title "${arg_TITLE}")
    set(commands "void commands(scene::Commands& all);  // the user's own numbers\n")
    if(NOT "${arg_SOURCES}" MATCHES "commands\\.cpp")
      set(commands "static void commands(scene::Commands& /*all*/) {}\n")
    endif()
    configure_file(${PROJECT_SOURCE_DIR}/cmake/chapter.cpp.in ${generated}/chapter.cpp @ONLY)
    configure_file(${PROJECT_SOURCE_DIR}/cmake/main.cpp.in ${generated}/main.cpp @ONLY)
    list(TRANSFORM arg_SCENES APPEND .cpp OUTPUT_VARIABLE sources)
    list(APPEND arg_SOURCES ${generated}/chapter.cpp)
    # Scenes have namespaces of their own and are compiled some at a time; all else is compiled by itself.
    set_source_files_properties(${arg_SOURCES} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    list(APPEND arg_SOURCES ${sources})
    set(main ${generated}/main.cpp)
  endif()
  add_library(nlmech_chapter_${name} STATIC ${arg_SOURCES})
  set_target_properties(nlmech_chapter_${name} PROPERTIES UNITY_BUILD ${NLMECH_UNITY} UNITY_BUILD_BATCH_SIZE 4)
  target_include_directories(nlmech_chapter_${name} PUBLIC ${PROJECT_SOURCE_DIR})
  target_link_libraries(nlmech_chapter_${name} PUBLIC nlmech::scene ${arg_USES} PRIVATE nlmech_options)
  nlmech_read_precompiled(nlmech_chapter_${name} chapter_headers)
  add_executable(${name} ${main})
  target_link_libraries(${name} PRIVATE nlmech_chapter_${name} nlmech_options)
  nlmech_install_program(${name})
endfunction()

# Written at the end of the configuration, when all is known: one fact a line, for Makefile, tests and book.
function(nlmech_write_build_facts)
  get_property(components GLOBAL PROPERTY NLMECH_COMPONENTS)
  list(JOIN components "\n" components)
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/components.txt CONTENT "${components}\n" @ONLY)
  list(JOIN NLMECH_CHAPTERS_SELECTED "\n" chapters)
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/chapters.txt CONTENT "${chapters}\n" @ONLY)
  set(stands "")  # which components each chapter links, for the map of the book
  foreach(chapter IN LISTS NLMECH_CHAPTERS_SELECTED)
    get_target_property(links nlmech_chapter_${chapter} LINK_LIBRARIES)
    list(FILTER links INCLUDE REGEX "^nlmech(::|_peer_)")
    list(TRANSFORM links REPLACE "^nlmech(::peer_|_peer_).*$" peers)
    list(TRANSFORM links REPLACE "^nlmech::" "")
    list(REMOVE_DUPLICATES links)
    list(JOIN links " " links)
    string(APPEND stands "${chapter}: ${links}\n")
  endforeach()
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/chapter_uses.txt CONTENT "${stands}" @ONLY)
  get_property(libraries GLOBAL PROPERTY NLMECH_LIBRARIES)
  list(SORT libraries)
  list(REMOVE_DUPLICATES libraries)
  list(JOIN libraries "\n" libraries)
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/libraries.txt CONTENT "${libraries}\n" @ONLY)
endfunction()

# A program that measures claims about speed. Built by the target `benchmarks`, never by `all`; Google Benchmark is looked
# for at that moment of need, so that a machine without it builds everything else.
function(nlmech_bench name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINKS" ${ARGN})
  if(NOT TARGET benchmarks)
    add_custom_target(benchmarks)
  endif()
  find_package(benchmark QUIET)
  if(benchmark_FOUND)
    add_executable(${name} EXCLUDE_FROM_ALL ${arg_SOURCES})
    target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
    target_link_libraries(${name} PRIVATE ${arg_LINKS} benchmark::benchmark nlmech_options)
    target_compile_options(${name} PRIVATE ${NLMECH_LIBRARY_OPTIONS})
    add_dependencies(benchmarks ${name})
  else()
    add_custom_target(${name} COMMAND ${CMAKE_COMMAND} -E echo "Google Benchmark was not found: apt-get install libbenchmark-dev"
                              COMMAND ${CMAKE_COMMAND} -E false)
    add_dependencies(benchmarks ${name})
  endif()
endfunction()
