# One generated OpenGL 4.5 core loader for OSMesa, EGL and GLFW alike: no gl* symbol is linked from a library,
# or the software and the system's GL would mix.
set(glad_dir ${CMAKE_BINARY_DIR}/glad)
add_custom_command(
    OUTPUT ${glad_dir}/src/gl.c ${glad_dir}/include/glad/gl.h
    COMMAND ${GLAD} --api gl:core=4.5
            --extensions GL_EXT_texture_filter_anisotropic,GL_ARB_shader_viewport_layer_array
            --reproducible --quiet --out-path ${glad_dir} c
    COMMENT "Generating the OpenGL loader"
    VERBATIM)
add_library(dioptre_glad STATIC ${glad_dir}/src/gl.c)
target_include_directories(dioptre_glad SYSTEM PUBLIC ${glad_dir}/include)

target_link_libraries(dioptre_gl PUBLIC dioptre_glad PRIVATE PkgConfig::egl)
if(DIOPTRE_OSMESA)
    target_link_libraries(dioptre_gl PRIVATE PkgConfig::osmesa)
    target_compile_definitions(dioptre_gl PRIVATE DIOPTRE_OSMESA)
endif()

# Where the program finds shaders/, config/ and assets/ when no folder above the executable holds them.
target_compile_definitions(dioptre_core PRIVATE DIOPTRE_RESOURCE_ROOT="${CMAKE_SOURCE_DIR}")
