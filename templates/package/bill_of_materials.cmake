# Included by documents.cmake: meshfolio.spdx.json, the bill of materials in SPDX 2.3. What is in the program is the first table of NOTICES.md;
# the versions are those of the packages it was built with, and the licence is an expression of SPDX where the table gives one.
string(TIMESTAMP created UTC)
file(STRINGS ${source}/src/submission/NOTICES.md lines ENCODING UTF-8)
set(packages "")
set(relations "")
set(is_in_table FALSE)
foreach(line IN LISTS lines)
  if(line MATCHES "^## ")
    set(is_in_table FALSE)
    if(line MATCHES "^## Built into the program")
      set(is_in_table TRUE)
    endif()
  endif()
  if(NOT is_in_table OR NOT line MATCHES "^\\| ([^|]+) \\| `([^`]+)`[^|]*\\| ([^|]+) \\| ([^|]+) \\|$")
    continue()
  endif()
  set(what "${CMAKE_MATCH_1}")
  set(package ${CMAKE_MATCH_2})
  set(licence "${CMAKE_MATCH_3}")
  set(how "${CMAKE_MATCH_4}")
  string(REPLACE "*" "" licence "${licence}")
  if(package STREQUAL "three")
    file(READ ${source}/templates/viewer/package.json viewer_package)
    string(JSON number GET "${viewer_package}" dependencies three)
    set(purl "pkg:npm/three@${number}")
    set(size 0)
    if(EXISTS "${viewer}")
      file(SIZE ${viewer} size)
    endif()
    if(size EQUAL 0)
      continue()   # built without
    endif()
  else()
    set(number "")
    execute_process(COMMAND dpkg-query -W -f=\${Version} ${package} OUTPUT_VARIABLE number ERROR_QUIET RESULT_VARIABLE failed)
    if(failed OR NOT number)
      set(number NOASSERTION)
    endif()
    set(purl "pkg:deb/debian/${package}@${number}")
    string(REPLACE "+" "%2B" purl "${purl}")
    string(REPLACE ":" "%3A" purl "${purl}")
    string(REPLACE "pkg%3Adeb" "pkg:deb" purl "${purl}")
  endif()
  set(declared NOASSERTION)
  if(licence MATCHES "^[A-Za-z]+(-[0-9.]+(-Clause)?)?$")
    set(declared ${licence})
  endif()
  string(MAKE_C_IDENTIFIER "${what}" id)
  string(REPLACE "_" "-" id "SPDXRef-${id}")
  string(APPEND packages ",
    {\"SPDXID\": \"${id}\", \"name\": \"${what}\", \"versionInfo\": \"${number}\", \"downloadLocation\": \"NOASSERTION\", \"filesAnalyzed\": false,
     \"licenseConcluded\": \"NOASSERTION\", \"licenseDeclared\": \"${declared}\", \"licenseComments\": \"${licence}\", \"copyrightText\": \"NOASSERTION\",
     \"externalRefs\": [{\"referenceCategory\": \"PACKAGE-MANAGER\", \"referenceType\": \"purl\", \"referenceLocator\": \"${purl}\"}]}")
  set(relation STATIC_LINK)
  if(how MATCHES "^shared")
    set(relation DYNAMIC_LINK)
  endif()
  string(APPEND relations ",
    {\"spdxElementId\": \"SPDXRef-meshfolio\", \"relationshipType\": \"${relation}\", \"relatedSpdxElement\": \"${id}\"}")
endforeach()
string(UUID name NAMESPACE 6ba7b811-9dad-11d1-80b4-00c04fd430c8 NAME "meshfolio ${version}${created}${packages}" TYPE SHA1)
file(WRITE ${about}/meshfolio.spdx.json "{
  \"spdxVersion\": \"SPDX-2.3\", \"dataLicense\": \"CC0-1.0\", \"SPDXID\": \"SPDXRef-DOCUMENT\", \"name\": \"meshfolio-${version}\",
  \"documentNamespace\": \"urn:uuid:${name}\",
  \"creationInfo\": {\"created\": \"${created}\", \"creators\": [\"Tool: meshfolio-${version}\"]},
  \"packages\": [
    {\"SPDXID\": \"SPDXRef-meshfolio\", \"name\": \"meshfolio\", \"versionInfo\": \"${version}\", \"downloadLocation\": \"NOASSERTION\", \"filesAnalyzed\": false,
     \"licenseConcluded\": \"NOASSERTION\", \"licenseDeclared\": \"MIT\", \"copyrightText\": \"NOASSERTION\"}${packages}],
  \"relationships\": [
    {\"spdxElementId\": \"SPDXRef-DOCUMENT\", \"relationshipType\": \"DESCRIBES\", \"relatedSpdxElement\": \"SPDXRef-meshfolio\"}${relations}]
}
")
