# Installs into an empty folder, builds a project that finds the package there, runs it, and runs an installed program.
file(REMOVE_RECURSE ${WORK})

function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(NOT code EQUAL 0)
    list(JOIN ARGV " " command)
    message(FATAL_ERROR "${command}\nended with ${code}:\n${out}")
  endif()
endfunction()

set(flags "")
if(SANITIZE)
  set(flags -DCMAKE_CXX_FLAGS=-fsanitize=${SANITIZE})
endif()
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} -S ${PROJECT} -B ${WORK}/build -DCMAKE_PREFIX_PATH=${WORK}/prefix -DCMAKE_CXX_COMPILER=${COMPILER} ${flags})
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/consumer)
if(EXISTS ${WORK}/build/pendulum)  # the floors for integration are part of this build
  run(${WORK}/build/pendulum)
endif()

# An installed program reads templates and published values from the installation, not from the source tree.
run(${WORK}/prefix/bin/geodesy run fig-2.27 --quick --out ${WORK}/out)
if(NOT EXISTS ${WORK}/out/figures/geodesy/fig-2.27.svg)
  message(FATAL_ERROR "the installed program drew nothing")
endif()
run(${WORK}/prefix/bin/geodesy check --quick --out ${WORK}/out)
