# Installs the build into a scratch prefix, and configures, builds and runs an outside program against it:
#   cmake -DBUILD_DIR=.. -DSOURCE_DIR=.. -DCONFIG=.. -DCXX_COMPILER=.. -DCXX_FLAGS=.. -P run.cmake
set(scratch ${BUILD_DIR}/package_test)
set(prefix ${scratch}/prefix)
file(REMOVE_RECURSE ${scratch})

function(run)
    execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY COMMAND_ECHO STDOUT)
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix})
run(${CMAKE_COMMAND} -G Ninja -S ${CMAKE_CURRENT_LIST_DIR} -B ${scratch}/build
    -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_BUILD_TYPE=${CONFIG}
    -DCMAKE_CXX_COMPILER=${CXX_COMPILER} -DCMAKE_CXX_FLAGS=${CXX_FLAGS})
run(${CMAKE_COMMAND} --build ${scratch}/build)
execute_process(COMMAND ${scratch}/build/consumer WORKING_DIRECTORY ${scratch} COMMAND_ERROR_IS_FATAL ANY COMMAND_ECHO STDOUT)

# A package that names the tree it was built in breaks once that tree is gone.
file(GLOB_RECURSE package_files ${prefix}/*.cmake)
if(NOT package_files)
    message(FATAL_ERROR "no CMake package was installed under ${prefix}")
endif()
foreach(package_file IN LISTS package_files)
    file(READ ${package_file} text)
    foreach(folder ${SOURCE_DIR} ${BUILD_DIR})
        string(FIND "${text}" "${folder}/" position)
        if(NOT position EQUAL -1)
            message(FATAL_ERROR "${package_file} names ${folder}, which is not there on the user's machine")
        endif()
    endforeach()
endforeach()
