# Builds the book: cmake -DBOOK_SETTINGS=<build>/book/settings.cmake -P build.cmake
#
# Steps: look for the tools; turn the pages into what Doxygen reads; run Doxygen, where any warning is a
# failure; copy what the pages need from MathJax. All complaints are shown, each with its file and line,
# before it stops.
cmake_minimum_required(VERSION 3.25)
include("${BOOK_SETTINGS}")
include("${CMAKE_CURRENT_LIST_DIR}/page.cmake")
include("${CMAKE_CURRENT_LIST_DIR}/components.cmake")

# 1. The tools, all of them, so that one visit to the package manager is enough.
set(packages "")
find_program(DOXYGEN doxygen)
if(NOT DOXYGEN)
  list(APPEND packages doxygen)
endif()
find_path(BOOK_AWESOME doxygen-awesome.css
          PATHS /usr/share/doxygen-awesome-css /usr/local/share/doxygen-awesome-css NO_DEFAULT_PATH)
if(NOT BOOK_AWESOME)
  list(APPEND packages doxygen-awesome-css)
endif()
find_path(BOOK_MATHJAX jax/output/SVG/fonts/TeX/fontdata.js
          PATHS /usr/share/javascript/mathjax /usr/local/share/javascript/mathjax NO_DEFAULT_PATH)
if(NOT BOOK_MATHJAX)
  list(APPEND packages libjs-mathjax)
endif()
if(packages)
  list(JOIN packages " " packages)
  message(FATAL_ERROR "The book needs Debian packages that are not installed: apt install ${packages}")
endif()

file(REMOVE "${BOOK_FOLDER}/book.stamp")  # a failure must not pass for a finished book
file(REMOVE_RECURSE "${BOOK_FOLDER}/html" "${BOOK_FOLDER}/pages")
file(MAKE_DIRECTORY "${BOOK_FOLDER}/html" "${BOOK_FOLDER}/pages")

# 2. The pages. Those of evidence come after the chapters, because they link to figures that these show; the start page
# comes last, because it shows the titles and first paragraphs of the others.
book_load_references("${BOOK_SOURCE_DIR}/docs/references.bib")
book_reads("${BOOK_SOURCE_DIR}/docs/references.bib")
set(page_labels "docs/glossary.md|glossary" "docs/architecture.md|architecture")
foreach(chapter IN LISTS BOOK_CHAPTERS)
  list(APPEND page_labels "chapters/${chapter}/${chapter}.md|chapter_${chapter}")
endforeach()
list(APPEND page_labels "tables/REPRODUCTION.md|reproduction" "tables/COMPLETENESS.md|completeness"
     "tables/CLAIMS.md|claims" "tables/ERRATA.md|errata" "tables/BENCH.md|bench" "tables/RATIOS.md|ratios"
     "tables/ADVERSARY.md|adversary" "docs/index.md|mainpage")
foreach(pair IN LISTS page_labels)
  string(REGEX REPLACE "[|].*$" "" source "${pair}")
  string(REGEX REPLACE "^.*[|]" "" label "${pair}")
  set_property(GLOBAL PROPERTY "label|${source}" "${label}")
endforeach()
foreach(pair IN LISTS page_labels)
  string(REGEX REPLACE "[|].*$" "" source "${pair}")
  string(REGEX REPLACE "^.*[|]" "" label "${pair}")
  if(EXISTS "${BOOK_SOURCE_DIR}/${source}")
    book_page("${source}" "${BOOK_FOLDER}/pages/${source}" "${label}")
  else()
    set(advice "")
    if(source MATCHES "^tables/(REPRODUCTION|COMPLETENESS|CLAIMS|ERRATA)")
      set(advice "; `make check` writes it")
    endif()
    book_complain("${source}" 1 "this page of the book does not exist${advice}")
  endif()
endforeach()
book_list_works(works TRUE all)
file(WRITE "${BOOK_FOLDER}/pages/docs/references.md" "# Bibliography {#references}\n\n${works}\n")
book_components("${BOOK_FOLDER}/pages/docs/components.dox")

get_property(complaints GLOBAL PROPERTY complaints)
if(complaints)
  list(LENGTH complaints count)
  message(FATAL_ERROR "The book was not built. Errors in its pages, listed above: ${count}")
endif()

# 3. Doxygen. Paths in its warnings are those of the source tree.
book_chapter_tabs(BOOK_CHAPTER_TABS)
configure_file("${BOOK_SOURCE_DIR}/docs/layout.xml" "${BOOK_FOLDER}/layout.xml" @ONLY)
configure_file("${BOOK_SOURCE_DIR}/docs/Doxyfile.in" "${BOOK_FOLDER}/Doxyfile" @ONLY)
execute_process(COMMAND "${DOXYGEN}" "${BOOK_FOLDER}/Doxyfile" WORKING_DIRECTORY "${BOOK_SOURCE_DIR}"
                RESULT_VARIABLE result OUTPUT_QUIET)
set(warnings "")
if(EXISTS "${BOOK_FOLDER}/warnings.txt")
  file(READ "${BOOK_FOLDER}/warnings.txt" warnings)
  string(REPLACE "${BOOK_FOLDER}/pages/" "" warnings "${warnings}")
  string(REPLACE "${BOOK_SOURCE_DIR}/" "" warnings "${warnings}")
endif()
if(NOT result EQUAL 0 OR NOT warnings STREQUAL "")
  message("${warnings}")
  message(FATAL_ERROR "The book was not built. Doxygen's warnings, listed above, count as errors (${result}).")
endif()

file(READ "${BOOK_FOLDER}/html/index.html" start)
string(REPLACE "<title>nlmech - nlmech</title>" "<title>nlmech</title>" start "${start}")
file(WRITE "${BOOK_FOLDER}/html/index.html" "${start}")

# 4. MathJax, only what TeX input and SVG output load. No web fonts: some browsers refuse them to local pages.
set(mathjax "${BOOK_FOLDER}/html/mathjax")
file(COPY "${BOOK_MATHJAX}/MathJax.js" DESTINATION "${mathjax}")
file(COPY "${BOOK_MATHJAX}/jax/input/TeX" DESTINATION "${mathjax}/jax/input")
file(COPY "${BOOK_MATHJAX}/jax/element/mml" DESTINATION "${mathjax}/jax/element")
file(COPY "${BOOK_MATHJAX}/jax/output/SVG" DESTINATION "${mathjax}/jax/output" REGEX "/SVG/fonts/" EXCLUDE)
file(COPY "${BOOK_MATHJAX}/jax/output/SVG/fonts/TeX" DESTINATION "${mathjax}/jax/output/SVG/fonts")
file(COPY "${BOOK_MATHJAX}/extensions/TeX" DESTINATION "${mathjax}/extensions" REGEX "mhchem" EXCLUDE)
foreach(extension tex2jax MathEvents AssistiveMML toMathML)
  file(COPY "${BOOK_MATHJAX}/extensions/${extension}.js" DESTINATION "${mathjax}/extensions")
endforeach()

# Pages without formulas, most of the API reference, need not wait for it.
file(GLOB pages "${BOOK_FOLDER}/html/*.html")
foreach(page IN LISTS pages)
  file(READ "${page}" text)
  string(FIND "${text}" "\\(" inline)
  string(FIND "${text}" "\\[" display)
  if(inline EQUAL -1 AND display EQUAL -1)
    string(REGEX REPLACE "<script[^>]*src=\"mathjax/MathJax.js\"></script>\n" "" text "${text}")
    file(WRITE "${page}" "${text}")
  endif()
endforeach()

# 5. What the book was made from, for the next build.
get_property(reads GLOBAL PROPERTY reads)
list(REMOVE_DUPLICATES reads)
list(PREPEND reads "${BOOK_FOLDER}/book.stamp")
string(REPLACE " " "\\ " reads "${reads}")
list(POP_FRONT reads stamp)
list(JOIN reads " \\\n  " reads)
file(WRITE "${BOOK_FOLDER}/book.d" "${stamp}: ${reads}\n")
file(TOUCH "${BOOK_FOLDER}/book.stamp")
