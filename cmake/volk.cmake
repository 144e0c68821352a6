# volk keeps Vulkan's functions in global variables of the functions' own names. In a static library these would take the
# place of the loader's functions in a host program that links libvulkan, or clash with the host's own volk. This writes a
# header that renames all that volk exports, for the one file that compiles volk.c: engine/gpu/volk.c.
find_path(VOLK_DIR volk.c REQUIRED)

function(meltpoint_rename_volk target)
    file(STRINGS ${VOLK_DIR}/volk.h declarations REGEX "^(extern PFN_vk|[A-Za-z].*[ *]volk[A-Za-z]+\\()")
    set(text "#pragma once\n\n")
    foreach(declaration IN LISTS declarations)
        string(REGEX MATCH "[ *]((vk|volk)[A-Za-z0-9]+)[;(]" match "${declaration};")
        string(APPEND text "#define ${CMAKE_MATCH_1} meltpoint_${CMAKE_MATCH_1}\n")
    endforeach()
    file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/volk/volk_names.h CONTENT "${text}" @ONLY)
    target_include_directories(${target} SYSTEM PRIVATE ${VOLK_DIR} ${CMAKE_CURRENT_BINARY_DIR}/volk)
endfunction()
