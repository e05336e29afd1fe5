# Run by the build: -D sources=…;… -D folder=… -D npm=… -D node=… -D viewer=AUTO|ON. See viewer.cmake.
set(program ${folder}/viewer.min.js)

function(step name)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${folder} RESULT_VARIABLE result OUTPUT_VARIABLE told ERROR_VARIABLE told)
  if(NOT result EQUAL 0)
    if(viewer STREQUAL "ON")
      message(FATAL_ERROR "${name} failed; without the viewer: -DMESHFOLIO_VIEWER=AUTO\n${told}")
    endif()
    message(STATUS "No viewer of models: ${name} failed, the page has pictures only. With a network, configure again.")
    file(WRITE ${program} "")
    set(failed TRUE PARENT_SCOPE)
  endif()
endfunction()

file(COPY ${sources} DESTINATION ${folder})
step("npm ci" ${npm} ci --ignore-scripts --no-audit --no-fund --prefer-offline --fetch-retries=1 --fetch-timeout=20000)
if(NOT failed)
  step("esbuild" ${node} node_modules/esbuild/bin/esbuild viewer.js --bundle --minify --format=iife --target=es2022 --charset=utf8
       --legal-comments=eof --log-level=warning --outfile=viewer.min.js)
endif()
