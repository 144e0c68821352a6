# Compiles every shader under shaders/ to a header spirv/<folder>/<file>.h holding `const uint32_t <folder>_<file>[]`, dots
# replaced by underscores: shaders/sim/density.comp becomes spirv/sim/density.comp.h with sim_density_comp.
function(meltpoint_compile_shaders target)
    file(GLOB_RECURSE shaders CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR}/shaders
        shaders/*.comp shaders/*.vert shaders/*.frag)
    set(generated_dir ${CMAKE_CURRENT_BINARY_DIR}/generated)
    set(headers)
    foreach(shader IN LISTS shaders)
        string(MAKE_C_IDENTIFIER "${shader}" symbol)
        set(header ${generated_dir}/spirv/${shader}.h)
        get_filename_component(header_dir ${header} DIRECTORY)
        file(MAKE_DIRECTORY ${header_dir})
        add_custom_command(OUTPUT ${header}
            COMMAND Vulkan::glslangValidator --quiet -V --target-env vulkan1.3 -I${CMAKE_CURRENT_SOURCE_DIR}/shaders
                --depfile ${header}.d --vn ${symbol} -o ${header} ${CMAKE_CURRENT_SOURCE_DIR}/shaders/${shader}
            DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/shaders/${shader}
            DEPFILE ${header}.d
            COMMENT "Compiling shaders/${shader}"
            VERBATIM)
        list(APPEND headers ${header})
    endforeach()
    target_sources(${target} PRIVATE ${headers})
    target_include_directories(${target} PRIVATE ${generated_dir})
endfunction()
