# The warnings that this project's own code is compiled with; they do not leak to users of the library.
add_library(meltpoint_warnings INTERFACE)
target_compile_options(meltpoint_warnings INTERFACE
    $<$<COMPILE_LANGUAGE:CXX>:-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wnon-virtual-dtor -Wold-style-cast
        -Woverloaded-virtual -Wno-sign-conversion -Wno-missing-field-initializers>
    $<$<AND:$<BOOL:${MELTPOINT_WERROR}>,$<COMPILE_LANGUAGE:CXX>>:-Werror>)
