# The fonts of pages, papers and pictures, made from Debian's by subset.py: only the characters needed, TrueType outlines, names of our own.
#   page_fonts     files: serif-regular.woff2 …, for fonts.css; of the program, not of the library alone
#   picture_fonts  files: sans-regular.ttf and sans-bold.ttf, for render/sheet/text.cpp
# Beside each, a header with the widths of its characters: sans-regular.h for src/report/svg, the others for tests.
find_program(FONT_PYTHON python3 HINTS /usr/bin REQUIRED)   # the one that Debian's python3-fonttools belongs to
set(font_folder ${PROJECT_BINARY_DIR}/embedded/meshfolio_report)   # where that layer finds headers
set(page_fonts "")
set(picture_fonts ${font_folder}/sans-regular.ttf ${font_folder}/sans-bold.ttf)

# Makes one face, of a font in a folder of Debian's.
function(make_font face source folder)
  string(MAKE_C_IDENTIFIER FONT_${face} found)
  find_file(${found} ${source} PATHS ${folder} REQUIRED)
  set(made ${font_folder}/${face})
  set(command ${FONT_PYTHON} ${PROJECT_SOURCE_DIR}/templates/fonts/subset.py ${${found}} ${face} ${made})
  add_custom_command(OUTPUT ${made}.ttf ${made}.woff2 ${made}.h COMMAND ${command}
                     DEPENDS ${PROJECT_SOURCE_DIR}/templates/fonts/subset.py ${${found}} COMMENT "Font ${face}" VERBATIM)
  if(MESHFOLIO_PORTABLE OR NOT CMAKE_EXECUTABLE_FORMAT STREQUAL "ELF")   # embed_files reads them while this is configured
    file(MAKE_DIRECTORY ${font_folder})
    execute_process(COMMAND ${command} COMMAND_ERROR_IS_FATAL ANY)
  endif()
  set(page_fonts ${page_fonts} ${made}.woff2 PARENT_SCOPE)
endfunction()

make_font(sans-regular Inter-Regular.otf /usr/share/fonts/opentype/inter)
make_font(sans-bold Inter-SemiBold.otf /usr/share/fonts/opentype/inter)
if(MESHFOLIO_PROGRAM)
  make_font(sans-italic Inter-Italic.otf /usr/share/fonts/opentype/inter)
  make_font(serif-regular texgyrepagella-regular.otf /usr/share/texmf/fonts/opentype/public/tex-gyre)
  make_font(serif-italic texgyrepagella-italic.otf /usr/share/texmf/fonts/opentype/public/tex-gyre)
  make_font(serif-bold texgyrepagella-bold.otf /usr/share/texmf/fonts/opentype/public/tex-gyre)
  make_font(math-regular texgyrepagella-math.otf /usr/share/texmf/fonts/opentype/public/tex-gyre-math)
  make_font(mono-regular DejaVuSansMono.ttf /usr/share/fonts/truetype/dejavu)
endif()
add_custom_target(meshfolio_fonts DEPENDS ${page_fonts} ${picture_fonts})   # once, for both layers that hold them
