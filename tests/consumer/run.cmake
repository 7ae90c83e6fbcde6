# Installs the built tree (BUILD) to a fresh prefix below WORK, builds this project against it and runs it.
# cmake -DBUILD=... -DWORK=... -DGENERATOR=... -DCOMPILER=... -P run.cmake
function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${WORK}/build -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${COMPILER}
    -DCMAKE_PREFIX_PATH=${WORK}/prefix -DCMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/engine)
run(${WORK}/build/headers)
execute_process(COMMAND ${WORK}/build/consumer RESULT_VARIABLE result)
if(result EQUAL 77)
  message("skipped: no GL context")
elseif(NOT result EQUAL 0)
  message(FATAL_ERROR "the consumer exits with ${result}")
endif()
