# Code compiled for AVX2 or AVX-512 must not define a name that another file may define too: the linker would keep one
# of the two, and a processor without these instructions could be handed it. Every weak function of such an object file
# must therefore name the instruction set's own type.
#   cmake -DNM=nm -DOBJECTS=a.o;b.o -DPEER_OBJECTS=c.o -P kernel_symbols.cmake
set(avx2_mark Avx2)
set(avx512_mark Avx512)
set(checked 0)
foreach(object IN LISTS OBJECTS PEER_OBJECTS)
  if(NOT object MATCHES "(avx2|avx512)\\.cpp")
    continue()
  endif()
  set(mark ${${CMAKE_MATCH_1}_mark})
  execute_process(COMMAND ${NM} --demangle ${object} OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^\n]* W [^\n]*" weak "${symbols}")
  foreach(symbol IN LISTS weak)
    if(NOT symbol MATCHES "${mark}")
      message(SEND_ERROR "${object} defines a symbol that may be merged with the baseline's:\n  ${symbol}")
    endif()
  endforeach()
  math(EXPR checked "${checked} + 1")
endforeach()
if(checked EQUAL 0)
  message(STATUS "no object file with AVX instructions in this build")
endif()
