# SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
# SPDX-License-Identifier: Zlib

# Tests that take long and that few changes touch: other builds of the library, the Python package, the examples' programs and their windows, random calls,
# soak. They have the label long; run-tests leaves them out unless it is asked for all.

get_property(others DIRECTORY PROPERTY TESTS)
set(EP_LABEL PROPERTIES LABELS long)  # of suites, which ctest finds by itself

# ---- the library: random sequences of calls, long times
# Fresh seeds find what nobody has seen: they are for those who look for it, and not for a change that has to pass.
set(BULLET_EP_FUZZ_SECONDS 0 CACHE STRING "How long fresh seeds are tried [s], 0: not at all")
foreach(precision IN LISTS EP_PRECISIONS)
	add_test(NAME Fuzz.fixedSeeds.${precision} COMMAND fuzz${EP_SUFFIX_${precision}} --sequences 150)
	set_tests_properties(Fuzz.fixedSeeds.${precision} PROPERTIES COST ${EP_LONG})
	if(BULLET_EP_FUZZ_SECONDS GREATER 0)
		add_test(NAME Fuzz.freshSeeds.${precision} COMMAND fuzz${EP_SUFFIX_${precision}} --fresh --seconds ${BULLET_EP_FUZZ_SECONDS})
		set_tests_properties(Fuzz.freshSeeds.${precision} PROPERTIES TIMEOUT 86400)
	endif()
	add_test(NAME HardTrials.anHour.${precision} COMMAND tests-${precision} --gtest_filter=*/HardTrials.DirectSolverIsRight/*an_hour*)
	set_tests_properties(HardTrials.anHour.${precision} PROPERTIES ENVIRONMENT EP_LONG_TESTS=1 FAIL_REGULAR_EXPRESSION "Running 0 tests|SKIPPED")
	# Soak: create, break, repair and delete, over and over.
	add_test(NAME Soak.long.${precision} COMMAND tests-${precision} --gtest_filter=Soak.*)
	set_tests_properties(Soak.long.${precision} PROPERTIES ENVIRONMENT EP_SOAK_CYCLES=100000 TIMEOUT 3600)
endforeach()

# The page that compares scenes with tests of others tells what these scenes give.
if(TARGET ep-run-float64)
	ep_find_python(python json)
	if(python)
		add_test(NAME Measured.pageIsCurrent COMMAND ${python} ${PROJECT_SOURCE_DIR}/examples/scenes/measured/compare
			$<TARGET_FILE:ep-run-float64> ${PROJECT_SOURCE_DIR}/docs/validation.md)
	endif()
endif()

# ---- the Python package, as pip installs it, but with the compiled part that this build makes for the tests: .ci/more has pip build it
if(TARGET ep-run OR TARGET ep-run-float64)
	ep_find_python(python setuptools wheel pip venv pybind11 numpy matplotlib)
	if(python)
		set(Python3_EXECUTABLE ${python})
		find_package(Python3 QUIET COMPONENTS Interpreter Development.Module)
	endif()
	if(CMAKE_CXX_FLAGS MATCHES "-fsanitize")
		message(STATUS "Python: no Python loads what sanitizers have been built into, left out")
	elseif(python AND Python3_Development.Module_FOUND AND CMAKE_GENERATOR STREQUAL Ninja)
		set(environment ${CMAKE_CURRENT_BINARY_DIR}/python)
		execute_process(COMMAND ${python} -c "import pybind11; print(pybind11.get_cmake_dir())" OUTPUT_VARIABLE pybind11_DIR OUTPUT_STRIP_TRAILING_WHITESPACE)
		if(NOT TARGET python-core)
			add_subdirectory(${PROJECT_SOURCE_DIR}/python ${PROJECT_BINARY_DIR}/python)
		endif()
		add_test(NAME Python.install COMMAND ${CMAKE_COMMAND} -E env BULLET_EP_PYTHON_READY=${PROJECT_BINARY_DIR}
			sh -c "${CMAKE_COMMAND} --build ${PROJECT_BINARY_DIR} --target python-package && ${python} -m venv --system-site-packages --without-pip ${environment} && ${environment}/bin/python -m pip install --no-build-isolation --no-index --no-deps --force-reinstall ${PROJECT_SOURCE_DIR}/python")
		set_tests_properties(Python.install PROPERTIES FIXTURES_SETUP python TIMEOUT 600)
		foreach(part IN ITEMS package examples documentation)
			add_test(NAME Python.${part} COMMAND ${CMAKE_COMMAND} -E env PYTHONDONTWRITEBYTECODE=1 ${environment}/bin/python -m unittest test_${part}
				WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}/python/tests)
		endforeach()
		set_tests_properties(Python.package Python.examples Python.documentation PROPERTIES
			FIXTURES_REQUIRED python TIMEOUT 600)
		ep_find_python(mypy mypy)
		if(mypy)
			add_test(NAME Python.types COMMAND ${mypy} -m mypy --strict --cache-dir ${CMAKE_CURRENT_BINARY_DIR}/mypy
				${PROJECT_SOURCE_DIR}/python/bullet_elastic_plastic)
		else()
			message(STATUS "Python.types: mypy not found, left out (Debian and Ubuntu: mypy)")
		endif()
	else()
		message(STATUS "Python: it needs Ninja and the headers of Python, pip, setuptools, wheel, venv, pybind11, NumPy and Matplotlib for one Python; left out "
			"(Debian and Ubuntu: python3-dev python3-pip python3-setuptools python3-venv python3-wheel python3-pybind11 python3-numpy python3-matplotlib)")
	endif()
endif()

include(Programs.cmake)

# ---- the library as others use it: README's three ways
list(GET EP_PRECISIONS 0 precision)
set(bullet BulletElasticPlastic::Bullet${EP_SUFFIX_${precision}})
get_property(bullet_libraries TARGET ${bullet} PROPERTY INTERFACE_LINK_LIBRARIES)
get_property(bullet_definitions TARGET ${bullet} PROPERTY INTERFACE_COMPILE_DEFINITIONS)
configure_file(package/build.cmake.in build-package.cmake @ONLY)
set(ways subdirectory)
if(BULLET_EP_INSTALL AND PROJECT_IS_TOP_LEVEL)
	list(APPEND ways installed)
endif()
if(BULLET_EP_BULLET_INCLUDE_DIR)
	list(APPEND ways overlay)  # not beside a Bullet in the same build: its headers are no folder to copy
endif()
foreach(way IN LISTS ways)
	add_test(NAME Package.${way}
		COMMAND ${CMAKE_COMMAND} -DWAY=${way} -DCONFIG=$<CONFIG> -P ${CMAKE_CURRENT_BINARY_DIR}/build-package.cmake)
	set_tests_properties(Package.${way} PROPERTIES TIMEOUT 600 COST ${EP_LONG})
endforeach()

if("${EP_PRECISIONS}" STREQUAL "float;double" AND BULLET_EP_BULLET_INCLUDE_DIR AND NOT MSVC)
	get_property(bullet_libraries_float64 TARGET BulletElasticPlastic::Bullet-float64 PROPERTY INTERFACE_LINK_LIBRARIES)
	string(REPLACE ";" " " bullet_libraries "${bullet_libraries}")
	string(REPLACE ";" " " bullet_libraries_float64 "${bullet_libraries_float64}")
	configure_file(package/mixed.cmake.in mixed-package.cmake @ONLY)
	add_test(NAME Package.mixedPrecisions COMMAND ${CMAKE_COMMAND} -DFLOAT=$<TARGET_FILE:BulletElasticPlastic>
		-DDOUBLE=$<TARGET_FILE:BulletElasticPlastic-float64> -P ${CMAKE_CURRENT_BINARY_DIR}/mixed-package.cmake)
endif()

# ---- what games do with it
if(BULLET_EP_INSTALL AND PROJECT_IS_TOP_LEVEL AND BULLET_EP_BULLET_INCLUDE_DIR AND UNIX)
	configure_file(consumers/build.cmake.in build-consumer.cmake @ONLY)
	function(ep_add_consumer way)
		add_test(NAME Consumers.${way}
			COMMAND ${CMAKE_COMMAND} -DWAY=${way} -DCONFIG=$<CONFIG> -P ${CMAKE_CURRENT_BINARY_DIR}/build-consumer.cmake)
		set_tests_properties(Consumers.${way} PROPERTIES TIMEOUT 900 COST ${EP_LONG} ${ARGN})
	endfunction()
	ep_add_consumer(make)
	ep_add_consumer(standards)
	ep_add_consumer(snippets)
	ep_add_consumer(headers)
	ep_add_consumer(shared FIXTURES_REQUIRED shared)
	set_tests_properties(Package.subdirectory PROPERTIES FIXTURES_SETUP shared)
	foreach(tool IN ITEMS lintian doxygen)
		find_program(EP_${tool} ${tool})
		mark_as_advanced(EP_${tool})
		if(NOT EP_${tool})
			message(STATUS "The test of consumers by ${tool} is left out: not found (Debian and Ubuntu: ${tool})")
		endif()
	endforeach()
	if(EP_lintian AND NOT BUILD_SHARED_LIBS)
		ep_add_consumer(deb)
	endif()
	if(EP_doxygen)
		ep_add_consumer(doxygen)
	endif()
endif()

get_property(tests DIRECTORY PROPERTY TESTS)
list(REMOVE_ITEM tests ${others})
set_tests_properties(${tests} PROPERTIES LABELS long)
