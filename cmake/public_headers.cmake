# Writes the public headers to a folder meltpoint/: those named here and what they include. There they include each other
# as <meltpoint/...>, so that a host program's own core/log.h never stands in their way.
#   cmake -DSOURCE_DIR=.. -DDESTINATION=.. -P public_headers.cmake
cmake_minimum_required(VERSION 3.25)
set(pending
    core/error.h                # what is thrown
    core/log.h                  # messages on stderr
    gpu/context.h               # a device, of one's own or a host's
    gpu/device_requirements.h   # what a host's device has to have
    gpu/transfer.h              # buffers to the host and back
    io/image_write.h            # frames
    io/particle_export.h        # particles
    io/point_cloud_export.h     # samples
    render/renderer.h           # frames from the particles' buffers
    run/frame_statistics.h      # measurements
    run/frame_view.h            # camera and colors of a scene
    run/load_mesh.h             # meshes from files and built-in ones
    run/mesh_scene.h            # scenes by name, from files and from meshes
    run/run_scene.h             # a whole run, as `meltpoint render`
    run/sample_points.h         # points on and in meshes, as `meltpoint sample`
    run/start_scene.h           # a scene ready to be stepped
)
set(written)
while(pending)
    list(POP_FRONT pending header)
    if(header IN_LIST written)
        continue()
    endif()
    list(APPEND written ${header})
    set(file ${SOURCE_DIR}/engine/${header})
    if(NOT EXISTS ${file})
        set(file ${SOURCE_DIR}/shaders/${header})
    endif()
    file(READ ${file} text)
    string(REGEX MATCHALL "#include \"[^\"]+\"" includes "${text}")
    foreach(include IN LISTS includes)
        string(REGEX REPLACE "#include \"(.+)\"" "\\1" name "${include}")
        if(header MATCHES "^shared/") # shaders' headers stand side by side
            string(REPLACE "${include}" "#include \"shared/${name}\"" text "${text}")
            set(name shared/${name})
        endif()
        list(APPEND pending ${name})
    endforeach()
    string(REGEX REPLACE "#include \"([^\"]+)\"" "#include <meltpoint/\\1>" text "${text}")
    file(WRITE ${DESTINATION}/meltpoint/${header} "${text}")
    list(APPEND CMAKE_INSTALL_MANIFEST_FILES ${DESTINATION}/meltpoint/${header})
endwhile()
