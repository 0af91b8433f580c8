# cmake -D STEP=measure|quantities -D PROGRAM=... -D CHAPTER=... -D OUT=... -P check.cmake
#
# `measure` is the fixture of a chapter's values: it succeeds as soon as they are on disk, or each of them would be "Not Run"
# because of one that is missed. What was said about missed quantities is kept for `quantities`.
cmake_minimum_required(VERSION 3.25)
set(values ${OUT}/results/${CHAPTER}/check.csv)
set(complaints ${OUT}/${CHAPTER}.txt)

if(STEP STREQUAL "measure")
  file(REMOVE ${values} ${complaints})  # those of an earlier program must not pass for this one's
  file(MAKE_DIRECTORY ${OUT})
  execute_process(COMMAND ${PROGRAM} check --out ${OUT} RESULT_VARIABLE code OUTPUT_QUIET ERROR_VARIABLE errors)
  message("${errors}")
  if(NOT code MATCHES "^[01]$" OR NOT EXISTS ${values})
    message(FATAL_ERROR "${CHAPTER} check ended with '${code}' and left no values")
  endif()
  file(WRITE ${complaints} "${errors}")
elseif(STEP STREQUAL "quantities")
  file(READ ${complaints} errors)
  if(errors MATCHES "(^|\n)FAILS ")
    message(FATAL_ERROR "${errors}")
  endif()
else()
  message(FATAL_ERROR "there is no step '${STEP}'")
endif()
