# cmake -P: fills FOLDER/share with what is written about the program, most of it told by the program itself.
#   program commands source folder version viewer contact   as package.cmake gives them
file(REMOVE_RECURSE ${folder})
set(share ${folder}/share)
set(about ${share}/doc/meshfolio)

# told(FILE words…): what `meshfolio words…` prints
function(told file)
  cmake_path(GET file PARENT_PATH parent)
  file(MAKE_DIRECTORY ${parent})
  execute_process(COMMAND ${program} ${ARGN} OUTPUT_FILE ${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# compressed(FILE): as Debian wants long texts, without name and date
function(compressed file)
  execute_process(COMMAND gzip -9nf ${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

told(${share}/man/man1/meshfolio.1 help --as man)
compressed(${share}/man/man1/meshfolio.1)
foreach(command IN LISTS commands)
  told(${share}/man/man1/meshfolio-${command}.1 help ${command} --as man)
  compressed(${share}/man/man1/meshfolio-${command}.1)
endforeach()
told(${share}/bash-completion/completions/meshfolio help --as bash)
told(${share}/zsh/vendor-completions/_meshfolio help --as zsh)
told(${share}/fish/vendor_completions.d/meshfolio.fish help --as fish)
told(${about}/templates.md templates --tags)

string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(WRITE ${about}/changelog "meshfolio (${version}) unstable; urgency=medium\n\n  * Version ${version}: see README.md for what it does.\n\n -- ${contact}  ${date}\n")
compressed(${about}/changelog)

file(READ ${source}/LICENSE licence)
string(REGEX MATCH "Copyright [^\n]*" holder "${licence}")
string(REPLACE "Copyright (c) " "" holder "${holder}")
string(REGEX REPLACE "^.*${holder}\n\n" "" licence "${licence}")
string(STRIP "${licence}" licence)
string(REPLACE "\n\n" "\n.\n" licence "${licence}")
string(REPLACE "\n" "\n " licence "${licence}")
file(WRITE ${about}/copyright "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: meshfolio
Comment: The program is linked with libraries under other licences. NOTICES.md in this folder names them all.

Files: *
Copyright: ${holder}
License: Expat
 ${licence}
")
include(${CMAKE_CURRENT_LIST_DIR}/bill_of_materials.cmake)
file(TOUCH ${folder}/made)
