# cmake -D PROGRAM=… -D FILE=… -D SECONDS=… -P add_suites.cmake: lists the suites of a GoogleTest program, and writes a file for CTest
# with one test, layer.Suite, for each. A suite computes shared values once; 2104 processes became 338. A single test: PROGRAM --gtest_filter=Suite.Test
execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE listed TIMEOUT 60 COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE "[][;]" "_" listed "${listed}")   # in values of parameters; no name of a suite has them
string(REGEX MATCHALL "\n[^ \n]+\\.( *#[^\n]*)?\n" suites "\n${listed}")
cmake_path(GET PROGRAM STEM layer)
string(REPLACE "_tests" "" layer ${layer})
set(script "")
foreach(suite IN LISTS suites)
  string(REGEX REPLACE "^\n([^ \n]+)\\..*" "\\1" suite "${suite}")
  set(name "${layer}.${suite}")
  string(APPEND script "add_test([==[${name}]==] [==[${PROGRAM}]==] [==[--gtest_filter=${suite}.*]==] --gtest_brief=1)\n"
         # a suite is skipped if all its tests are
         "set_tests_properties([==[${name}]==] PROPERTIES TIMEOUT ${SECONDS} SKIP_REGULAR_EXPRESSION \"PASSED  . 0 tests.\\n.  SKIPPED . [0-9]+ tests?.\\n*$\")\n")
endforeach()
file(WRITE ${FILE} "${script}")
