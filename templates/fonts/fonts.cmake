# The fonts of pages, papers and pictures, made from Debian's by subset.py: only the characters needed, TrueType outlines, names of our own.
#   page_fonts     files: serif-regular.woff2 …, for fonts.css
#   picture_fonts  files: sans-regular.ttf and sans-bold.ttf, for render/sheet/text.cpp
# Beside each, a header with the widths of its characters: sans-regular.h for src/report/svg, the others for tests.
find_program(FONT_PYTHON python3 HINTS /usr/bin REQUIRED)   # the one that Debian's python3-fonttools belongs to
find_file(PAGELLA texgyrepagella-regular.otf PATHS /usr/share/texmf/fonts/opentype/public/tex-gyre REQUIRED)
find_file(PAGELLA_ITALIC texgyrepagella-italic.otf PATHS /usr/share/texmf/fonts/opentype/public/tex-gyre REQUIRED)
find_file(PAGELLA_BOLD texgyrepagella-bold.otf PATHS /usr/share/texmf/fonts/opentype/public/tex-gyre REQUIRED)
find_file(PAGELLA_MATH texgyrepagella-math.otf PATHS /usr/share/texmf/fonts/opentype/public/tex-gyre-math REQUIRED)
find_file(INTER Inter-Regular.otf PATHS /usr/share/fonts/opentype/inter REQUIRED)
find_file(INTER_ITALIC Inter-Italic.otf PATHS /usr/share/fonts/opentype/inter REQUIRED)
find_file(INTER_BOLD Inter-SemiBold.otf PATHS /usr/share/fonts/opentype/inter REQUIRED)
find_file(DEJAVU_MONO DejaVuSansMono.ttf PATHS /usr/share/fonts/truetype/dejavu REQUIRED)

set(font_folder ${PROJECT_BINARY_DIR}/embedded/meshfolio_report)   # where that layer finds headers
set(page_fonts "")
set(picture_fonts "")
foreach(face serif-regular=PAGELLA serif-italic=PAGELLA_ITALIC serif-bold=PAGELLA_BOLD math-regular=PAGELLA_MATH sans-regular=INTER
             sans-italic=INTER_ITALIC sans-bold=INTER_BOLD mono-regular=DEJAVU_MONO)
  string(REGEX MATCH "(.*)=(.*)" face ${face})
  set(made ${font_folder}/${CMAKE_MATCH_1})
  set(make_font ${FONT_PYTHON} ${CMAKE_CURRENT_LIST_DIR}/subset.py ${${CMAKE_MATCH_2}} ${CMAKE_MATCH_1} ${made})
  add_custom_command(OUTPUT ${made}.ttf ${made}.woff2 ${made}.h COMMAND ${make_font} DEPENDS ${CMAKE_CURRENT_LIST_DIR}/subset.py ${${CMAKE_MATCH_2}}
                     COMMENT "Font ${CMAKE_MATCH_1}" VERBATIM)
  if(MESHFOLIO_PORTABLE OR NOT CMAKE_EXECUTABLE_FORMAT STREQUAL "ELF")   # embed_files reads them while this is configured
    file(MAKE_DIRECTORY ${font_folder})
    execute_process(COMMAND ${make_font} COMMAND_ERROR_IS_FATAL ANY)
  endif()
  list(APPEND page_fonts ${made}.woff2)
endforeach()
set(picture_fonts ${font_folder}/sans-regular.ttf ${font_folder}/sans-bold.ttf)
add_custom_target(meshfolio_fonts DEPENDS ${page_fonts} ${picture_fonts})   # once, for both layers that hold them
