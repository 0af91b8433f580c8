# Sources that are compiled for one instruction set each and chosen at run time. The rest of the library stays portable.
#   nlmech_kernel_flags(BASELINE a.cpp AVX2 b.cpp AVX512 c.cpp)
# Contraction is off: multiply-adds are written out, so that all widths round alike. -fno-math-errno and
# -fno-trapping-math change no result; the scheduler options let GCC interleave the long dependency chains.
function(nlmech_kernel_flags)
  cmake_parse_arguments(arg "" "" "BASELINE;AVX2;AVX512" ${ARGN})
  set(common -O3 -fno-math-errno -fno-trapping-math -ffp-contract=off)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    list(APPEND common -fschedule-insns -fsched-pressure)
  endif()
  # A precompiled header is made for one set of options.
  set_property(SOURCE ${arg_BASELINE} ${arg_AVX2} ${arg_AVX512} PROPERTY SKIP_PRECOMPILE_HEADERS ON)
  set_property(SOURCE ${arg_BASELINE} APPEND PROPERTY COMPILE_OPTIONS ${common})
  set_property(SOURCE ${arg_AVX2} APPEND PROPERTY COMPILE_OPTIONS ${common} -mavx2 -mfma)
  set_property(SOURCE ${arg_AVX512} APPEND PROPERTY COMPILE_OPTIONS ${common} -mavx512f -mavx512dq -mavx512vl -mfma
                                                                   -mprefer-vector-width=512)
endfunction()
