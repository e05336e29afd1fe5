# The Python package (-DMESHFOLIO_PYTHON=ON): BUILD/python/meshfolio, to be found with PYTHONPATH=BUILD/python; pyproject.toml makes a wheel.
# Which Python: -DPython_EXECUTABLE=/usr/bin/python3.
set(MESHFOLIO_PYTHON_FOLDER lib/python3/dist-packages CACHE STRING "Where the Python package is installed, below the prefix")
set(PYBIND11_FINDPYTHON ON)
find_package(Python 3.9 REQUIRED COMPONENTS Interpreter Development.Module)
find_package(pybind11 2.10 REQUIRED CONFIG)

set(package_folder ${PROJECT_BINARY_DIR}/python/meshfolio)
pybind11_add_module(meshfolio_python MODULE NO_EXTRAS src/python/module.cpp)
set_target_properties(meshfolio_python PROPERTIES OUTPUT_NAME _core LIBRARY_OUTPUT_DIRECTORY ${package_folder})
target_link_libraries(meshfolio_python PRIVATE meshfolio_run meshfolio_warnings)
# Only what is called: neither the libraries of the report nor our names, which a program with Python in it may have as well.
target_link_options(meshfolio_python PRIVATE LINKER:--as-needed LINKER:--exclude-libs,ALL)
set(package_files __init__.py __init__.pyi py.typed)
foreach(file IN LISTS package_files)
  configure_file(src/python/meshfolio/${file} ${package_folder}/${file} COPYONLY)
endforeach()
install(TARGETS meshfolio_python LIBRARY DESTINATION ${MESHFOLIO_PYTHON_FOLDER}/meshfolio COMPONENT python)
list(TRANSFORM package_files PREPEND src/python/meshfolio/)
install(FILES ${package_files} DESTINATION ${MESHFOLIO_PYTHON_FOLDER}/meshfolio COMPONENT python)
