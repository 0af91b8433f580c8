# The book: pages, API reference and evidence as HTML that works from the file system (`make book`).
#
#   include(NlmechBook)
#   nlmech_add_book()
#
# reads these variables, if they are set:
#   NLMECH_BOOK      ON unless it is set: there is a target `book`. It is never part of `all`.
#   NLMECH_CHAPTERS  chapters of this build, in reading order; each has chapters/<name>/<name>.md
#   NLMECH_OUT       folder with the generated figures/, tables/, results/; default: the top of the source tree
# and takes these arguments, all optional:
#   CHAPTERS names...   instead of NLMECH_CHAPTERS
#   OUT folder          instead of NLMECH_OUT
#   DEPENDS targets...  built before, such as one that draws the figures
#
# The book is written to <build>/book/html/index.html. What else it needs (Doxygen, its style sheet, MathJax) is
# looked for when the target is built: a machine without them, or without Python, configures and builds everything else.
include_guard(GLOBAL)

set(_nlmech_book_scripts "${CMAKE_CURRENT_LIST_DIR}/../scripts/book")

function(nlmech_add_book)
  cmake_parse_arguments(PARSE_ARGV 0 book "" "OUT" "CHAPTERS;DEPENDS")
  if(book_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "nlmech_add_book: unknown argument '${book_UNPARSED_ARGUMENTS}'")
  endif()
  if(DEFINED NLMECH_BOOK AND NOT NLMECH_BOOK)
    return()
  endif()
  if(NOT book_CHAPTERS)
    set(book_CHAPTERS ${NLMECH_CHAPTERS})
  endif()
  if(NOT book_OUT)
    set(book_OUT "${NLMECH_OUT}")
  endif()
  if(NOT book_OUT)
    set(book_OUT "${PROJECT_SOURCE_DIR}")
  endif()
  get_filename_component(book_OUT "${book_OUT}" ABSOLUTE BASE_DIR "${PROJECT_SOURCE_DIR}")

  set(folder "${PROJECT_BINARY_DIR}/book")
  find_package(Python3 3.9 QUIET COMPONENTS Interpreter)
  if(NOT Python3_Interpreter_FOUND)
    add_custom_target(book
      COMMAND "${CMAKE_COMMAND}" -E echo "The book needs Python 3.9 or later. On Debian: apt-get install python3"
      COMMAND "${CMAKE_COMMAND}" -E false
      VERBATIM)
    return()
  endif()

  # The dependency file names what the last build read. The globs add what it cannot know: files that are new
  # since.
  get_filename_component(scripts "${_nlmech_book_scripts}" ABSOLUTE)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/common/nlmech/*.hpp" "${scripts}/*.py" "${scripts}/*.sed")
  file(GLOB texts CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/docs/*")
  list(FILTER texts EXCLUDE REGEX "/(gallery|chapters)$")
  add_custom_command(
    OUTPUT "${folder}/book.stamp"
    COMMAND "${Python3_EXECUTABLE}" -B "${scripts}"
            "${PROJECT_SOURCE_DIR}" "${PROJECT_BINARY_DIR}" "${book_OUT}" "${PROJECT_VERSION}" ${book_CHAPTERS}
    DEPENDS ${sources} ${texts} ${book_DEPENDS}
    DEPFILE "${folder}/book.d"
    COMMENT "Book: ${folder}/html/index.html"
    VERBATIM)
  add_custom_target(book DEPENDS "${folder}/book.stamp")
  if(book_DEPENDS)
    add_dependencies(book ${book_DEPENDS})
  endif()
  if(NLMECH_TESTS OR BUILD_TESTING)
    # Pages that forges show are what their maker makes of what the chapters' checks left on disk.
    foreach(chapter IN LISTS book_CHAPTERS)
      add_test(NAME pages/${chapter} COMMAND "${Python3_EXECUTABLE}" -B "${scripts}/forge.py" check "${PROJECT_SOURCE_DIR}"
                                             "${PROJECT_BINARY_DIR}/check" ${chapter})
      set_tests_properties(pages/${chapter} PROPERTIES LABELS reproduction FIXTURES_REQUIRED check_${chapter})
    endforeach()
    # The page on choosing a method shows numbers of several; it is checked with them all.
    list(TRANSFORM book_CHAPTERS PREPEND check_ OUTPUT_VARIABLE checks)
    add_test(NAME pages/choosing COMMAND "${Python3_EXECUTABLE}" -B "${scripts}/forge.py" check "${PROJECT_SOURCE_DIR}"
                                         "${PROJECT_BINARY_DIR}/check" ${book_CHAPTERS})
    set_tests_properties(pages/choosing PROPERTIES LABELS reproduction FIXTURES_REQUIRED "${checks}")
  endif()
endfunction()
