# What `cmake --install` copies, and the Debian packages of it (`cpack` in the build folder): meshfolio, and where the Python module is built
# python3-meshfolio, which needs nothing of the other. What is written about the program is made from its own
# definitions when it is built: documents.cmake.
if(CMAKE_CXX_FLAGS MATCHES "-fsanitize|-fprofile")
  return()   # a program to be tested alone, which may not even run in the middle of a build
endif()
include(GNUInstallDirs)
set(MESHFOLIO_CONTACT "the meshfolio authors <meshfolio@users.noreply.github.com>" CACHE STRING "Name and address of whoever passes the package on")
set(documents ${PROJECT_BINARY_DIR}/documents)

# Nothing is dated by the clock: the same commit gives the same bytes.
set(MESHFOLIO_EPOCH "$ENV{SOURCE_DATE_EPOCH}")
if(NOT MESHFOLIO_EPOCH AND GIT_FOUND AND EXISTS ${PROJECT_SOURCE_DIR}/.git)
  execute_process(COMMAND ${GIT_EXECUTABLE} -c safe.directory=${PROJECT_SOURCE_DIR} -C ${PROJECT_SOURCE_DIR} log -1 --format=%ct
                  OUTPUT_VARIABLE MESHFOLIO_EPOCH OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
if(NOT MESHFOLIO_EPOCH)
  set(MESHFOLIO_EPOCH 1767225600)   # the year of the licence, in a source archive without Git
endif()

file(GLOB commands RELATIVE ${PROJECT_SOURCE_DIR}/src/cli CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/cli/*_command.cpp)
list(TRANSFORM commands REPLACE "_command.cpp$" "")
add_custom_command(
  OUTPUT ${documents}/made
  COMMAND ${CMAKE_COMMAND} -E env SOURCE_DATE_EPOCH=${MESHFOLIO_EPOCH} ${CMAKE_COMMAND} -D program=$<TARGET_FILE:meshfolio> -D "commands=${commands}"
          -D source=${PROJECT_SOURCE_DIR} -D folder=${documents} -D version=${PROJECT_VERSION} -D viewer=${viewer_program}
          -D "contact=${MESHFOLIO_CONTACT}" -P ${CMAKE_CURRENT_LIST_DIR}/documents.cmake
  DEPENDS meshfolio ${CMAKE_CURRENT_LIST_DIR}/documents.cmake ${CMAKE_CURRENT_LIST_DIR}/bill_of_materials.cmake
          ${PROJECT_SOURCE_DIR}/src/submission/NOTICES.md ${PROJECT_SOURCE_DIR}/LICENSE
  COMMENT "Man pages, completions and the bill of materials" VERBATIM)
add_custom_target(documents ALL DEPENDS ${documents}/made)

set(of_a_folder OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CMAKE_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS ${of_a_folder})
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS ${of_a_folder})
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME program)
install(TARGETS meshfolio RUNTIME)
install(DIRECTORY ${documents}/share/ DESTINATION ${CMAKE_INSTALL_DATAROOTDIR})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/src/submission/NOTICES.md
        DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/meshfolio)
install(FILES ${PROJECT_SOURCE_DIR}/data/report.toml ${PROJECT_SOURCE_DIR}/.github/workflows/report.yml
        DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/meshfolio/examples)
install(FILES ${PROJECT_SOURCE_DIR}/data/workflow/Snakefile DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/meshfolio/workflow)
install(FILES ${PROJECT_SOURCE_DIR}/data/workflow/slurm/config.yaml DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/meshfolio/workflow/slurm)
install(PROGRAMS ${PROJECT_SOURCE_DIR}/data/workflow/slurm/status DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/meshfolio/workflow/slurm)
foreach(folder . _extensions/meshfolio)
  install(FILES ${PROJECT_SOURCE_DIR}/templates/pandoc/meshfolio.lua DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/meshfolio/pandoc/${folder})
endforeach()
install(FILES ${PROJECT_SOURCE_DIR}/templates/pandoc/_extensions/meshfolio/_extension.yml
        DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/meshfolio/pandoc/_extensions/meshfolio)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/data/documents DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/meshfolio/examples FILES_MATCHING PATTERN *.md)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "${MESHFOLIO_CONTACT}")
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION
    "report on discrete curvature and smoothing of meshes\nOne command answers the questions of a geometry-processing coursework on real\nmeshes, checks its own answers against known truth, draws every result from\nsix directions without a GPU or a display, and binds it all into one report.")
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_STRIP_FILES TRUE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME meshfolio)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "chromium-headless-shell | chromium | weasyprint, pandoc, snakemake")
if(MESHFOLIO_PYTHON_MODULE)
  list(APPEND CPACK_COMPONENTS_ALL python)
  math(EXPR next_python "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-meshfolio)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.${Python_VERSION_MINOR}~), python3 (<< 3.${next_python}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-scipy")
  set(CPACK_DEBIAN_PYTHON_DESCRIPTION
      "discrete curvature, spectra and smoothing of meshes for Python\nCurvature, spectra, smoothing, comparison and pictures of triangle meshes, with\nNumPy arrays in and out.")
  install(FILES ${documents}/share/doc/meshfolio/copyright ${documents}/share/doc/meshfolio/changelog.gz
          DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/python3-meshfolio COMPONENT python OPTIONAL)   # not in a wheel, where the program is not built
endif()
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/package_epoch.cmake CONTENT "set(ENV{SOURCE_DATE_EPOCH} @MESHFOLIO_EPOCH@)\n" @ONLY)
set(CPACK_PROJECT_CONFIG_FILE ${PROJECT_BINARY_DIR}/package_epoch.cmake)
include(CPack)
