# The library for other programs: find_package(meshfolio) gives meshfolio::mesh, meshfolio::geometry and meshfolio::render.
# add_subdirectory() gives the same targets, without the program and its tests. tests/library_example shows how.
#   Programs include headers as this project does: "mesh/io/mesh_files.h", "geometry/spectrum/stability.h", and those of the renderer from its
#   own folder, "draw_mesh.h". Headers are installed in include/meshfolio, folder by folder.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(meshfolio_headers ${CMAKE_INSTALL_INCLUDEDIR}/meshfolio)
set(meshfolio_config ${CMAKE_INSTALL_LIBDIR}/cmake/meshfolio)

set(meshfolio_library meshfolio_base meshfolio_mesh meshfolio_geometry meshfolio_render)
foreach(target IN LISTS meshfolio_library)
  target_include_directories(${target} INTERFACE $<INSTALL_INTERFACE:${meshfolio_headers}>)
endforeach()
target_include_directories(meshfolio_render INTERFACE $<INSTALL_INTERFACE:${meshfolio_headers}/render>)

# Packages of the program, or of a project that contains this one, do not contain the library.
set(apart COMPONENT development)
if(MESHFOLIO_PROGRAM OR NOT PROJECT_IS_TOP_LEVEL)
  list(APPEND apart EXCLUDE_FROM_ALL)
endif()
install(TARGETS ${meshfolio_library} EXPORT meshfolio-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} ${apart})
install(DIRECTORY src/base src/mesh src/geometry render DESTINATION ${meshfolio_headers} ${apart} FILES_MATCHING PATTERN "*.h"
        PATTERN "*-inl.h" EXCLUDE)
install(EXPORT meshfolio-targets NAMESPACE meshfolio:: DESTINATION ${meshfolio_config} ${apart})

# Only linked libraries are dependencies: Spectra and stb are compiled in.
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/library/meshfolio-config.cmake CONTENT "include(CMakeFindDependencyMacro)
find_dependency(Eigen3 3.4 NO_MODULE)
find_dependency(glm)
find_dependency(TBB)
find_dependency(HWY)
find_dependency(tinyobjloader)
find_dependency(pugixml)
find_dependency(PkgConfig)
pkg_check_modules(deflate QUIET REQUIRED IMPORTED_TARGET libdeflate)
pkg_check_modules(nettle QUIET REQUIRED IMPORTED_TARGET nettle)
include(\${CMAKE_CURRENT_LIST_DIR}/meshfolio-targets.cmake)
" @ONLY)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/library/meshfolio-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/library/meshfolio-config.cmake ${PROJECT_BINARY_DIR}/library/meshfolio-config-version.cmake
        DESTINATION ${meshfolio_config} ${apart})
