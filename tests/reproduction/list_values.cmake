# cmake -D PROGRAM=reproduction -D SOURCE=... -D CHAPTERS=chapters.txt -D OUT=... -D LIST=values.cmake -P list_values.cmake
#
# Writes a test for each published value. Names hold blanks, semicolons, quotes, parentheses and number signs: everything goes
# through bracket arguments, and no name is ever put into a list.
cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND ${PROGRAM} tests RESULT_VARIABLE code OUTPUT_VARIABLE names)
if(NOT code EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} tests ended with '${code}'")
endif()
file(STRINGS ${CHAPTERS} built)
file(READ ${SOURCE}/tables/places.csv places)

# The chapter that owns a place: third column of the row that begins with "source,place,".
function(find_owner variable source place)
  string(FIND "${places}" "\n${source},${place}," at)
  if(at EQUAL -1)
    message(FATAL_ERROR "tables/places.csv does not list ${place} of ${source}")
  endif()
  string(SUBSTRING "${places}" ${at} 1000 row)
  string(REGEX REPLACE "^\n[^,]*,[^,]*,([^,]*),.*$" "\\1" chapter "${row}")
  set(${variable} "${chapter}" PARENT_SCOPE)
endfunction()

set(tests "")
while(names MATCHES "^([^\n]+)\n(.*)$")
  set(name "${CMAKE_MATCH_1}")
  set(names "${CMAKE_MATCH_2}")
  if(NOT name MATCHES "^([^/]+)/([^/]+)/")
    message(FATAL_ERROR "'${name}' is not of the form source/place/row/quantity")
  endif()
  find_owner(chapter "${CMAKE_MATCH_1}" "${CMAKE_MATCH_2}")
  set(fixture "")
  if(chapter IN_LIST built)
    set(fixture " FIXTURES_REQUIRED [==[check_${chapter}]==]")
  endif()
  string(APPEND tests
         "add_test([==[${name}]==] [==[${PROGRAM}]==] verdict [==[${name}]==] --chapters [==[${CHAPTERS}]==] --out [==[${OUT}]==])\n"
         "set_tests_properties([==[${name}]==] PROPERTIES LABELS reproduction SKIP_RETURN_CODE 77${fixture})\n")
endwhile()
file(WRITE ${LIST} "${tests}")
