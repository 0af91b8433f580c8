# cmake -D STEP=measure|quantities -D PROGRAM=... -D CHAPTER=... -D OUT=... [-D SOURCE=...] -P check.cmake
#
# `measure` is the fixture of a chapter's values: it succeeds as soon as they are on disk, or each of them would be "Not Run"
# because of one that is missed. What it said stands in OUT: a line a value, which the tests of the values look up, and complaints about
# missed quantities, for `quantities`. With SOURCE, figures are drawn
# too, and nothing is computed again that this very program, with its libraries, made of these very files of SOURCE:
# `make figures`, `make check` and `make test` share what stands in OUT.
cmake_minimum_required(VERSION 3.25)
set(values ${OUT}/results/${CHAPTER}/check.csv)
set(said ${OUT}/${CHAPTER}.values)
set(complaints ${OUT}/${CHAPTER}.txt)
set(stamp ${OUT}/${CHAPTER}.inputs)

if(STEP STREQUAL "measure")
  if(SOURCE)
    file(GLOB inputs ${SOURCE}/figures/style.gp ${SOURCE}/figures/templates/drawing.gp
         ${SOURCE}/figures/templates/${CHAPTER}-*.gp ${SOURCE}/tables/*.csv ${SOURCE}/tables/published/*.csv)
    execute_process(COMMAND ldd ${PROGRAM} OUTPUT_VARIABLE libraries COMMAND_ERROR_IS_FATAL ANY)
    string(REGEX MATCHALL "/[^ \n]+" libraries "${libraries}")
    set(digests "$ENV{NLMECH_INSTRUCTION_SET} $ENV{GLIBC_TUNABLES}\n")  # both change how results are rounded
    foreach(input IN LISTS PROGRAM libraries inputs)
      file(SHA256 ${input} digest)
      string(APPEND digests "${digest}\n")
    endforeach()
    set(known "")
    if(EXISTS ${stamp} AND EXISTS ${values} AND EXISTS ${said} AND EXISTS ${complaints})
      file(READ ${stamp} known)
    endif()
    if(known STREQUAL digests)
      return()
    endif()
    file(REMOVE_RECURSE ${OUT}/figures/${CHAPTER} ${OUT}/tables/${CHAPTER} ${OUT}/results/${CHAPTER})
    set(draw --draw)
  endif()
  file(REMOVE ${values} ${said} ${complaints} ${stamp})  # those of an earlier program must not pass for this one's
  file(MAKE_DIRECTORY ${OUT})
  execute_process(COMMAND ${PROGRAM} check ${draw} --out ${OUT} RESULT_VARIABLE code OUTPUT_FILE ${said} ERROR_VARIABLE errors)
  if(errors)
    message("${errors}")
  endif()
  if(NOT code MATCHES "^[01]$" OR NOT EXISTS ${values})
    message(FATAL_ERROR "${CHAPTER} check ended with '${code}' and left no values")
  endif()
  file(WRITE ${complaints} "${errors}")
  if(SOURCE AND code EQUAL 0)
    file(WRITE ${stamp} "${digests}")
  endif()
elseif(STEP STREQUAL "quantities")
  file(READ ${complaints} errors)
  if(errors MATCHES "(^|\n)FAILS ")
    message(FATAL_ERROR "${errors}")
  endif()
else()
  message(FATAL_ERROR "there is no step '${STEP}'")
endif()
