# Writes a header that says which commit is being built: cmake -DSOURCE_DIR=DIR -DHEADER=FILE -P commit.cmake
# It runs with every build and touches the header only when the answer changes.
cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND git -C ${SOURCE_DIR} describe --always --dirty=\ with\ changes --abbrev=10 --exclude=*
    OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed)
    set(commit "unknown") # an archive, or no git
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT "#pragma once

inline constexpr char MELTPOINT_COMMIT[] = \"@commit@\";
" @ONLY)
