# The reference of the public headers, as they are installed, in DESTINATION/html. Any warning of Doxygen's is an error but one.
#   cmake -DSOURCE_DIR=.. -DDESTINATION=.. -DDOXYGEN=.. -P docs.cmake
cmake_minimum_required(VERSION 3.25)
if(NOT DOXYGEN)
    message(FATAL_ERROR "doxygen was not found when the build was configured (Debian package doxygen)")
endif()
set(docs ${DESTINATION})
file(REMOVE_RECURSE ${docs})
set(DESTINATION ${docs}/include)
include(${CMAKE_CURRENT_LIST_DIR}/public_headers.cmake)

# The front page: what the README says about the library. Its links into the source tree stay in the README.
file(READ ${SOURCE_DIR}/README.md readme)
string(REGEX MATCH "\n## Using the library\n(.*)\n## Licence" section "${readme}")
if(section STREQUAL "")
    message(FATAL_ERROR "README.md has no section \"Using the library\" before \"Licence\"")
endif()
string(REGEX REPLACE "\\[([^]]+)\\]\\([^)]+\\)" "\\1" section "${CMAKE_MATCH_1}")
file(WRITE ${docs}/main.md "# Meltpoint\n${section}")

file(WRITE ${docs}/shared.sed "s,^//,///,\ns,\\([^/ ].*[^ ]\\) *// ,\\1 ///< ,\n")

execute_process(COMMAND ${CMAKE_COMMAND} -E env MELTPOINT_DOCS=${docs} ${DOXYGEN} ${CMAKE_CURRENT_LIST_DIR}/Doxyfile
    COMMAND_ERROR_IS_FATAL ANY)

# Types and functions are documented. A field or constant need not be whose name and value say it all: of these,
# Doxygen's word counts for nothing.
file(STRINGS ${docs}/warnings.txt warnings)
list(FILTER warnings EXCLUDE REGEX "Member .* \\(variable\\) of (struct|class|namespace) .* is not documented")
if(warnings)
    list(JOIN warnings "\n" warnings)
    message(FATAL_ERROR "Doxygen warns:\n${warnings}")
endif()
