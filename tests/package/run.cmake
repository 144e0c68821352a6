# Installs the build into a scratch prefix, and configures, builds and runs the programs of this folder against it:
#   cmake -DBUILD_DIR=.. -DSOURCE_DIR=.. -DCONFIG=.. -DCXX_COMPILER=.. -DCXX_FLAGS=.. -P run.cmake
cmake_minimum_required(VERSION 3.25)
set(scratch ${BUILD_DIR}/package_test)
set(prefix ${scratch}/prefix)
file(REMOVE_RECURSE ${scratch})

function(run)
    execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY COMMAND_ECHO STDOUT)
endfunction()

# run_and_read(OUT PROGRAM ARGUMENT...): what it printed, and nothing on stderr.
function(run_and_read out)
    execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${scratch} COMMAND_ECHO STDOUT
        OUTPUT_VARIABLE printed ERROR_VARIABLE complaint RESULT_VARIABLE code)
    message(STATUS "${printed}${complaint}")
    if(NOT code EQUAL 0 OR NOT complaint STREQUAL "")
        message(FATAL_ERROR "${ARGN}: exit code ${code}, stderr '${complaint}'")
    endif()
    set(${out} "${printed}" PARENT_SCOPE)
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix})
run(${CMAKE_COMMAND} -G Ninja -S ${CMAKE_CURRENT_LIST_DIR} -B ${scratch}/build
    -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_BUILD_TYPE=${CONFIG}
    -DCMAKE_CXX_COMPILER=${CXX_COMPILER} "-DCMAKE_CXX_FLAGS=${CXX_FLAGS} -Wall -Wextra -Werror -Wno-missing-field-initializers")
run(${CMAKE_COMMAND} --build ${scratch}/build)

# --- a mesh from a file: a cube of one meter is dropped from 0.4 m, and falls 10 steps, a few millimeters ------------------

file(WRITE ${scratch}/cube.obj "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n")
run_and_read(center ${scratch}/build/center_of_mass cube.obj)
if(NOT center MATCHES "^[-0-9.e]+ ([0-9.]+) [-0-9.e]+\n$" OR CMAKE_MATCH_1 LESS 0.895 OR NOT CMAKE_MATCH_1 LESS 0.9)
    message(FATAL_ERROR "the center of mass of the cube should be 0.9 m high or a little lower, not: ${center}")
endif()
execute_process(COMMAND ${scratch}/build/center_of_mass missing.obj RESULT_VARIABLE code ERROR_VARIABLE complaint)
if(NOT code EQUAL 1 OR NOT complaint MATCHES "missing.obj")
    message(FATAL_ERROR "a missing mesh should be an error, not: exit code ${code}, '${complaint}'")
endif()

# --- embedded in a host's device, under validation that also looks across submissions --------------------------------------

set(log ${scratch}/validation.log)
file(WRITE ${scratch}/vk_layer_settings.txt
    "khronos_validation.enables = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT,"
    "VALIDATION_CHECK_ENABLE_SYNCHRONIZATION_VALIDATION_QUEUE_SUBMIT\n"
    "khronos_validation.report_flags = error,warn,perf,info\n"
    "khronos_validation.debug_action = VK_DBG_LAYER_ACTION_LOG_MSG\n"
    "khronos_validation.log_filename = ${log}\n")
run_and_read(centers ${CMAKE_COMMAND} -E env VK_INSTANCE_LAYERS=VK_LAYER_KHRONOS_validation
    VK_LAYER_SETTINGS_PATH=${scratch}/vk_layer_settings.txt ${scratch}/build/embedded)
if(NOT centers MATCHES "^[-0-9.e]+ ([0-9.]+) [-0-9.e]+\n[-0-9.e]+ [0-9.]+ [-0-9.e]+\n[-0-9.e]+ ([0-9.]+) [-0-9.e]+\n$"
        OR NOT CMAKE_MATCH_2 LESS CMAKE_MATCH_1)
    message(FATAL_ERROR "three centers of mass of falling fluid were expected, not: ${centers}")
endif()
file(READ ${log} messages)
string(REGEX MATCHALL "Validation (Error|Warning|Performance Warning)[^\n]*\n[^\n]*" complaints "${messages}")
if(NOT messages MATCHES "Khronos Validation Layer Active" OR NOT messages MATCHES "SYNCHRONIZATION_VALIDATION_QUEUE_SUBMIT")
    message(FATAL_ERROR "validation was not on: ${messages}")
elseif(complaints)
    message(FATAL_ERROR "validation complains: ${messages}")
endif()

# --- the package itself ---------------------------------------------------------------------------------------------------

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

# The library defines nothing under Vulkan's or volk's names: it would take the place of the host's own.
file(GLOB_RECURSE library ${prefix}/*/libmeltpoint.a)
execute_process(COMMAND nm --extern-only --defined-only ${library} OUTPUT_VARIABLE symbols RESULT_VARIABLE code)
string(REGEX MATCHALL " (vk|volk)[A-Za-z0-9]+\n" taken "${symbols}")
if(NOT code EQUAL 0 OR NOT symbols MATCHES "meltpoint_volkInitialize" OR taken)
    message(FATAL_ERROR "the library should define volk under names of its own, and no symbol like: ${taken}")
endif()

# Every public header compiles, and none leads to what is not installed.
file(GLOB_RECURSE headers RELATIVE ${prefix}/include ${prefix}/include/*.h)
list(TRANSFORM headers REPLACE "(.+)" "#include <\\1>" OUTPUT_VARIABLE includes)
list(JOIN includes "\n" includes)
file(WRITE ${scratch}/all_headers.cpp "#include <vulkan/vulkan.h> // with prototypes, beside which volk.h cannot stand\n${includes}\n")
separate_arguments(flags UNIX_COMMAND "${CXX_FLAGS}")
run(${CXX_COMPILER} ${flags} -std=c++20 -fsyntax-only -Wall -Wextra -Werror -Wno-missing-field-initializers
    -I${prefix}/include ${scratch}/all_headers.cpp)

# The README shows the program as it is here.
file(READ ${SOURCE_DIR}/README.md readme)
file(READ ${CMAKE_CURRENT_LIST_DIR}/center_of_mass.cpp program)
string(FIND "${readme}" "```cpp\n${program}```\n" position)
if(position EQUAL -1)
    message(FATAL_ERROR "README.md does not show tests/package/center_of_mass.cpp as it is")
endif()
