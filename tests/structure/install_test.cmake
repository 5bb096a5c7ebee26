# Installs the build into a folder of its own, builds the program in consumer/ against it and runs that.
# Called with -DBUILD=<build folder> -DSOURCE=<this folder> -DGENERATOR=<generator>
set(prefix ${BUILD}/tests/structure/installed)
set(consumer ${BUILD}/tests/structure/consumer)
file(REMOVE_RECURSE ${prefix} ${consumer})
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGV}\n${output}")
  endif()
endfunction()
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
run(${prefix}/bin/conchoid --version)
run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${SOURCE}/consumer -B ${consumer} -DCMAKE_PREFIX_PATH=${prefix}
    -DCMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build ${consumer})
run(${consumer}/consumer)
