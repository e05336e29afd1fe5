# The program that turns models in the page: viewer.js and three.js in one file, made by esbuild from the committed lock file. Nothing is
# written into the source: npm works on a copy in the build folder.
#   viewer_program   the file; empty without the viewer, when the page has only pictures
#   MESHFOLIO_VIEWER AUTO: what goes wrong is told and the program is built without; ON: it is an error; OFF: not tried
set(viewer_folder ${PROJECT_BINARY_DIR}/viewer)
set(viewer_program ${viewer_folder}/viewer.min.js)
set(viewer_sources package.json package-lock.json viewer.js view.js model.js shader.js lab.js lab_colours.js lab_denoising.js
                   lab_experiment.js lab_math.js lab_noise.js lab_panel.js lab_play.js lab_plot.js lab_scene.js lab_state.js lab_words.js)
list(TRANSFORM viewer_sources PREPEND ${CMAKE_CURRENT_LIST_DIR}/)

find_program(NPM npm)
find_program(NODE node)
if(MESHFOLIO_VIEWER STREQUAL "ON" AND NOT (NPM AND NODE))
  message(FATAL_ERROR "MESHFOLIO_VIEWER=ON needs node and npm: apt install npm, or take AUTO")
endif()
if(NOT MESHFOLIO_VIEWER STREQUAL "OFF" AND NPM AND NODE)
  # An empty one is left from a failure: another configuration tries again.
  if(EXISTS ${viewer_program})
    file(SIZE ${viewer_program} size)
    if(size EQUAL 0)
      file(REMOVE ${viewer_program})
    endif()
  endif()
  add_custom_command(
    OUTPUT ${viewer_program}
    COMMAND ${CMAKE_COMMAND} -D "sources=${viewer_sources}" -D folder=${viewer_folder} -D npm=${NPM} -D node=${NODE} -D viewer=${MESHFOLIO_VIEWER}
            -P ${CMAKE_CURRENT_LIST_DIR}/bundle.cmake
    DEPENDS ${viewer_sources} ${CMAKE_CURRENT_LIST_DIR}/bundle.cmake
    COMMENT "Bundling the viewer of models" VERBATIM)
else()
  message(STATUS "No viewer of models: the page has pictures only (MESHFOLIO_VIEWER=${MESHFOLIO_VIEWER}, npm: ${NPM})")
  set(viewer_program ${viewer_folder}/none/viewer.min.js)
  file(CONFIGURE OUTPUT ${viewer_program} CONTENT "")
endif()
