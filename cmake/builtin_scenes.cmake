# Compiles apps/scenes/*.toml into the target: generated/builtin_scenes.h holds BUILTIN_SCENES, an array of name and text.
function(meltpoint_embed_scenes target)
    file(GLOB scenes CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/apps/scenes/*.toml)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${scenes})
    set(entries "")
    foreach(scene IN LISTS scenes)
        get_filename_component(name ${scene} NAME_WE)
        file(READ ${scene} toml)
        string(APPEND entries "    {\"${name}\", R\"--toml--(${toml})--toml--\"},\n")
    endforeach()
    set(generated_dir ${CMAKE_CURRENT_BINARY_DIR}/generated)
    file(GENERATE OUTPUT ${generated_dir}/builtin_scenes.h CONTENT "#pragma once

#include <string_view>

namespace meltpoint {

struct BuiltinScene {
    std::string_view name;
    std::string_view toml;
};

inline constexpr BuiltinScene BUILTIN_SCENES[] = {
${entries}};

} // namespace meltpoint
")
    target_include_directories(${target} PRIVATE ${generated_dir})
endfunction()
